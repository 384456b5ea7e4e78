// The page as a person uses it: every panel by clicking, typing and dragging; numbers against the program.

import assert from "node:assert/strict";
import { cpSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { allNames, browser, drawn, open, program, read, robots, run, state, tab, view } from "./world.mjs";

assert.ok(program);
let chrome;
let made;
let server;

before(async () => {
  made = robots(allNames());
  server = await view(made.robots);
  chrome = await browser();
});

after(async () => {
  await chrome?.close();
  server?.end();
  made?.remove();
});

/** A test with a page of its own, which ends without any console error, and without a request elsewhere. */
function inPage(name, act, options = {}) {
  test(name, { timeout: 300_000 }, async () => {
    const { page, faults, close } = await tab(chrome, options.address?.() ?? server.address, options);
    try {
      await act(page);
      assert.deepEqual(faults, options.faults ?? []);
    } finally {
      await close();
    }
  });
}

describe("the page", { concurrency: false }, () => {
  inPage("the token leaves the address, and a reload still works", async (page) => {
    await page.waitForSelector(".card");
    assert.ok(!page.url().includes("token"), page.url());
    await page.reload();
    await page.waitForSelector(".card");
    assert.equal(await page.locator(".card").count(), 9);
    await page.getByRole("searchbox", { name: "Find a robot" }).fill("weld");
    assert.equal(await page.locator(".card").count(), 1);
  });

  inPage("links are drawn where the kinematics samples have them, on all nine robots", async (page) => {
    for (const name of allNames()) {
      await open(page, name);
      const { samples } = read(join(made.robots, name, "kinematics_samples_module/module.json"));
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

  inPage("joints: slider, number, copy, paste, keys, samples", async (page) => {
    await open(page, "welding_arm");
    const zero = await state(page, "q");
    const entry = page.locator(".joint").first().getByRole("spinbutton");
    await entry.fill("30");
    await entry.press("Enter");
    const q = await state(page, "q");
    assert.ok(Math.abs(q[0] - Math.PI / 6) < 1e-9, String(q));
    assert.match(await page.locator(".row").nth(1).textContent(), /30°/);
    await page.locator(".joint").first().getByRole("slider").focus();
    await page.keyboard.press("End");
    const { bounds } = read(join(made.robots, "welding_arm/bounds_module/module.json"));
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
    await page.getByRole("button", { name: "Stop" }).click();
  });

  inPage("a joint follows the pointer in the picture, and a link is selected by a click", async (page) => {
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
    await page.waitForTimeout(300);
    const q = await state(page, "q");
    assert.equal(q.filter((value, dof) => value !== before[dof]).length, 1, `${before} ${q}`);
    await page.keyboard.down("Shift");
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    for (let step = 1; step <= 8; step++) await page.mouse.move(at.x - 4 * step, at.y - 4 * step);
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await page.waitForTimeout(300);
    const pulled = await state(page, "q");
    assert.ok(pulled.every(Number.isFinite));
  });

  inPage("distances are those of the library, and a pair shows its points", async (page) => {
    await open(page, "welding_arm");
    await page.click("#tab-Proximity");
    const { answer } = await state(page, "proximity", (value) => value.answer !== null);
    const text = run(
      "check-collisions",
      join(made.robots, "welding_arm"),
      "--format",
      "json",
      "--nearest",
      "24",
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
    await page.waitForSelector(".witness:not([hidden])");
    await page.getByLabel("Shapes that distances are between").selectOption("boxes");
    await state(page, "proximity", (value) => value.answer !== null);
    assert.equal(await state(page, "shapes"), "boxes");
  });

  inPage("shapes: layers, opacity, overlays, single links", async (page) => {
    await open(page, "welding_arm");
    await page.click("#tab-Shapes");
    for (const layer of ["plain", "hulls", "pieces", "boxes", "spheres", "piece-boxes", "piece-spheres"]) {
      await page.check(`#layer-${layer}`);
      await page.waitForFunction((layer) => globalThis.urdd.stage.scene.has(layer), layer);
    }
    for (const overlay of ["wireframe", "frames", "axes", "com", "inertia", "path"])
      await page.check(`#overlay-${overlay}`);
    await page.waitForTimeout(300);
    const faults = await page.evaluate(() => [...globalThis.urdd.app.store.now.faults.values()].flat());
    assert.deepEqual(faults, []);
    await page.getByRole("button", { name: "None" }).click();
    assert.equal(await page.evaluate(() => globalThis.urdd.stage.scene.meshes().length), 0);
    await page.getByRole("button", { name: "All", exact: true }).click();
    assert.ok((await page.evaluate(() => globalThis.urdd.stage.scene.meshes().length)) > 20);
  });

  inPage("skips: decided, saved, validated, undone", async (page) => {
    await open(page, "welding_arm");
    const target = join(made.robots, "welding_arm");
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

  inPage("the page follows the files, and findings are those of the program", async (page) => {
    const target = join(made.robots, "gripper");
    const copy = join(made.folder, "gripper");
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
    await page.check("#painted");
    cpSync(copy, target, { recursive: true });
    await state(page, "report", (value) => value.report !== null && value.report.urdds[0].verdict === "pass");
  });

  inPage("a folder that is chosen is validated in the browser, with the program's findings", async (page) => {
    const target = join(made.robots, "planar_base_arm");
    await page.waitForSelector(".card");
    await page.locator('input[type="file"]').first().setInputFiles(target);
    await drawn(page, "planar_base_arm");
    await page.click("#tab-Findings");
    const { report } = await state(page, "report", (value) => value.report !== null || value.error !== null);
    const native = JSON.parse(run("validate", target, "--format", "json").stdout);
    assert.deepEqual(report, native);
  });

  inPage("what is no URDD is told so", async (page) => {
    await page.waitForSelector(".card");
    const file = page.locator('input[type="file"]').nth(1);
    await file.setInputFiles({ name: "arm.urdf", mimeType: "text/xml", buffer: Buffer.from("<robot/>") });
    assert.match(await page.locator(".failure").textContent(), /urdd generate arm\.urdf/);
    await page.getByRole("button", { name: "Back" }).click();
    await file.setInputFiles({ name: "a.zip", mimeType: "application/zip", buffer: Buffer.from("PK nothing") });
    await page.waitForSelector(".failure:not([hidden])");
  });

  inPage("a link opens the same view again", async (page) => {
    await open(page, "welding_arm");
    await page.click("#tab-Proximity");
    await page.keyboard.press("r");
    await page.waitForTimeout(900);
    const q = await state(page, "q");
    const url = page.url();
    assert.match(url, /r=welding_arm.*t=Proximity/);
    await page.goto("about:blank");
    await page.goto(url);
    await drawn(page, "welding_arm");
    const again = await state(page, "q");
    again.forEach((value, dof) => assert.ok(Math.abs(value - q[dof]) < 1e-4));
    assert.equal(await state(page, "tab"), "Proximity");
  });
});
