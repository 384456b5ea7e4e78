// The module against the program: the same findings, poses as the URDD has them, the same distances.
//
//     node wasm/test/run.mjs URDD_PROGRAM URDD_WASM
//
// URDD_WASM may be compressed by brotli, and ends in `.br` then.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { brotliCompressSync, brotliDecompressSync, gzipSync } from "node:zlib";
import { Urdd } from "../npm/module.mjs";
import { compareSpheres } from "./spheres.mjs";

const [program, wasm] = process.argv.slice(2);
const given = readFileSync(wasm);
const compressed = wasm.endsWith(".br") ? given : brotliCompressSync(given);
const bytes = brotliDecompressSync(compressed);
const module = await WebAssembly.compile(bytes);
const imports = WebAssembly.Module.imports(module).map(({ name }) => name);
assert.ok(imports.every((name) => name === "progress"), `the module imports nothing but progress: ${imports}`);

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
  closes(urdd, folder);
  for (const name of ["welding_arm", "toy_all_joints", "gripper", "planar_base_arm"]) {
    const target = join(folder, name);
    run("generate", join("conformance/robots", `${name}.urdf`), "-o", target);
    compareFindings(urdd, zip(target), name);

    const samples = read(target, "kinematics_samples_module");
    const files = compareFiles(urdd, target, name);
    const handle = urdd.open(files);
    const about = urdd.ask(handle, { ask: "about" });
    assert.deepEqual(about.links.map((link) => link.name), read(target, "chain_module").links_in_chain.map((link) => link.name));
    const batch = urdd.linkPosesBatch(handle, samples.samples.flatMap((sample) => sample.configuration));
    samples.samples.forEach((sample, k) => {
      sample.link_poses.forEach((pose, link) => {
        const at = 7 * (k * sample.link_poses.length + link);
        pose.position.forEach((x, i) => near(batch[at + i], x, 1e-9));
      });
    });
    for (const sample of samples.samples) {
      const poses = urdd.ask(handle, { ask: "link_poses", q: sample.configuration });
      sample.link_poses.forEach((pose, link) => {
        for (const key of ["position", "quaternion_wxyz"]) {
          const sign = key === "position" ? 1 : signOf(pose[key], poses[link][key]);
          pose[key].forEach((x, k) => near(sign * poses[link][key][k], x, 1e-9));
        }
      });
    }

    for (const kind of ["hulls", "pieces"]) {
      const lines = run("check-collisions", target, "--random", "5", "--shapes", kind, "--format", "json", "--nearest", "1000000");
      for (const native of lines.trim().split("\n").map((line) => JSON.parse(line))) {
        const question = { q: native.values, kind };
        const { q } = question;
        const ask = (about, among = {}) => urdd.ask(handle, { ask: "collisions", about, kind, ...among });
        const nearest = ask({ nearest: { q, k: 1e6 } });
        assert.equal(nearest.length, native.nearest.length);
        nearest.forEach((pair, k) => near(pair.distance, native.nearest[k].distance, 1e-9));
        const shown = urdd.ask(handle, { ask: "proximity", k: 1e6, ...question });
        assert.deepEqual(shown.nearest.map((pair) => pair.distance), nearest.map((pair) => pair.distance));
        assert.equal(shown.in_collision, native.in_collision);
        assert.equal(shown.pairs, nearest.length);
        for (const { statistics, relative, distance } of shown.nearest) {
          assert.ok(statistics.min <= statistics.mean && statistics.mean <= statistics.max);
          if (relative !== null) near(relative * statistics.mean, distance, 1e-9);
        }
        assert.equal(ask({ in_collision: { q } }), native.in_collision);
        among(urdd, handle, ask, q);
        compared += nearest.length;
      }
    }
    assert.throws(() => urdd.ask(handle, { ask: "link_poses", q: [0, NaN] }), /element 1 of a list must be a finite number, not NaN/);
    assert.throws(() => urdd.ask(handle, { ask: "sing" }), /unknown variant `sing`/);
    compareAbout(urdd.ask(handle, { ask: "about" }), target);
    compareSkips(urdd.ask(handle, { ask: "skips", kind: "hulls" }), target);
    reaches(urdd, handle);
    compareLimits(urdd, handle, target);
    assert.equal(urdd.ask(handle, { ask: "collision_model" }), null);
    for (const covers of [true, false])
      assert.throws(() => urdd.sphereChecker(handle, { covers }), /link_shapes_spheres_module is missing/);
    assert.equal(urdd.ask(handle, { ask: "clearances", q: about.zero }), null);
    const sources = urdd.ask(handle, { ask: "sources" });
    const { links } = read(target, "urdf_module");
    const count = (link) => link.visual.length + link.collision.length;
    assert.equal(sources.length, links.reduce((sum, link) => sum + count(link), 0));
    for (const { link, geometry, element, shape } of sources)
      assert.deepEqual(shape, links[link][geometry.toLowerCase()][element].geometry);
    urdd.close(handle);
    urdd.closeFiles(files);

    // One value that is wrong: the same finding.
    const module = join(target, "dof_module/module.json");
    writeFileSync(module, readFileSync(module, "utf8").replace('"Angle"', '"Length"'));
    const report = compareFindings(urdd, zip(target), name);
    assert.ok(report.totals.error > 0, "the wrong value is found");
  }
  assert.ok(compared > 1000, `${compared} distances`);
  compareModel(urdd, join(folder, "learned"));
  for (const name of ["gripper", "planar_base_arm"]) {
    const target = join(folder, `${name}_spheres`);
    run("generate", `conformance/robots/${name}.urdf`, "-o", target, "--modules", "all,spheres");
    const { levels } = read(join(target, "link_shapes_modules"), "link_shapes_spheres_module");
    await compareSpheres(bytes, readFileSync(zip(target)), levels);
  }
  assert.throws(() => urdd.zip("x", new Uint8Array(100)), /./);
  assert.throws(() => urdd.zip("x", new Uint8Array(0)), /./);
  assert.equal(urdd.explain("DOF003").code, "DOF003");
  assert.throws(() => urdd.explain("DOF999"), /no rule `DOF999`/);
} finally {
  rmSync(folder, { recursive: true });
}

function read(target, name) {
  return JSON.parse(readFileSync(join(target, name, "module.json"), "utf8"));
}

/** The files of a folder by their paths. */
function contents(folder) {
  const paths = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(folder, join(entry.parentPath ?? entry.path, entry.name)));
  return Object.fromEntries(paths.map((path) => [path, readFileSync(join(folder, path))]));
}

function signOf(a, b) {
  return Math.sign(a.reduce((sum, x, k) => sum + x * b[k], 0));
}

function near(found, expected, tolerance) {
  assert.ok(Math.abs(found - expected) <= tolerance, `${found}, expected ${expected}`);
}

/** Files that are given one by one, those of meshes late: the same as on disk, and the same report. */
function compareFiles(urdd, target, name) {
  const content = contents(target);
  const paths = Object.keys(content);
  const late = paths.filter((path) => path.includes("/meshes/"));
  const first = paths.map((path) => [path, late.includes(path) ? content[path].length : content[path]]);
  const files = urdd.files(name, Object.fromEntries(first));
  if (late.length > 0) assert.throws(() => urdd.read(files, late[0]), /not there yet/);
  for (const path of late) urdd.give(files, path, content[path]);
  const listed = urdd.list(files);
  assert.equal(listed.name, name);
  assert.deepEqual(listed.files.map((file) => file.path), [...paths].sort());
  for (const path of paths) assert.deepEqual(Buffer.from(urdd.read(files, path)), content[path]);
  assert.throws(() => urdd.read(files, "../secret"), /./);
  const stl = late.find((path) => path.endsWith(".stl") && path.includes("convex_hull"));
  if (stl) {
    // Binary STL: the number of triangles is the word after a header of 80 bytes.
    assert.equal(urdd.mesh(files, stl).indices.length, 3 * content[stl].readUInt32LE(80));
  }
  const native = JSON.parse(run("validate", target, "--format", "json"));
  assert.deepEqual(urdd.validate(files, name), native);
  return files;
}

function compareAbout(about, target) {
  const chain = read(target, "chain_module");
  const bounds = read(target, "bounds_module").bounds;
  assert.deepEqual(about.faults, []);
  assert.deepEqual(about.joints.map((joint) => joint.name), chain.joints_in_chain.map((joint) => joint.joint_name));
  assert.deepEqual(about.joints.map((joint) => joint.axis), chain.joints_in_chain.map((joint) => joint.axis));
  assert.deepEqual(about.links.map((link) => link.parent_joint), chain.links_in_chain.map((link) => link.parent_joint_idx));
  about.dofs.forEach((dof, k) => assert.deepEqual(dof.bounds, bounds[k]));
  const plain = read(join(target, "mesh_modules"), "plain_meshes_module").link_meshes;
  plain.forEach((mesh, link) => assert.equal(about.meshes.plain[link][0]?.glb, mesh?.files.glb));
}

/** A gripper of two four-bars: what follows the driver, how fast, and where nothing follows. */
function closes(urdd, folder) {
  const target = join(folder, "pinch_gripper");
  run("generate", "examples/robots/pinch_gripper.urdf", "-o", target);
  const files = urdd.files("pinch_gripper", contents(target));
  const handle = urdd.open(files);
  const loops = (about) => urdd.ask(handle, { ask: "loops", about });
  const { loops: known, dofs } = urdd.ask(handle, { ask: "about" });
  const module = read(target, "loops_module");
  assert.deepEqual(known.reference, module.reference_configuration);
  assert.deepEqual(known.independent, module.independent_dof_idxs);
  assert.deepEqual(known.loops.map(({ name, links }) => [name, ...links]), module.loops.map((one) => [one.name, one.link_a_idx, one.link_b_idx]));
  const [free] = known.independent;
  const size = ({ gaps, sums }) => Math.max(...gaps.flatMap(({ position, rotation }) => [position, rotation]), ...sums.map(Math.abs));
  assert.ok(loops({ errors: { q: known.reference } }).is_closed);
  let q = known.reference;
  for (let k = 0; k < 20; k++) {
    const moved = q.map((value, dof) => (dof === free ? value + 0.01 : value));
    assert.equal(loops({ errors: { q: moved } }).is_closed, false);
    const found = loops({ close: { q: moved, held: [free] } });
    assert.ok(found.is_closed && found.configuration[free] === moved[free]);
    assert.ok(size(loops({ errors: { q: found.configuration } })) < 1e-9);
    q = found.configuration;
  }
  // The right side is the mirror image of the left one.
  const of = (name) => q[dofs.findIndex((dof) => dof.name === name)];
  for (const part of ["driver", "finger", "follower"]) near(of(`right_${part}_joint`), -of(`left_${part}_joint`), 1e-8);
  assert.deepEqual(loops({ free_dofs: { q } }).independent, known.independent);
  // Velocities are the differences of two closed configurations near.
  const step = 1e-5;
  const beside = (by) => loops({ close: { q: q.map((value, dof) => (dof === free ? value + by : value)), held: [free] } }).configuration;
  const [after, before] = [beside(step), beside(-step)];
  const velocities = loops({ velocities: { q, independent: [1] } });
  velocities.forEach((velocity, dof) => near(velocity, (after[dof] - before[dof]) / (2 * step), 1e-6));
  loops({ jacobian: { q } }).forEach((row) => near(row.reduce((sum, value, dof) => sum + value * velocities[dof], 0), 0, 1e-9));
  assert.equal(loops({ residuals: { q } }).length, 2 * 5 + 1);
  // Nothing that is held can move.
  const all = dofs.map((_, dof) => dof);
  const apart = loops({ close: { q: q.map((value) => value + 0.1), held: all } });
  assert.equal(apart.is_closed, false);
  assert.throws(() => loops({ close: { q, held: [99] } }), /99/);
  // A link is reached with closed loops, and by the tree with open ones.
  const link = urdd.ask(handle, { ask: "about" }).links.findIndex(({ name }) => name === "left_finger");
  const there = urdd.ask(handle, { ask: "link_poses", q })[link];
  const wish = { ask: "inverse_kinematics", q: known.reference, link, position: there.position };
  const reached = urdd.ask(handle, wish);
  assert.ok(reached.reached && loops({ errors: { q: reached.configuration } }).is_closed, JSON.stringify(reached));
  const open = urdd.ask(handle, { ...wish, open_loops: true, position: there.position.map((x) => x + 0.01) });
  assert.equal(loops({ errors: { q: open.configuration } }).is_closed, false);
  // A motion follows the loops, from closed ends; with open ones it is that of the tree.
  const collisions = (edge) => urdd.ask(handle, { ask: "collisions", about: { blocked_edge: { resolution: 0.005, ...edge } } });
  const end = loops({ close: { q: q.map((value, dof) => (dof === free ? value + 0.1 : value)), held: [free] } }).configuration;
  assert.equal(collisions({ start: q, end }), null);
  const far = q.map((value, dof) => (dof === free ? value + 0.1 : value));
  assert.throws(() => collisions({ start: q, end: far }), /close/);
  assert.equal(collisions({ start: q, end: far, open_loops: true }), null);
  urdd.close(handle);
  urdd.closeFiles(files);
}

/** A link is put where it was in another configuration; DOFs that may not change stay. */
function reaches(urdd, handle) {
  const about = urdd.ask(handle, { ask: "about" });
  const link = about.links.length - 1;
  const there = urdd.ask(handle, { ask: "link_poses", q: urdd.ask(handle, { ask: "random", k: 3 }) })[link];
  const wish = { ask: "inverse_kinematics", q: about.zero, link, position: there.position, restarts: 50 };
  const found = urdd.ask(handle, wish);
  assert.ok(found.reached, JSON.stringify(found));
  const pose = urdd.ask(handle, { ask: "link_poses", q: found.configuration })[link];
  pose.position.forEach((x, k) => near(x, there.position[k], 1e-5));
  assert.deepEqual(urdd.ask(handle, { ...wish, dofs: [] }).configuration, about.zero);
  assert.equal(found.verdict, "reached");
  const far = urdd.ask(handle, { ...wish, position: [100, 0, 0], explain: true });
  // What slides gets there beyond its limits.
  const slides = about.dofs.some(({ unit }) => unit === "m");
  assert.equal(far.reached, false);
  assert.match(far.verdict, slides ? /^(limits|out of reach)$/ : /^out of reach$/);
  const free = urdd.ask(handle, { ...wish, free_of: "pieces", explain: true });
  const collides = urdd.ask(handle, { ask: "collisions", about: { in_collision: { q: free.configuration } } });
  assert.ok(free.verdict === "refused" ? collides : !collides, JSON.stringify(free));
  // Among obstacles: a solution is as far from a ball where the link is to be, or refused; one far away refuses none.
  const ball = (x) => [{ name: "ball", position: there.position.map((at) => at + x), sphere: { radius: 0.05 } }];
  const blocked = { ...wish, explain: true, restarts: 5, margin: 0.01 };
  const kept = urdd.ask(handle, { ...blocked, obstacles: ball(0) });
  const within = { is_within: { q: kept.configuration, margin: 0.01 } };
  const touches = urdd.ask(handle, { ask: "collisions", about: within, obstacles: ball(0) });
  assert.equal(touches, kept.verdict === "refused", JSON.stringify(kept));
  assert.equal(urdd.ask(handle, { ...blocked, obstacles: ball(100) }).verdict, "reached");
  assert.throws(() => urdd.ask(handle, { ...blocked, obstacles: ball(100), margin: -1 }), /margin/);
  for (const { is_limited, bounds } of about.dofs) assert.ok(is_limited || [Math.PI, 1].includes(bounds[1]));
  // The rotation alone: the position is wherever it is.
  const turned = { position: [0, 0, 0], quaternion_wxyz: there.quaternion_wxyz, weights: [0, 0, 0, 1, 1, 1] };
  const turn = urdd.ask(handle, { ...wish, ...turned });
  assert.ok(turn.reached && turn.rotation_error < 1e-5, JSON.stringify(turn));
  assert.throws(() => urdd.ask(handle, { ...wish, position: [1, 2] }), /expected an array of length 3/);
  assert.throws(() => urdd.ask(handle, { ...wish, link: 1000 }), /./);
  assert.throws(() => urdd.ask(handle, { ...wish, dofs: [1000] }), /DOF 1000 is out of range/);
}

/** Distances to a ball that a link carries have a closed form; gradients are held to differences, depths to what they mean. */
function among(urdd, handle, ask, q) {
  const link = urdd.ask(handle, { ask: "about" }).links.length - 1;
  const [centre, radius] = [[0.9, -0.4, 0.7], 0.05];
  const ball = { name: "ball", position: centre, sphere: { radius } };
  const part = { name: "part", link, position: [0, 0, 0.1], sphere: { radius: 0.02 } };
  const carried = { attached: [part], obstacles: [ball] };
  const expected = (q) => {
    const { position, quaternion_wxyz: [w, x, y, z] } = urdd.ask(handle, { ask: "link_poses", q })[link];
    const axis = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
    return Math.max(0, Math.hypot(...position.map((p, k) => p + 0.1 * axis[k] - centre[k])) - radius - 0.02);
  };
  const to = ask({ nearest: { q, k: 1e6 } }, carried).find((pair) => pair.link === "part");
  near(to.distance, expected(q), 1e-9);
  const least = ask({ nearest: { q, k: 1 } }, carried)[0].distance;
  for (const margin of [0, 0.5 * least, 1.001 * least])
    assert.equal(ask({ is_within: { q, margin } }, carried), least <= margin, `${least} ${margin}`);
  for (const { link, gradient, distance } of ask({ gradients: { q, k: 1e6 } }, carried)) {
    if (link !== "part" || distance < 1e-3) continue;
    gradient.forEach((slope, dof) => {
      const at = (step) => expected(q.map((value, k) => (k === dof ? value + step : value)));
      near(slope, (at(1e-5) - at(-1e-5)) / 2e-5, 1e-6);
    });
  }
  // A box about the link, pushed out along the direction by the depth, touches and does not overlap.
  const { position } = urdd.ask(handle, { ask: "link_poses", q })[link];
  const box = (by) => ({ name: "box", position: position.map((p, k) => p + by[k]), box: { half_extents: [0.05, 0.07, 0.06] } });
  for (const { link, piece, depth, direction } of ask({ penetrations: { q } }, { obstacles: [box([0, 0, 0])] })) {
    near(Math.hypot(...direction), 1, 1e-9);
    const overlaps = (by) => {
      const moved = box(direction.map((d) => d * by));
      return ask({ penetrations: { q } }, { obstacles: [moved] }).some((pair) => pair.link === link && pair.piece === piece);
    };
    assert.ok(!overlaps(depth + 1e-6), `${link} ${depth}`);
    assert.ok(overlaps(depth - 1e-6), `${link} ${depth}`);
  }
  // Where a motion is blocked, it collides.
  const [from, end] = [11, 9].map((k) => urdd.ask(handle, { ask: "random", k }));
  const wall = { obstacles: [box([0, 0, 0])] };
  const blocked = ask({ blocked_edge: { start: from, end, resolution: 0.002 } }, wall);
  const collides = (part) => ask({ in_collision: { q: from.map((value, k) => value + part * (end[k] - value)) } }, wall);
  if (blocked === null) for (let k = 0; k <= 20; k++) assert.equal(collides(k / 20), false);
  else assert.equal(collides(blocked), true);
  const first = ask({ first_contact: { start: from, end, resolution: 0.002 } }, wall);
  assert.equal(first === null, blocked === null);
  // Of a start that collides, no part is free.
  if (first !== null && collides(0)) assert.deepEqual(first, { free: 0, blocked: 0, obstruction: "contact" });
  else if (first !== null) {
    assert.ok(first.free < first.blocked && first.free <= blocked, `${first.free} ${first.blocked} ${blocked}`);
    assert.deepEqual([first.free, first.blocked].map(collides), [false, true]);
    for (let k = 0; k < 20; k++) assert.equal(collides((first.free * k) / 20), false);
  }
  // A proof ends at a start that collides.
  for (const resolution of collides(0) ? [0.01] : [undefined, 0.01])
    assert.throws(() => ask({ blocked_edge: { start: from, end: end.map(() => 1e300), resolution } }, wall), /steps|overflow/);
  // What is left out is not answered.
  const pairs = ask({ nearest: { q, k: 1e6 } }, { attached: [part] });
  const [pair] = pairs.filter(({ links }) => links.includes("part"));
  const left = ask({ nearest: { q, k: 1e6 } }, { attached: [part], without: [pair.links] });
  assert.deepEqual(left, pairs.filter(({ links }) => !pair.links.every((name) => links.includes(name))));
  const none = ask({ nearest: { q, k: 1e6 } }, { ...carried, without_bodies: ["part"] });
  assert.ok(none.length > 0 && none.every(({ link }) => link !== "part"));
  assert.throws(() => ask({ nearest: { q, k: 1 } }, { without: [["part", "nobody"]] }), /no link or attached object/);
  assert.throws(() => ask({ is_within: { q, margin: -1 } }), /./);
  assert.throws(() => ask({ nearest: { q, k: 1 } }, { obstacles: [{ name: "x" }] }), /./);
  assert.throws(() => ask({ nearest: { q, k: 1 } }, { attached: [{ ...part, link: 1000 }] }), /./);
}

/** Limits and masses are those of the URDF. */
function compareLimits(urdd, handle, target) {
  const { joints, links } = read(target, "urdf_module");
  const [limits, about] = ["limits", "about"].map((ask) => urdd.ask(handle, { ask }));
  about.dofs.forEach(({ joint }, dof) => {
    const { name, dofs } = about.joints[joint];
    // A URDF has one number for a joint, which says nothing of one of several DOFs.
    if (dofs.length > 1) return;
    const { limit } = joints.find((one) => one.name === name);
    for (const key of ["velocity", "effort"]) assert.equal(limits[key][dof] ?? 0, limit?.[key] ?? 0, `${name} ${key}`);
  });
  const masses = urdd.ask(handle, { ask: "link_masses" });
  assert.deepEqual(masses.map(({ mass }) => mass), links.map(({ inertial }) => inertial?.mass.value ?? 0));
  const q = urdd.ask(handle, { ask: "random", k: 2 });
  const poses = urdd.ask(handle, { ask: "link_poses", q });
  const total = masses.reduce((sum, { mass }) => sum + mass, 0);
  const found = urdd.ask(handle, { ask: "centre_of_mass", q });
  if (total === 0) assert.equal(found, null);
  found?.forEach((value, i) => {
    const moments = masses.map(({ mass, centre: c }, link) => {
      const { position: p, quaternion_wxyz: [w, x, y, z] } = poses[link];
      const row = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
      ][i];
      return mass * (p[i] + row.reduce((sum, r, k) => sum + r * c[k], 0));
    });
    near(value, moments.reduce((sum, moment) => sum + moment, 0) / total, 1e-9);
  });
  // The slope of the potential energy, with a payload that weighs as much as the robot.
  const payload = { link: masses.length - 1, mass: total, point: [0.1, -0.2, 0.3] };
  const held = urdd.ask(handle, { ask: "gravity_torques", q });
  const loaded = urdd.ask(handle, { ask: "gravity_torques", q, gravity: [0, 0, -1], payload });
  const height = (dof, by) => {
    const at = q.map((value, k) => (k === dof ? value + by : value));
    const { position: p, quaternion_wxyz: [w, x, y, z] } = urdd.ask(handle, { ask: "link_poses", q: at }).at(-1);
    const [a, b, c] = payload.point;
    const tip = p[2] + 2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b + (1 - 2 * (x * x + y * y)) * c;
    return [urdd.ask(handle, { ask: "centre_of_mass", q: at })?.[2] ?? 0, tip];
  };
  assert.equal(held.length, q.length);
  held.forEach((torque, dof) => {
    const [low, high] = [height(dof, -1e-4), height(dof, 1e-4)];
    const [own, carried] = [0, 1].map((k) => total * (high[k] - low[k]) / 2e-4);
    near(torque, 9.81 * own, 1e-5);
    near(loaded[dof], own + carried, 1e-5);
  });
  assert.throws(() => urdd.ask(handle, { ask: "gravity_torques", q, payload: { link: 0, mass: -1 } }), /not below 0 kg/);
}

/** What the learned model says is what its own test vectors say; one that is cut short is told of. */
function compareModel(urdd, target) {
  run("generate", "conformance/robots/six_axis_arm.urdf", "-o", target, "--modules", "all,self_collision_model");
  const { pairs, other_pairs, clip_distance, evaluation, layers, test_vectors } = read(join(target, "link_shapes_modules"), "self_collision_model_module");
  const names = read(target, "chain_module").links_in_chain.map((link) => link.name);
  const open = () => {
    const files = urdd.zip("learned.zip", readFileSync(zip(target)));
    return [files, urdd.open(files)];
  };
  const [files, handle] = open();
  const { rates, ...about } = urdd.ask(handle, { ask: "collision_model" });
  const { num_missed, num_colliding } = evaluation;
  assert.deepEqual([rates.miss.count, rates.miss.of], [num_missed, num_colliding]);
  assert.ok(rates.miss.lower < num_missed / num_colliding && num_missed / num_colliding < rates.miss.upper);
  assert.deepEqual(about, {
    pairs: pairs.length,
    other_pairs: other_pairs.length,
    num_parameters: layers.reduce((sum, { weights, biases }) => sum + weights.flat().length + biases.length, 0),
    clip_distance,
    evaluation,
  });
  assert.ok(test_vectors.length > 0);
  for (const { configuration, clearances } of test_vectors) {
    const found = urdd.ask(handle, { ask: "clearances", q: configuration });
    assert.equal(found.clearances.length, clearances.length);
    clearances.forEach((expected, k) => near(found.clearances[k], expected, 1e-9 * Math.max(Math.abs(expected), clip_distance)));
  }
  console.log(`${test_vectors.length} test vectors of a learned model compared`);
  const verdicts = new Set();
  for (let k = 0; k < 40; k++) {
    const found = urdd.ask(handle, { ask: "clearances", q: urdd.ask(handle, { ask: "random", k }) });
    const least = Math.min(...found.clearances);
    const { pair, links, link_idxs, clearance } = found.min_clearance;
    assert.equal(clearance, least);
    assert.equal(pair, found.clearances.indexOf(least));
    assert.deepEqual(link_idxs, [pairs[pair].link_a_idx, pairs[pair].link_b_idx]);
    assert.deepEqual(links, link_idxs.map((link) => names[link]));
    assert.equal(found.may_collide, least <= 0);
    verdicts.add(found.may_collide);
  }
  assert.equal(verdicts.size, 2, "some configurations are clear, and some are not");
  assert.throws(() => urdd.ask(handle, { ask: "clearances", q: [0] }), /./);
  urdd.close(handle);
  urdd.closeFiles(files);

  const report = compareFindings(urdd, `${target}.zip`, "learned");
  assert.equal(report.totals.error, 0);
  const module = join(target, "link_shapes_modules/self_collision_model_module/module.json");
  writeFileSync(module, readFileSync(module, "utf8").slice(0, -20));
  const [cut, robot] = open();
  assert.throws(() => urdd.ask(robot, { ask: "collision_model" }), /self_collision_model_module: /);
  urdd.close(robot);
  urdd.closeFiles(cut);
}

function compareSkips(skips, target) {
  const module = read(join(target, "link_shapes_modules"), "link_shapes_skips_module");
  const rows = skips.skipped.map((row) => [...row].map((letter) => letter === "1"));
  assert.deepEqual(rows, module.full_convex_hulls_skips);
  assert.deepEqual(skips.places.map(([link]) => link), module.full_shapes);
  assert.deepEqual(skips.edits, module.edits);
}

function compareFindings(urdd, archive, name) {
  const files = urdd.zip(`${name}.zip`, readFileSync(archive));
  const ours = urdd.validate(files, `${name}.zip`);
  urdd.closeFiles(files);
  const native = JSON.parse(run("validate", archive, "--format", "json"));
  assert.deepEqual(ours, native);
  return native;
}

const kB = (bytes) => `${Math.round(bytes.length / 1000)} kB`;
console.log(`${compared} distances compared`);
console.log(`the module: ${kB(bytes)}, gzip ${kB(gzipSync(bytes, { level: 9 }))}, brotli ${kB(compressed)}`);
