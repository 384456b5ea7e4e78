// The module that lints, generates, imports and exports, against the program: the same findings, the same files.
//
//     node wasm/test/make.mjs URDD_PROGRAM MAKE_WASM
//
// MAKE_WASM may be compressed by brotli, and ends in `.br` then.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { brotliDecompressSync } from "node:zlib";
import { Urdd } from "../npm/module.mjs";

const [program, wasm] = process.argv.slice(2);
const given = readFileSync(wasm);
const bytes = wasm.endsWith(".br") ? brotliDecompressSync(given) : given;
const imports = WebAssembly.Module.imports(await WebAssembly.compile(bytes));
assert.deepEqual(imports, [{ module: "urdd", name: "progress", kind: "function" }], "the module imports progress alone");
const urdd = await Urdd.of(bytes);

/** Computed with sines and cosines, whose last digits differ; and what has hashes or sizes of that. */
const BY_LIBM = /^urdd\.json$|^kinematics_samples_module\/|^link_shapes_modules\/link_shapes_(?:distance_statistics|skips|simple_skips)_module\//;

function run(...words) {
  const done = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 28 });
  if (done.error) throw done.error;
  assert.notEqual(done.status, 2, done.stderr);
  return done.stdout;
}

/** The files of a folder, by path. */
function folder(path) {
  const all = readdirSync(path, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile());
  const at = all.map((entry) => join(entry.parentPath, entry.name));
  return Object.fromEntries(at.map((file) => [file.slice(path.length + 1), readFileSync(file)]));
}

/** The files behind a handle, by path. */
function files(handle) {
  return Object.fromEntries(urdd.list(handle).files.map(({ path }) => [path, Buffer.from(urdd.read(handle, path))]));
}

/** Whether two sets of files are the same, but for those that may differ. */
function same(found, expected, may = /^$/) {
  assert.deepEqual(Object.keys(found).sort(), Object.keys(expected).sort());
  const others = Object.keys(expected).filter((path) => !may.test(path) && !found[path].equals(expected[path]));
  assert.deepEqual(others, []);
}

const made = mkdtempSync(join(tmpdir(), "urdd-make-"));
let compared = 0;
try {
  const robots = folder("conformance/robots");
  const all = urdd.files("robots", robots);
  const found = urdd.descriptions(all);
  assert.deepEqual(
    found.map(({ path }) => path),
    Object.keys(robots).filter((path) => path.endsWith(".urdf")).sort(),
  );
  for (const name of ["welding_arm", "gripper", "hand", "planar_base_arm"]) {
    const urdf = `conformance/robots/${name}.urdf`;
    const linted = urdd.lint(all, { urdf: `${name}.urdf` });
    const native = JSON.parse(run("lint", urdf, "--format", "json"));
    assert.deepEqual(linted.urdds, native.urdds);

    const steps = [];
    urdd.tell = (progress) => steps.push(progress);
    const own = join(made, name);
    run("generate", urdf, "-o", own);
    const generated = urdd.generate(all, { path: `${name}.urdf` });
    assert.equal(generated.robot, JSON.parse(readFileSync(join(own, "urdf_module/module.json"), "utf8")).name);
    assert.ok(steps.length >= generated.modules.length && steps.every(({ what, done, of }) => what && done <= of));
    same(files(generated.files), folder(own), BY_LIBM);

    // Of the same URDD, byte for byte.
    const urdds = urdd.files(name, folder(own));
    for (const [format, file] of [["mjcf", "r.xml"], ["sdf", "r.sdf"], ["usd", "r.usda"], ["srdf", "r.srdf"]]) {
      const target = join(made, `${name}_${format}`);
      run("export", format, own, "-o", join(target, file));
      const exported = urdd.export(urdds, { format, output: file });
      same(files(exported.files), folder(target));
      compared++;
    }
    // A donor gives what did not change: the same result.
    const again = urdd.generate(all, { path: `${name}.urdf` }, generated.files);
    same(files(again.files), files(generated.files), /distance_statistics|skips_module|^urdd\.json$/);
  }
  for (const kind of ["mjcf", "sdf"]) {
    const [file] = readdirSync(`examples/${kind}`).filter((name) => /\.(?:xml|sdf)$/.test(name) && name !== "scene.xml");
    const target = join(made, `imported_${kind}`);
    run("import", `examples/${kind}/${file}`, "-o", target);
    const imported = urdd.importRobot(urdd.files("", folder(`examples/${kind}`)), { path: file });
    same(files(imported.files), folder(target));
    compared++;
  }
  const refused = [
    [() => urdd.generate(all, { path: "none.urdf" }), /there is no file `none.urdf`/],
    [() => urdd.generate(all, { path: "hand.urdf", moduls: [] }), /unknown field/],
    [() => urdd.export(all, { format: "mjcf", output: "x" }), /urdf_module/],
    [() => urdd.export(all, { format: "pdf", output: "x" }), /there is no format `pdf`/],
  ];
  for (const [call, pattern] of refused) assert.throws(call, pattern);
} finally {
  rmSync(made, { recursive: true, force: true });
}
console.log(`the module makes what the program makes: ${compared} exports and imports compared`);
