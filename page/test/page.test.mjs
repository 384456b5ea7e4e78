// The page as a person uses it: every panel by clicking, typing and dragging; numbers against the program.

import assert from "node:assert/strict";
import { cpSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe } from "node:test";
import { allNames, drawn, inPage, open, read, run, setting, soon, state } from "./world.mjs";

const set = setting(allNames());

/** Waits until the links are drawn where the joints have them. */
async function posed(page) {
  await soon(async () => {
    const [expected, drawn] = await page.evaluate(async () => {
      const { app } = globalThis.urdd;
      const expected = await app.engine.ask("linkPoses", { q: app.store.now.q });
      return [[...expected], [...app.store.now.poses]];
    });
    assert.deepEqual(drawn, expected);
  });
}

describe("the page", { concurrency: false }, () => {
  inPage(set, "the token leaves the address, and a reload still works", async (page) => {
    await page.waitForSelector(".card");
    assert.ok(!page.url().includes("token"), page.url());
    await page.reload();
    await page.waitForSelector(".card");
    assert.equal(await page.locator(".card").count(), 9);
    await page.getByRole("searchbox", { name: "Find a robot" }).fill("weld");
    assert.equal(await page.locator(".card:visible").count(), 1);
  });

  inPage(set, "links are drawn where the kinematics samples have them, on all nine robots", async (page) => {
    for (const name of allNames()) {
      await open(page, name);
      const { samples } = read(join(set.made.robots, name, "kinematics_samples_module/module.json"));
      const worst = await page.evaluate(async (samples) => {
        const { app, stage } = globalThis.urdd;
        let worst = 0;
        for (const sample of samples) {
          const { poses } = app.store.now;
          app.move(sample.configuration);
          while (app.store.now.poses === poses) await new Promise((resolve) => setTimeout(resolve, 1));
          sample.link_poses.forEach((pose, link) => {
            // Columns of the matrix by which the link is drawn, against those of the stored quaternion.
            const drawn = stage.scene.link(link).matrixWorld.elements;
            const [w, x, y, z] = pose.quaternion_wxyz;
            const expected = [
              [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
              [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
              [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
              pose.position,
            ];
            expected.forEach((column, i) =>
              column.forEach((value, j) => {
                worst = Math.max(worst, Math.abs(drawn[4 * i + j] - value));
              }),
            );
          });
        }
        return worst;
      }, samples);
      assert.ok(worst < 1e-6, `${name}: ${worst}`);
    }
  });

  inPage(set, "joints: slider, number, copy, paste, keys, samples", async (page) => {
    await open(page, "welding_arm");
    const zero = await state(page, "q");
    const entry = page.locator(".joint").first().getByRole("spinbutton");
    await entry.fill("30");
    await entry.press("Enter");
    const q = await state(page, "q");
    assert.ok(Math.abs(q[0] - Math.PI / 6) < 1e-9, String(q));
    await soon(async () => assert.match(await page.locator(".row").nth(1).textContent(), /30°/));
    await page.locator(".joint").first().getByRole("slider").focus();
    await page.keyboard.press("End");
    const { bounds } = read(join(set.made.robots, "welding_arm/bounds_module/module.json"));
    assert.equal((await state(page, "q"))[0], bounds[0][1]);
    await page.getByRole("button", { name: "Copy", exact: true }).click();
    await page.getByRole("button", { name: "Zero", exact: true }).click();
    assert.deepEqual(await state(page, "q"), zero);
    await page.getByRole("button", { name: "Paste", exact: true }).click();
    assert.equal((await state(page, "q", (value) => value[0] > 0.6))[0], bounds[0][1]);
    await page.getByRole("button", { name: "Random", exact: true }).click();
    const random = await state(page, "q");
    random.forEach((value, dof) => assert.ok(value >= bounds[dof][0] && value <= bounds[dof][1]));
    await page.getByRole("button", { name: "Play samples" }).click();
    const sample = await state(page, "sample");
    assert.ok(sample.position < 1e-9 && sample.angle < 1e-7, JSON.stringify(sample));
    await state(page, "sample", (value) => value?.at > 0);
    // A move by hand stops it.
    await page.getByRole("button", { name: "Zero" }).click();
    assert.equal(await page.locator("#timeline-play").textContent(), "Play");
    assert.equal(await state(page, "sample", () => true), null);
    await page.getByRole("button", { name: "Close", exact: true }).click();
  });

  inPage(set, "a joint follows the pointer in the picture, and a link is selected by a click", async (page) => {
    await open(page, "welding_arm");
    const at = await page.evaluate(() => {
      const { stage } = globalThis.urdd;
      const link = globalThis.urdd.app.store.now.robot.link("forearm");
      const box = stage.scene.bounds(new Set([link]));
      const middle = box.min.clone().add(box.max).multiplyScalar(0.5);
      const place = stage.view.place(middle);
      const corner = stage.view.canvas.getBoundingClientRect();
      return { x: place.x + corner.left, y: place.y + corner.top };
    });
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.up();
    const selected = await state(page, "selected");
    assert.equal(selected.kind, "link");
    const before = await state(page, "q");
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    for (let step = 1; step <= 8; step++) await page.mouse.move(at.x + 5 * step, at.y - 5 * step);
    await page.mouse.up();
    await state(page, "q", (q) => q.some((value, dof) => value !== before[dof]));
    // The picture has it, so that the next drag takes hold of the part where it is.
    await posed(page);
    const q = await state(page, "q");
    assert.equal(q.filter((value, dof) => value !== before[dof]).length, 1, `${before} ${q}`);
    await page.keyboard.down("Shift");
    // The part is where it was dragged to.
    const there = { x: at.x + 40, y: at.y - 40 };
    await page.mouse.move(there.x, there.y);
    await page.mouse.down();
    for (let step = 1; step <= 8; step++) await page.mouse.move(there.x - 4 * step, there.y + 4 * step);
    await page.mouse.up();
    await page.keyboard.up("Shift");
    // What was pulled follows the pointer, by the library's inverse kinematics.
    const pulled = await state(page, "q", (now) => now.some((value, dof) => value !== q[dof]));
    assert.ok(pulled.every(Number.isFinite));
  });

  inPage(set, "handles move a link: its frame is where they are, and turned as before", async (page) => {
    await open(page, "welding_arm");
    await page.keyboard.press("Escape");
    await page.evaluate(() => {
      const { app } = globalThis.urdd;
      app.move(app.store.now.robot.about.middle);
      app.select({ kind: "link", index: app.store.now.robot.link("torch") });
    });
    await page.getByRole("button", { name: "Move", exact: true }).click();
    await posed(page);
    const pose = () =>
      page.evaluate(() => {
        const { poses, selected } = globalThis.urdd.app.store.now;
        return [...poses.slice(7 * selected.index, 7 * selected.index + 7)];
      });
    const before = await pose();
    const start = await page.evaluate(() => {
      const { target, controls } = globalThis.urdd.stage.gizmo;
      const start = target.position.toArray();
      target.position.z -= 0.02;
      target.position.x -= 0.01;
      controls.dispatchEvent({ type: "objectChange" });
      return start;
    });
    start.forEach((x, k) => assert.ok(Math.abs(x - before[k]) < 1e-6));
    const expected = before.slice();
    expected[0] -= 0.01;
    expected[2] -= 0.02;
    await soon(async () => {
      const after = await pose();
      const turned = after.slice(3).reduce((sum, x, k) => sum + x * expected[3 + k], 0);
      after.slice(0, 3).forEach((x, k) => assert.ok(Math.abs(x - expected[k]) < 1e-5, `${after}: ${expected}`));
      assert.ok(Math.abs(turned) > 1 - 1e-9, `${after}: ${expected}`);
    });
    await page.getByRole("button", { name: "Move", exact: true }).click();
  });

  inPage(set, "skips from the nearest pairs: this one, all nearer, all relatively nearer, and back", async (page) => {
    await open(page, "welding_arm");
    await page.click("#tab-Proximity");
    await state(page, "proximity", (value) => value.answer !== null);
    await page.getByLabel("Kind of shapes").selectOption("hulls");
    const { answer } = await state(page, "proximity", (value) => value.answer !== null);
    const edits = async (count) =>
      (await state(page, "skips", ({ answer }) => answer?.edits.length === count)).answer.edits;
    await page.locator(".pair").nth(2).click();
    await page.getByRole("button", { name: "Skip this pair" }).click();
    const [third] = await edits(1);
    assert.deepEqual([third.link_a, third.link_b, third.skip], [...answer.nearest[2].links, true]);
    await page.getByRole("button", { name: "Skip all nearer" }).click();
    const nearer = (await edits(3)).slice(1).map(({ link_a, link_b }) => [link_a, link_b].sort());
    assert.deepEqual(
      nearer.sort(),
      answer.nearest
        .slice(0, 2)
        .map(({ links }) => links.toSorted())
        .sort(),
    );
    await page.click("#tab-Skips");
    await page.getByRole("button", { name: "Undo" }).click();
    await edits(1);
    await page.click("#tab-Proximity");
    await page.getByRole("button", { name: "Skip all relatively nearer" }).click();
    const relative = answer.nearest.filter((pair) => pair.relative < answer.nearest[2].relative).length;
    await edits(1 + relative);
    await page.click("#tab-Skips");
    await page.getByRole("button", { name: "Undo" }).click();
    await page.getByRole("button", { name: "Undo" }).click();
    await edits(0);
  });

  inPage(set, "distances are those of the library, and a pair shows its points", async (page) => {
    await open(page, "welding_arm");
    await page.click("#tab-Proximity");
    // More are listed there than are asked for elsewhere.
    const { answer } = await state(page, "proximity", ({ answer }) => answer?.nearest.length > 24);
    const text = run(
      "check-collisions",
      join(set.made.robots, "welding_arm"),
      "--format",
      "json",
      "--nearest",
      "128",
    ).stdout;
    const native = JSON.parse(text.trim().split("\n")[0]);
    assert.deepEqual(await state(page, "q"), native.values);
    assert.equal(answer.nearest.length, native.nearest.length);
    answer.nearest.forEach((pair, k) => {
      assert.ok(Math.abs(pair.distance - native.nearest[k].distance) < 1e-9);
      assert.deepEqual(pair.links, native.nearest[k].links);
    });
    assert.equal(answer.in_collision, native.in_collision);
    await page.locator(".pair").first().click();
    assert.notEqual(await state(page, "pair"), null);
    await page.waitForSelector(".segment:not([hidden])");
    await page.getByLabel("Kind of shapes").selectOption("boxes");
    await state(page, "proximity", (value) => value.answer !== null);
    assert.equal(await state(page, "shapes"), "boxes");
  });

  inPage(set, "shapes: layers, opacity, overlays, single links", async (page) => {
    await open(page, "welding_arm");
    await page.click("#tab-Shapes");
    for (const layer of ["collision", "plain", "hulls", "pieces", "boxes", "spheres", "piece-boxes", "piece-spheres"]) {
      await page.check(`#layer-${layer}`);
      await page.waitForFunction((layer) => globalThis.urdd.stage.scene.has(layer), layer);
    }
    for (const overlay of ["wireframe", "frames", "axes", "com", "inertia", "path"])
      await page.check(`#overlay-${overlay}`);
    await page.waitForTimeout(300);
    const faults = await page.evaluate(() => [...globalThis.urdd.app.store.now.faults.values()].flat());
    assert.deepEqual(faults, []);
    await page.getByRole("button", { name: "None" }).click();
    const meshes = () => page.evaluate(() => globalThis.urdd.stage.scene.meshes().length);
    await soon(async () => assert.equal(await meshes(), 0));
    await page.getByRole("button", { name: "All", exact: true }).click();
    await soon(async () => assert.ok((await meshes()) > 20));
  });

  inPage(set, "skips: decided, saved, validated, undone", async (page) => {
    await open(page, "welding_arm");
    const target = join(set.made.robots, "welding_arm");
    const file = join(target, "link_shapes_modules/link_shapes_skips_module/module.json");
    const before = readFileSync(file, "utf8");
    await page.click("#tab-Skips");
    await state(page, "skips", (value) => value.answer !== null);
    await page.evaluate(() => {
      const { app } = globalThis.urdd;
      const { robot } = app.store.now;
      app.store.set({
        pair: [
          [robot.link("torch"), 0],
          [robot.link("turret"), 0],
        ],
      });
    });
    await page.getByLabel("Reason").fill("a fence <b>");
    await page.getByRole("button", { name: "Skip", exact: true }).click();
    await state(page, "skips", (value) => value.dirty);
    await page.getByRole("button", { name: "Save", exact: true }).click();
    await page.waitForFunction(
      () => !globalThis.urdd.app.store.now.skips.dirty && globalThis.urdd.app.store.now.skips.saved === 1,
    );
    assert.deepEqual(read(file).edits, [{ link_a: "torch", link_b: "turret", skip: true, reason: "a fence <b>" }]);
    assert.equal(run("validate", "--fail-on", "info", target).status, 0);
    await drawn(page, "welding_arm");
    await page.click("#tab-Joints");
    await page.click("#tab-Skips");
    await page.getByRole("button", { name: "Undo the save" }).click();
    await page.waitForFunction(() => globalThis.urdd.app.store.now.skips.saved === 0);
    assert.equal(readFileSync(file, "utf8"), before);
  });

  inPage(set, "the page follows the files, and findings are those of the program", async (page) => {
    const target = join(set.made.robots, "gripper");
    const copy = join(set.made.folder, "gripper");
    cpSync(target, copy, { recursive: true });
    await open(page, "gripper");
    await page.click("#tab-Findings");
    const first = (await state(page, "report", (value) => value.report !== null)).report;
    assert.equal(first.urdds[0].verdict, "pass");
    const module = join(target, "dof_module/module.json");
    writeFileSync(module, readFileSync(module, "utf8").replace('"Angle"', '"Length"'));
    const { report } = await state(
      page,
      "report",
      (value) => value.report !== null && value.report.urdds[0].verdict === "fail",
    );
    assert.deepEqual(report, JSON.parse(run("validate", target, "--format", "json").stdout));
    await page.getByRole("button", { name: "Explain" }).first().click();
    await page.waitForSelector(".explanation p");
    await page.selectOption("#painted", "worst");
    cpSync(copy, target, { recursive: true });
    await state(page, "report", (value) => value.report !== null && value.report.urdds[0].verdict === "pass");
  });

  inPage(set, "a folder that is chosen is validated in the browser, with the program's findings", async (page) => {
    const target = join(set.made.robots, "planar_base_arm");
    await page.waitForSelector(".card");
    await page.locator('.drop input[type="file"]').first().setInputFiles(target);
    await drawn(page, "planar_base_arm");
    await page.click("#tab-Findings");
    const { report } = await state(page, "report", (value) => value.report !== null || value.error !== null);
    const native = JSON.parse(run("validate", target, "--format", "json").stdout);
    assert.deepEqual(report, native);
  });

  inPage(set, "a URDF without a robot, and a .zip without a URDD, are told so", async (page) => {
    await page.waitForSelector(".card");
    const file = page.locator('.drop input[type="file"]').nth(1);
    await file.setInputFiles({ name: "arm.urdf", mimeType: "text/xml", buffer: Buffer.from("<robot/>") });
    await soon(async () =>
      assert.match(await page.locator(".failure").textContent(), /arm\.urdf.*contains no `<link>`/),
    );
    await page.getByRole("button", { name: "Back" }).click();
    await file.setInputFiles({ name: "a.zip", mimeType: "application/zip", buffer: Buffer.from("PK nothing") });
    await page.waitForSelector(".failure:not([hidden])");
  });

  inPage(set, "a link opens the same view again", async (page) => {
    await open(page, "welding_arm");
    await page.click("#tab-Shapes");
    await page.locator(".links input").nth(1).uncheck();
    await page.locator(".links input").nth(2).uncheck();
    await page.locator(".joint .heading").first().dispatchEvent("click");
    await page.click("#tab-Proximity");
    await page.getByLabel("Kind of shapes").selectOption("hulls");
    await state(page, "proximity", (value) => value.answer !== null);
    await page.keyboard.press("r");
    await page.locator(".pair").nth(2).click();
    const seen = async () => {
      const { selected, pair, shapes, tab } = await page.evaluate(() => globalThis.urdd.app.store.now);
      const hidden = await page.evaluate(() => [...globalThis.urdd.app.store.now.hidden]);
      return { selected, pair, shapes, tab, hidden };
    };
    const before = await seen();
    assert.deepEqual(before.hidden, [1, 2]);
    assert.equal(before.selected.kind, "joint");
    assert.notEqual(before.pair, null);
    const q = await state(page, "q");
    // The address follows once nothing changed for a while.
    const url = await soon(() => {
      assert.match(page.url(), /r=welding_arm.*t=Proximity.*j=.*k=hulls.*p=.*x=1-2/);
      return page.url();
    });
    await page.goto("about:blank");
    await page.goto(url);
    await drawn(page, "welding_arm");
    const again = await state(page, "q");
    again.forEach((value, dof) => assert.ok(Math.abs(value - q[dof]) < 1e-4));
    assert.deepEqual(await seen(), before);
  });
});
