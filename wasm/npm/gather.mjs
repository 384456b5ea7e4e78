// Brings into this folder what the package holds besides its own sources: the modules as `.ci/page` built them, the types
// that the page speaks to it in, and the licences. Needs `npm --prefix page ci`.

import { spawnSync } from "node:child_process";
import { copyFileSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliDecompressSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const repository = join(here, "../..");

const dist =
  process.env.URDD_DIST ?? join(repository, "crates/urdd-view/dist");
for (const module of ["urdd.wasm", "make.wasm"])
  writeFileSync(
    join(here, module),
    brotliDecompressSync(readFileSync(join(dist, `${module}.br`))),
  );
for (const licence of ["LICENSE-MIT", "LICENSE-APACHE"])
  copyFileSync(join(repository, licence), join(here, licence));

const tsc = join(repository, "page/node_modules/typescript/bin/tsc");
const source = join(repository, "page/src/engine/protocol.ts");
const out = join(here, "types");
const words = [
  "--declaration",
  "--emitDeclarationOnly",
  "--strict",
  "--target",
  "es2022",
  "--module",
  "preserve",
];
const done = spawnSync(
  process.execPath,
  [
    tsc,
    ...words,
    "--ignoreConfig",
    "--outDir",
    out,
    "--rootDir",
    join(repository, "page/src"),
    source,
  ],
  {
    encoding: "utf8",
  },
);
if (done.status !== 0) throw new Error(done.stdout + done.stderr);
const text = readFileSync(join(out, "engine/protocol.d.ts"), "utf8");
// The types of documents are those of this package.
const modules = "../../../wasm/npm/modules";
if ([...text.matchAll(/ from "(.*)";/g)].some(([, from]) => from !== modules))
  throw new Error("protocol.ts imports something else than types of modules");
writeFileSync(
  join(here, "protocol.d.ts"),
  text.replaceAll(modules, "./modules.js"),
);
rmSync(out, { recursive: true });
