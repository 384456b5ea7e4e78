// Makes what the package holds besides its sources: dist/, schemas/, LICENSE.txt.

import { build } from "esbuild";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const repository = join(here, "../..");

const { metafile } = await build({
  absWorkingDir: here,
  entryPoints: [join(here, "src/extension.ts")],
  outfile: join(here, "dist/extension.cjs"),
  bundle: true,
  minify: true,
  platform: "node",
  format: "cjs",
  target: "node20",
  external: ["vscode"],
  legalComments: "none",
  metafile: true,
  logLevel: "warning",
});

// The bundle holds packages by others: their licences stay with it.
const packages = Object.keys(metafile.inputs).map((path) => /^.*node_modules\/(?:@[^/]+\/)?[^/]+/.exec(path)?.[0]);
const notices = [...new Set(packages)].filter(Boolean).map((path) => {
  const file = readdirSync(join(here, path)).find((name) => /^licen[cs]e/i.test(name));
  if (file === undefined) throw new Error(`${path} has no licence`);
  return `${path.replace(/^.*node_modules\//, "")}\n\n${readFileSync(join(here, path, file), "utf8").trim()}\n`;
});
writeFileSync(join(here, "dist/licences.txt"), notices.join(`\n${"-".repeat(78)}\n\n`));

const schemas = join(here, "schemas");
rmSync(schemas, { recursive: true, force: true });
mkdirSync(schemas);
for (const name of readdirSync(join(repository, "schema"))) {
  if (!name.endsWith("_module") && name !== "root_metadata") continue;
  const from = join(repository, "schema", name);
  cpSync(from, join(schemas, name), { recursive: true });
  // VS Code knows a file by its name alone, and VERSION says which schema: any version will do. The newest comes first.
  const anyOf = readdirSync(from)
    .sort()
    .reverse()
    .map((file) => ({ $ref: `./${name}/${file}` }));
  const schema = { $schema: "https://json-schema.org/draft/2020-12/schema", anyOf };
  writeFileSync(join(schemas, `${name}.json`), JSON.stringify(schema) + "\n");
}

const licence = (name) => readFileSync(join(repository, name), "utf8").trim();
const licences = [licence("LICENSE-MIT"), licence("LICENSE-APACHE")].join(`\n\n${"-".repeat(78)}\n\n`);
writeFileSync(join(here, "LICENSE.txt"), `MIT OR Apache-2.0, at your option.\n\n${licences}\n`);
