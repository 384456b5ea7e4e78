// The module against the program: the same findings, poses as the URDD has them, the same distances.
//
//     node wasm/test/run.mjs URDD_PROGRAM URDD_WASM

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { Urdd } from "./urdd.mjs";

const [program, wasm] = process.argv.slice(2);
const bytes = readFileSync(wasm);
const module = await WebAssembly.compile(bytes);
assert.deepEqual(WebAssembly.Module.imports(module), [], "the module imports nothing");

function run(...words) {
  const done = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 28 });
  if (done.error) throw done.error;
  return done.stdout;
}

/** The folder as a zip archive without compression, by python3. */
function zip(folder) {
  const file = `${folder}.zip`;
  const script = "import shutil, sys; shutil.make_archive(sys.argv[1], 'zip', sys.argv[1])";
  assert.equal(spawnSync("python3", ["-c", script, folder]).status, 0);
  return file;
}

const folder = mkdtempSync(join(tmpdir(), "urdd-wasm-"));
let compared = 0;
try {
  const urdd = await Urdd.of(bytes);
  for (const name of ["welding_arm", "toy_all_joints", "gripper", "planar_base_arm"]) {
    const target = join(folder, name);
    run("generate", join("conformance/robots", `${name}.urdf`), "-o", target);
    compareFindings(urdd, zip(target), name);

    const samples = read(target, "kinematics_samples_module");
    const handle = urdd.open(readFileSync(`${target}.zip`));
    const about = urdd.ask(handle, { ask: "about" });
    assert.deepEqual(about.links, read(target, "chain_module").links_in_chain.map((link) => link.name));
    for (const sample of samples.samples) {
      const poses = urdd.ask(handle, { ask: "poses", q: sample.configuration });
      sample.link_poses.forEach((pose, link) => {
        for (const key of ["position", "quaternion_wxyz"]) {
          const sign = key === "position" ? 1 : signOf(pose[key], poses[link][key]);
          pose[key].forEach((x, k) => near(sign * poses[link][key][k], x, 1e-9));
        }
      });
    }

    for (const shapes of ["hulls", "pieces"]) {
      const lines = run("check-collisions", target, "--random", "5", "--shapes", shapes, "--format", "json", "--nearest", "1000000");
      for (const native of lines.trim().split("\n").map((line) => JSON.parse(line))) {
        const question = { q: native.values, shapes };
        const nearest = urdd.ask(handle, { ask: "nearest", k: 1e6, ...question });
        assert.equal(nearest.length, native.nearest.length);
        nearest.forEach((pair, k) => near(pair.distance, native.nearest[k].distance, 1e-9));
        assert.equal(urdd.ask(handle, { ask: "in_collision", ...question }), native.in_collision);
        compared += nearest.length;
      }
    }
    assert.throws(() => urdd.ask(handle, { ask: "poses", q: [NaN] }), /no number/);
    assert.throws(() => urdd.ask(handle, { ask: "sing" }), /nothing is known of `sing`/);
    urdd.close(handle);

    // One value that is wrong: the same finding.
    const module = join(target, "dof_module/module.json");
    writeFileSync(module, readFileSync(module, "utf8").replace('"Angle"', '"Length"'));
    const report = compareFindings(urdd, zip(target), name);
    assert.ok(report.totals.error > 0, "the wrong value is found");
  }
  assert.ok(compared > 1000, `${compared} distances`);
  assert.match(urdd.validateZip("x", new Uint8Array(100)).error, /./);
  assert.throws(() => urdd.open(new Uint8Array(0)), /no zip archive/);
} finally {
  rmSync(folder, { recursive: true });
}

function read(target, name) {
  return JSON.parse(readFileSync(join(target, name, "module.json"), "utf8"));
}

function signOf(a, b) {
  return Math.sign(a.reduce((sum, x, k) => sum + x * b[k], 0));
}

function near(found, expected, tolerance) {
  assert.ok(Math.abs(found - expected) <= tolerance, `${found}, expected ${expected}`);
}

function compareFindings(urdd, archive, name) {
  const ours = urdd.validateZip(`${name}.zip`, readFileSync(archive));
  const native = JSON.parse(run("validate", archive, "--format", "json"));
  assert.deepEqual(ours, native);
  return native;
}

const kB = (bytes) => `${Math.round(bytes.length / 1000)} kB`;
console.log(`${compared} distances compared`);
console.log(`the module: ${kB(bytes)}, gzip ${kB(gzipSync(bytes, { level: 9 }))}, brotli ${kB(brotliCompressSync(bytes))}`);
