// The npm package of the module: packed, installed and used by somebody else.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
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

test("`npm pack` makes a package that validates a URDD and moves its robot, with types", { timeout: 300_000 }, () => {
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
      "module.mjs",
      "modules.d.ts",
    ];
    assert.deepEqual(installed, [...files, "package.json", "protocol.d.ts", "urdd.wasm"]);
    // TypeScript, so that the types are held too; Node runs what is left without them.
    const program = `
      import { folder, load } from "urdd";
      import type { Body, Report } from "urdd";
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
      const missed: number | undefined = model?.evaluation.num_missed;
      const least: number | undefined = clearances?.min_clearance?.clearance;
      if (model !== null || clearances !== null) throw new Error("a model, where there is none: " + missed + least);
      console.log(JSON.stringify({ report, there, reached, nearest, code: urdd.explain("DOF003").code }));
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
    const found = JSON.parse(does(project, process.execPath, "main.js", target));
    assert.deepEqual(found.report, JSON.parse(run("validate", target, "--format", "json").stdout));
    assert.equal(found.code, "DOF003");
    const { samples } = read(join(target, "kinematics_samples_module/module.json"));
    assert.equal(found.there.position.length, samples[0].link_poses[0].position.length);
    assert.ok(found.reached.reached, JSON.stringify(found.reached));
    const native = JSON.parse(
      run("check-collisions", target, "--shapes", "hulls", "--format", "json", "--nearest", "1").stdout.split("\n")[0],
    );
    assert.deepEqual(found.nearest.links, native.nearest[0].links);
  } finally {
    rmSync(folder, { recursive: true, force: true });
    made.remove();
  }
});
