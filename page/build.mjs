// Bundles the page into crates/urdd-view/dist/, each file compressed by brotli, with a stamp of what it was made from.
//
//     node build.mjs [URDD_WASM ROBOT_WASM MAKE_WASM [FOLDER]]
//     node build.mjs --current     only says whether crates/urdd-view/dist is of these sources: exit status 0, otherwise 1
//
// The modules are those that `.ci/page` makes: URDD_WASM for the page; ROBOT_WASM for a page in one file, without the
// validator; MAKE_WASM for what is made of descriptions that are dropped, and for the npm package. FOLDER is crates/urdd-view/dist unless it is given; `URDD_DIST=FOLDER npm test`
// tries what is there.

import { build } from "esbuild";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const repository = join(here, "..");
const dist = process.argv[5] ?? join(repository, "crates/urdd-view/dist");
const wasm = (place, name) =>
  readFileSync(process.argv[place] ?? join(repository, `target/wasm32-unknown-unknown/wasm/${name}`));

if (process.argv[2] === "--current") {
  const made = readFileSync(join(repository, "crates/urdd-view/dist/stamp"), "utf8").trim();
  const current = made === stamp();
  console.log(`crates/urdd-view/dist is of ${current ? "these" : "other"} sources`);
  process.exit(current ? 0 : 1);
}

const common = {
  bundle: true,
  minify: true,
  write: false,
  target: ["chrome111", "firefox114", "safari16.4"],
  legalComments: "none",
  charset: "utf8",
  logLevel: "warning",
};
const bundle = async (entry, format) => {
  const { outputFiles } = await build({ ...common, entryPoints: [join(here, entry)], format });
  return Buffer.from(outputFiles[0].contents);
};

const files = {
  "index.html": readFileSync(join(here, "index.html")),
  "app.js": await bundle("src/main.ts", "iife"),
  "editor.js": await bundle("src/editor/editor.ts", "esm"),
  "worker.js": await bundle("src/engine/worker.ts", "iife"),
  "make.js": await bundle("src/here/worker.ts", "iife"),
  "style.css": await bundle("src/style.css"),
  "urdd.wasm": wasm(2, "urdd.wasm"),
  "robot.wasm": wasm(3, "robot.wasm"),
  "make.wasm": wasm(4, "make.wasm"),
};

rmSync(dist, { recursive: true, force: true });
mkdirSync(dist, { recursive: true });
let page = 0;
for (const [name, bytes] of Object.entries(files)) {
  const brotli = brotliCompressSync(bytes);
  writeFileSync(join(dist, `${name}.br`), brotli);
  // Loaded when a text is first opened, or a description dropped.
  const isLate = name === "editor.js" || name === "make.js";
  if (!name.endsWith(".wasm") && !isLate) page += brotli.length;
  console.log(`${name.padEnd(12)} ${bytes.length} bytes, gzip ${gzipSync(bytes).length}, brotli ${brotli.length}`);
}
console.log(`the page without robots, wasm and what is loaded later: ${page} bytes compressed`);
writeFileSync(join(dist, "stamp"), `${stamp()}\n`);

/** SHA-256 of all that the bundle is made from. */
function stamp() {
  const roots = ["page/src", "wasm/src", "crates"];
  const single = [
    "Cargo.lock",
    "page/index.html",
    "page/build.mjs",
    "page/package-lock.json",
    "page/tsconfig.json",
    "wasm/Cargo.toml",
    "wasm/npm/module.mjs",
  ];
  const paths = [
    ...roots.flatMap((root) => walk(join(repository, root))),
    ...single.map((path) => join(repository, path)),
  ];
  const names = paths.map((path) => relative(repository, path).replaceAll("\\", "/"));
  // What the module is not made of.
  const without = /^crates\/(urdd-(c|conformance|diff|lsp|view)|[^/]+\/tests)\//;
  const hash = createHash("sha256");
  for (const name of names.filter((name) => !without.test(name)).sort(byBytes)) {
    const content = createHash("sha256")
      .update(readFileSync(join(repository, name)))
      .digest("hex");
    hash.update(`${content}  ${name}\n`);
  }
  return hash.digest("hex");
}

function byBytes(a, b) {
  return Buffer.compare(Buffer.from(a), Buffer.from(b));
}

function walk(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? walk(join(folder, entry.name)) : [join(folder, entry.name)],
  );
}
