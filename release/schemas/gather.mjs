// Brings into this folder what the package holds: the published schemas, the types of documents, the licences.

import { copyFileSync, cpSync, existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const repository = join(here, "../..");

rmSync(join(here, "schema"), { recursive: true, force: true });
const schemas = {};
for (const module of readdirSync(join(repository, "schema"), { withFileTypes: true })) {
  if (!module.isDirectory()) continue;
  const from = join(repository, "schema", module.name);
  cpSync(from, join(here, "schema", module.name), { recursive: true });
  for (const file of readdirSync(from).sort())
    schemas[`${module.name}@${file.replace(/\.json$/, "")}`] = JSON.parse(readFileSync(join(from, file), "utf8"));
}
writeFileSync(join(here, "index.mjs"), `export const schemas = ${JSON.stringify(schemas)};\n`);

// `cargo xtask update` writes them from the schemas.
const types = join(repository, "wasm/npm/modules.d.ts");
if (existsSync(types)) copyFileSync(types, join(here, "modules.d.ts"));
const ids = Object.keys(schemas).map((id) => `  | ${JSON.stringify(id)}`);
writeFileSync(
  join(here, "index.d.ts"),
  (existsSync(types) ? 'export type * from "./modules.js";\n\n' : "") +
    `/** Name and version of a schema. */\nexport type SchemaId =\n${ids.join("\n")};\n\n` +
    "/** Every published schema: an object as JSON has it. */\nexport const schemas: Record<SchemaId, { $id: string; [key: string]: unknown }>;\n",
);
for (const licence of ["LICENSE-MIT", "LICENSE-APACHE"]) copyFileSync(join(repository, licence), join(here, licence));
