// The module that lints, generates, imports and exports, against the program: the same findings, the same files.
//
//     node wasm/test/make.mjs URDD_PROGRAM MAKE_WASM
//
// MAKE_WASM may be compressed by brotli, and ends in `.br` then.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { brotliDecompressSync } from "node:zlib";
import { Urdd } from "../npm/module.mjs";

const [program, wasm] = process.argv.slice(2);
const given = readFileSync(wasm);
const bytes = wasm.endsWith(".br") ? brotliDecompressSync(given) : given;
const imports = WebAssembly.Module.imports(await WebAssembly.compile(bytes));
assert.deepEqual(
  imports.map(({ module, name, kind }) => `${kind} ${module}.${name}`).sort(),
  ["function urdd.progress", "function urdd.read"],
  "the module imports nothing else",
);
const urdd = await Urdd.of(bytes);

/** Sines and cosines have other last digits here, and so has what is computed from them: metres, radians and ratios. */
const TOLERANCE = 1e-6;

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

/** The paths of files that are not among others with the same bytes. */
function other(files, others) {
  return Object.keys(files).filter((path) => !others[path]?.equals(files[path])).sort();
}

/** Two sets of the same files, whose numbers differ by rounding at most in texts, and by nothing in others. */
function same(found, expected) {
  assert.deepEqual(Object.keys(found).sort(), Object.keys(expected).sort());
  for (const path of Object.keys(expected).filter((path) => !found[path].equals(expected[path]))) {
    const [a, b] = [found[path], expected[path]].map((bytes) => bytes.toString("utf8").split(NUMBER));
    assert.equal(a.length, b.length, path);
    a.forEach((word, k) => {
      if (k % 2 === 0) assert.equal(word, b[k], path);
      else assert.ok(Math.abs(word - b[k]) <= ROUNDING, `${path}: ${word}, not ${b[k]}`);
    });
  }
}

const NUMBER = /(?<![\w.])(-?\d+(?:\.\d+)?(?:e-?\d+)?)(?![\w.])/;
const ROUNDING = 1e-9;

/**
 * Two URDDs of the same files, whose documents differ by rounding at most. Sizes and hashes follow from them. Of a body with
 * symmetries, several boxes are the smallest: whether those of the module are right, the validator says.
 */
function near(found, expected) {
  assert.deepEqual(Object.keys(found).sort(), Object.keys(expected).sort());
  for (const path of Object.keys(expected).filter((path) => /module\.json$/.test(path) && !/approximations/.test(path)))
    alike(JSON.parse(found[path]), JSON.parse(expected[path]), path);
}

function alike(a, b, at) {
  if (typeof b === "number") {
    assert.ok(Math.abs(a - b) <= TOLERANCE * Math.max(1, Math.abs(b)), `${at}: ${a}, not ${b}`);
  } else if (b !== null && typeof b === "object") {
    assert.deepEqual(Object.keys(a), Object.keys(b), at);
    for (const key of Object.keys(b)) if (!DIGESTS.has(key)) alike(a[key], b[key], `${at}/${key}`);
  } else assert.equal(a, b, at);
}

const DIGESTS = new Set(["sha256", "size"]);

const made = mkdtempSync(join(tmpdir(), "urdd-make-"));
let compared = 0;
let urdds;
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
    const content = files(generated.files);
    near(content, folder(own));
    const written = join(made, `${name}_here`);
    for (const [path, bytes] of Object.entries(content)) {
      mkdirSync(dirname(join(written, path)), { recursive: true });
      writeFileSync(join(written, path), bytes);
    }
    assert.match(run("validate", "--fail-on", "info", written), /1 passed\. 0 findings/);

    // Of the same URDD.
    urdds = urdd.files(name, folder(own));
    for (const [format, file] of [["mjcf", "r.xml"], ["sdf", "r.sdf"], ["usd", "r.usda"], ["srdf", "r.srdf"]]) {
      const target = join(made, `${name}_${format}`);
      run("export", format, own, "-o", join(target, file));
      const exported = urdd.export(urdds, { format, output: file });
      same(files(exported.files), folder(target));
      compared++;
    }
    const config = join(made, `${name}_moveit`, "r_config");
    run("export", "moveit", own, "-o", config, "--ros", "humble");
    const humble = urdd.export(urdds, { format: "moveit", output: "r_config", ros: "humble" });
    same(files(humble.files), folder(config));
    compared++;
    // A donor gives what did not change: the same result.
    const again = urdd.generate(all, { path: `${name}.urdf` }, generated.files);
    near(files(again.files), content);
    // Of a URDD with less in it, what is not there, and what names it.
    const less = urdd.generate(all, { path: `${name}.urdf`, modules: ["plain_meshes"] });
    const changed = other(content, files(less.files));
    assert.ok(changed.includes("urdd.json") && changed.length < Object.keys(content).length);
    assert.deepEqual(urdd.changed(generated.files, less.files).sort(), changed);
    // Distances of shapes that touch have other last digits where hulls are those of files.
    assert.deepEqual(urdd.changed(again.files, generated.files).sort(), other(files(again.files), content));
  }
  for (const kind of ["mjcf", "sdf", "usd"]) {
    const [file] = readdirSync(`examples/${kind}`).filter((name) => /\.(?:xml|sdf|usda)$/.test(name) && name !== "scene.xml");
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
    [() => urdd.generate(all, { path: "hand.urdf", pieces: 65 }), /`pieces` must be a whole number from 1 to 64, not 65/],
    [() => urdd.generate(all, { path: "hand.urdf", samples: -1 }), /`samples` must be a whole number from 1 to/],
    [() => urdd.generate(all, { path: "hand.urdf", piece_tolerance: 0 }), /`piece_tolerance` must be above 0/],
    [() => urdd.export(urdds, { format: "foam", output: "x", spheres: 0 }), /`spheres` must be .* from 1 to 10,000, not 0/],
    [() => urdd.export(urdds, { format: "foam", output: "x", total_spheres: 0 }), /`total_spheres` must be/],
    [() => urdd.export(urdds, { format: "foam", output: "x", samples: 0 }), /`samples` must be .* from 100 to/],
    [() => urdd.export(urdds, { format: "mjcf", output: "x", bandwidth: -5 }), /`bandwidth` must be from 0.01 to 1,000 Hz/],
    [() => urdd.export(urdds, { format: "mjcf", output: "x", bandwidth: 1e300 }), /`bandwidth` must be from/],
    [() => urdd.export(urdds, { format: "mjcf", output: "x", bandwidth: NaN }), /bandwidth must be a finite number/],
    [() => urdd.export(urdds, { format: "moveit", output: "x", ros: "foxy" }), /there are: humble, jazzy/],
    [() => urdd.export(urdds, { format: "sdf", output: "x", ros: "jazzy" }), /ros is for moveit only/],
    [() => urdd.export(all, { format: "pdf", output: "x" }), /there is no format `pdf`/],
  ];
  for (const [call, pattern] of refused) assert.throws(call, pattern);
} finally {
  rmSync(made, { recursive: true, force: true });
}
console.log(`the module makes what the program makes: ${compared} exports and imports compared`);
