// The npm package of the module: packed, installed and used by somebody else.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { read, repository, robots, run } from "./world.mjs";

function does(cwd, command, ...words) {
  const done = spawnSync(command, words, { cwd, encoding: "utf8" });
  assert.equal(done.status, 0, `${command} ${words.join(" ")}: ${done.stdout}${done.stderr}`);
  return done.stdout;
}

test("`npm pack` makes a package that validates, moves a robot and lints, with types", { timeout: 300_000 }, () => {
  const folder = mkdtempSync(join(tmpdir(), "urdd-npm-"));
  const made = robots(["gripper"]);
  try {
    does(join(repository, "wasm/npm"), "npm", "pack", "--pack-destination", folder);
    const [tarball] = readdirSync(folder);
    const project = join(folder, "project");
    mkdirSync(project);
    writeFileSync(join(project, "package.json"), `{ "type": "module", "private": true }`);
    does(project, "npm", "install", "--offline", "--no-audit", "--no-fund", join(folder, tarball));
    const installed = readdirSync(join(project, "node_modules/urdd")).sort();
    const files = [
      "LICENSE-APACHE",
      "LICENSE-MIT",
      "README.md",
      "index.d.ts",
      "index.mjs",
      "make.wasm",
      "module.mjs",
      "modules.d.ts",
    ];
    assert.deepEqual(installed, [...files, "package.json", "protocol.d.ts", "urdd.wasm"]);
    // TypeScript, so that the types are held too; Node runs what is left without them.
    const program = `
      import { folder, load } from "urdd";
      import type { Body, Program, Report } from "urdd";
      import type { JointInChain } from "urdd/modules";
      const urdd = await load();
      const source = await folder(process.argv[2] ?? "");
      const report: Report = urdd.validate(source);
      const robot = urdd.robot(source);
      const q: number[] = robot.about.middle ?? [];
      const axis: JointInChain["axis"] = [0, 0, 1];
      if (axis.length !== 3) throw new Error("an axis");
      const link: number = robot.about.links.length - 1;
      const there = robot.linkPoses(q)[link];
      if (!there) throw new Error("no pose");
      const reached = robot.inverseKinematics({ q: robot.random(3), link, position: there.position, restarts: 20 });
      const [nearest] = robot.nearest(robot.about.zero ?? [], 1, "hulls");
      const [model, clearances] = [robot.collisionModel, robot.clearances(q)];
      const shelf = { name: "shelf", position: [0.5, 0, 0.4], box: { half_extents: [0.2, 0.4, 0.01] } } satisfies Body;
      const tool = { name: "tool", link, sphere: { radius: 0.03 } };
      const world = { kind: "hulls" as const, obstacles: [shelf], attached: [tool] };
      const blocked: number | null = robot.blockedEdge(q, robot.random(8), { margin: 0.02, resolution: 0.01, ...world });
      const [to] = robot.gradients(q, 1, world);
      if (to?.obstacle !== "shelf" || to.gradient?.length !== q.length) throw new Error("a gradient " + blocked);
      if (robot.isWithin(q, 0.9 * to.distance, world) || !robot.isWithin(q, 1.1 * to.distance, world)) throw new Error("a margin");
      for (const { depth } of robot.penetrations(q, "hulls")) if (depth < 0) throw new Error("a depth");
      if (robot.limits.velocity.length !== q.length || robot.linkMasses.length !== link + 1) throw new Error("limits");
      const middle: readonly number[] | null = robot.centreOfMass(q);
      if (middle?.length !== 3) throw new Error("a centre of mass");
      const torques: number[] = robot.gravityTorques(q, { payload: { link, mass: 1 }, gravity: [0, 0, -9.81] });
      if (torques.length !== q.length) throw new Error("torques");
      try { robot.sphereChecker(); throw new Error("spheres, where there are none"); } catch (error) {
        if (!/link_shapes_spheres_module/.test(String(error))) throw error;
      }
      // Of a URDD with spheres.
      const spheres = () => {
        const seen = { name: "seen", points: { points: [[0.5, 0, 0.4]], radius: 0.01 } } satisfies Body;
        const around = robot.sphereChecker({ covers: true }).around([seen]);
        const answer: "free" | "maybe" = around.inCollision(q);
        const near: ("free" | "contact")[] = robot.sphereChecker().inCollisionBatch(new Float64Array(q));
        // @ts-expect-error it is no boolean
        const touches: boolean = around.inCollision(q);
        return [answer, near, touches, around.firstContact(q, q, { resolution: 0.1, open_loops: true })?.blocked];
      };
      if (spheres.length !== 0) spheres();
      const missed: number | undefined = model?.evaluation.num_missed;
      const least: number | undefined = clearances?.min_clearance?.clearance;
      if (model !== null || clearances !== null) throw new Error("a model, where there is none: " + missed + least);
      const urdf = process.argv[3] ?? "";
      const programs: Program[] = ["mujoco", "humble"];
      const linted = { all: await urdd.lint(urdf), some: await urdd.lint(new TextEncoder().encode(urdf), { for: programs }) };
      const around = await folder(process.argv[4] ?? "");
      const meshes = await urdd.lint(around, { urdf: "robots/arm.urdf" });
      const deeds = meshes.urdds[0]?.programs.map(({ program, does }) => program + " " + does);
      if (!deeds?.includes("pybullet null")) throw new Error("deeds: " + deeds?.join());
      const paths = (await urdd.descriptions(around)).map(({ path }) => path);
      if (paths.join() !== "robots/arm.urdf,robots/gone.urdf") throw new Error("descriptions: " + paths.join());
      let steps = 0;
      const made = await urdd.generate(around, { path: "robots/arm.urdf", samples: 10 }, ({ done, of }) => {
        if (done <= of) steps++;
      });
      const exported = await urdd.export(made, "mjcf", { output: "arm.xml" });
      const text = new TextDecoder().decode(exported.files[exported.main]);
      if (urdd.validate(made).urdds[0]?.verdict !== "pass" || steps === 0 || !text.includes("<mujoco")) throw new Error(text);
      const refusals: string[] = [];
      const bad = { urdf: () => urdd.lint(around), for: () => urdd.lint(urdf, { for: ["gazeboo" as Program] }) };
      for (const ask of Object.values(bad)) await ask().catch((error: unknown) => refusals.push(String(error)));
      const macros = { name: "m", files: { "m.urdf.xacro": new TextEncoder().encode("<robot name='m'><link name='l'/></robot>") } };
      const xacro = await urdd.generate(macros).catch((error: unknown) => String(error));
      if (!/m.urdf.xacro. is a xacro file/.test(String(xacro))) throw new Error("xacro: " + JSON.stringify(xacro));
      const codes = ["DOF003", "LNT060"].map((code) => urdd.explain(code).code);
      console.log(JSON.stringify({ report, there, reached, nearest, codes, linted, meshes, refusals }));
      robot.close();
      try { robot.linkPoses(q); throw new Error("open"); } catch (error) { if (!/closed/.test(String(error))) throw error; }
    `;
    writeFileSync(join(project, "main.ts"), program);
    const tsc = createRequire(import.meta.url).resolve("typescript/bin/tsc");
    const types = createRequire(import.meta.url)
      .resolve("@types/node/package.json")
      .replace(/\/node\/package\.json$/, "");
    const strict = ["--strict", "--target", "es2022", "--module", "nodenext", "--lib", "es2022,dom"];
    does(project, process.execPath, tsc, ...strict, "--typeRoots", types, "--types", "node", "main.ts");
    const target = join(made.robots, "gripper");
    // A URDF that ROS refuses; and one in a folder, whose mesh is in another.
    const refused = join(repository, "crates/urdd-lint/tests/cases/LNT060/invalid.urdf");
    const around = join(folder, "arm_description");
    for (const name of ["robots", "meshes"]) mkdirSync(join(around, name), { recursive: true });
    const mesh = `<geometry><mesh filename="package://arm_description/meshes/box.stl"/></geometry>`;
    const [arm, gone] = [join(around, "robots/arm.urdf"), join(around, "robots/gone.urdf")];
    writeFileSync(arm, `<robot name="arm"><link name="a"><collision>${mesh}</collision></link></robot>`);
    writeFileSync(gone, readFileSync(arm, "utf8").replace("box.stl", "bx.stl"));
    writeFileSync(join(around, "package.xml"), "<package><name>arm_description</name></package>");
    copyFileSync(
      join(repository, "crates/urdd-lint/tests/cases/LNT029/meshes/box.stl"),
      join(around, "meshes/box.stl"),
    );
    const words = [target, readFileSync(refused, "utf8"), around];
    const found = JSON.parse(does(project, process.execPath, "main.js", ...words));
    const native = (...words) => JSON.parse(run("lint", ...words, "--format", "json").stdout);
    const named = (report) => JSON.parse(JSON.stringify(report).replaceAll("invalid.urdf", "robot.urdf"));
    assert.deepEqual(found.linted.all, named(native(refused)));
    assert.deepEqual(found.linted.some, named(native(refused, "--for", "mujoco,humble")));
    assert.deepEqual(found.meshes, native(arm));
    assert.notDeepEqual(native(arm).urdds[0].findings, native(gone).urdds[0].findings);
    assert.match(found.refusals[0], /several URDFs.*arm\.urdf.*gone\.urdf/);
    assert.match(found.refusals[1], /no program `gazeboo`; write some of ros, /);
    const [, union] = /export type Program =([^;]+);/.exec(
      readFileSync(join(repository, "wasm/npm/index.d.ts"), "utf8"),
    );
    const typed = [...union.matchAll(/"(.+?)"/g)].map(([, name]) => name);
    assert.deepEqual(typed, /some of (.+)$/.exec(found.refusals[1])[1].split(", "));
    assert.deepEqual(found.report, JSON.parse(run("validate", target, "--format", "json").stdout));
    assert.deepEqual(found.codes, ["DOF003", "LNT060"]);
    const { samples } = read(join(target, "kinematics_samples_module/module.json"));
    assert.equal(found.there.position.length, samples[0].link_poses[0].position.length);
    assert.ok(found.reached.reached, JSON.stringify(found.reached));
    const nearest = JSON.parse(
      run("check-collisions", target, "--shapes", "hulls", "--format", "json", "--nearest", "1").stdout.split("\n")[0],
    );
    assert.deepEqual(found.nearest.links, nearest.nearest[0].links);
  } finally {
    rmSync(folder, { recursive: true, force: true });
    made.remove();
  }
});
