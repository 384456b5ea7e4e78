// The levels of spheres of a URDD: what the panel says of them, and what is drawn, against the module read here.

import assert from "node:assert/strict";
import { cpSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { inPage, open, repository, run, setting, view } from "./world.mjs";

const MODULE = "link_shapes_modules/link_shapes_spheres_module/module.json";

const set = setting(["gripper"], (made) => {
  const urdf = join(repository, "conformance/robots/six_axis_arm.urdf");
  const done = run("generate", urdf, "-o", join(made.robots, "arm"), "--modules", "all,spheres");
  assert.equal(done.status, 0, done.stderr);
  cpSync(join(made.robots, "arm"), join(made.robots, "hostile"), { recursive: true });
  const file = join(made.robots, "hostile", MODULE);
  const module = JSON.parse(readFileSync(file, "utf8"));
  Object.assign(module.levels[0], {
    spheres: [null, [{ radius: -1, offset_xyz: [0, 0, 0] }, 7], [{ radius: 1 }]],
    fits: 3,
  });
  module.levels[1] = null;
  writeFileSync(file, JSON.stringify(module));
  return view(made.robots);
});

/** What is drawn of a layer: its meshes, and the sum of their radii. */
function drawnOf(page, layer) {
  return page.evaluate((layer) => {
    let [count, radii] = [0, 0];
    globalThis.urdd.stage.view.scene.traverse((object) => {
      if (object.userData?.of?.layer !== layer) return;
      count++;
      radii += object.scale.x;
    });
    return [count, radii];
  }, layer);
}

const labels = (page) =>
  page.locator(".layer:visible label[for^='layer-level-']").evaluateAll((all) => all.map((one) => one.textContent));

inPage(set, "each level has a line, and is drawn by itself", async (page) => {
  await open(page, "arm");
  await page.click("#tab-Shapes");
  const { levels } = JSON.parse(readFileSync(join(set.made.robots, "arm", MODULE), "utf8"));
  const found = await labels(page);
  assert.equal(found.length, levels.length);
  for (const [number, { spheres, covers, fits }] of levels.entries()) {
    const all = spheres.flat();
    const most = Math.max(...fits.filter(Boolean).map((fit) => fit.max_standoff));
    assert.equal(found[number], `Level ${number}: ${all.length}`);
    const said = new RegExp(`^${covers ? "They cover the links," : "Fitted:"} at most ([\\d.]+) mm off`);
    const fit = await page.locator(".level:visible").nth(number).textContent();
    const [, far] = said.exec(fit) ?? assert.fail(fit);
    assert.ok(Math.abs(Number(far) - 1000 * most) <= 0.006 * 1000 * most + 0.01, `${far} ${most}`);
    await page.check(`#layer-level-${number}`);
    await page.waitForFunction(() => globalThis.urdd.app.store.now.loading === null);
    const expected = all.reduce((sum, { radius }) => sum + radius, 0);
    await page.waitForTimeout(200);
    const [count, radii] = await drawnOf(page, `level-${number}`);
    assert.equal(count, all.length);
    assert.ok(Math.abs(radii - expected) < 1e-9 * expected);
  }
});

inPage(
  set,
  "a robot without spheres has no lines for them, and a broken module draws what can be drawn",
  async (page) => {
    await open(page, "gripper");
    await page.click("#tab-Shapes");
    assert.deepEqual(await labels(page), []);
    await open(page, "hostile");
    assert.equal((await labels(page))[0], "Level 0: 0");
    await page.check("#layer-level-0");
    await page.check("#layer-level-2");
    await page.waitForTimeout(300);
    assert.equal((await drawnOf(page, "level-0"))[0], 0);
    assert.ok((await drawnOf(page, "level-2"))[0] > 50);
  },
);
