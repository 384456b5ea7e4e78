// Two robots side by side, and two points of one robot.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { serve } from "../../docs/site/serve.mjs";
import { drawn, inPage, open, repository, run, setting, soon, state, tab, view } from "./world.mjs";

const ours = join(repository, "conformance/robots");
const folder = mkdtempSync(join(tmpdir(), "urdd-compare-"));
after(() => rmSync(folder, { recursive: true, force: true }));
const urdf = readFileSync(join(ours, "welding_arm.urdf"), "utf8");
/** The text with one of its parts replaced, where it is after a mark. */
const changed = (text, mark, from, to) => {
  const at = text.indexOf(from, text.indexOf(mark));
  assert.ok(at > 0, from);
  return text.slice(0, at) + to + text.slice(at + from.length);
};
let text = urdf;
text = changed(text, '<link name="upper_arm"', '<mass value="6"/>', '<mass value="6.5"/>');
text = changed(text, '<joint name="axis_3"', 'xyz="0 0 0.42"', 'xyz="0 0.03 0.46"');
text = changed(text, '<joint name="axis_5"', 'velocity="4"', 'velocity="9"');
text = changed(text, '<link name="wrist"', "wrist.glb", "turret.obj");
text = text.replace('<link name="camera"', '<link name="lidar"').replace('<child link="camera"', '<child link="lidar"');
writeFileSync(join(folder, "after.urdf"), text);
for (const name of ["package.xml", "meshes"]) symlinkSync(join(ours, name), join(folder, name));

const set = setting(["welding_arm"], (made) => view(join(made.robots, "welding_arm"), join(folder, "after.urdf")));

inPage(set, "another robot stands beside this one, with what differs", async (page) => {
  await open(page, "after");
  await page.getByLabel("Compare with").selectOption("welding_arm");
  const list = page.locator(".compared");
  await list.waitFor();
  assert.match(await list.textContent(), /Left: welding_arm.*6 links differ: 1 new, 1 gone, 1 moved, 3 changed/s);
  const lines = (await list.locator("li").allTextContents()).map((line) => line.replace("■ ", ""));
  assert.deepEqual(
    lines.sort(),
    [
      "camera gone",
      "forearm moved by 50 mm",
      "flange velocity 4 → 9",
      "lidar new",
      "upper_arm mass 6 → 6.5 kg",
      "wrist another shape",
    ].sort(),
  );
  // It moves along, and has the same pose but for the place and what was moved.
  const base = () =>
    page.evaluate(() => {
      const { app, stage } = globalThis.urdd;
      const { robot, compared, poses } = app.store.now;
      const place = (model, all, name) => [...all.subarray(7 * model.link(name), 7 * model.link(name) + 3)];
      const [one, two] = ["upper_arm", "forearm"].map((name) => [
        place(robot, poses, name),
        place(compared.model, compared.poses, name),
      ]);
      return { one, two, apart: stage.scene.bounds().min.y - stage.beside.scene.bounds().max.y };
    });
  await page.evaluate(() => globalThis.urdd.app.move([0.4, 0, 0, 0, 0, 0]));
  await soon(async () => {
    const { one, two } = await base();
    one[0].forEach((value, k) => assert.ok(Math.abs(value - one[1][k]) < 1e-9));
    const [x, y, z] = two[0].map((value, k) => value - two[1][k]);
    assert.ok(Math.abs(x + 0.03 * Math.sin(0.4)) < 1e-9 && Math.abs(y - 0.03 * Math.cos(0.4)) < 1e-9, `${x} ${y}`);
    assert.ok(Math.abs(z - 0.04) < 1e-9);
  });
  await page.evaluate(() => globalThis.urdd.app.move([0, 0, 0, 0, 0, 0]));
  await soon(async () => {
    const { apart } = await base();
    assert.ok(apart > 0.1, `${apart}`);
  });
  // A link to the view has it, and the list ends it.
  await soon(() => assert.match(new URL(page.url()).hash, /v=welding_arm/));
  await page.reload();
  await drawn(page, "after");
  await state(page, "compared");
  await page.getByRole("button", { name: "End the comparison" }).click();
  await soon(async () => assert.equal(await page.evaluate(() => globalThis.urdd.stage.beside.scene), null));
  assert.equal(await list.isVisible(), false);
});

/** That the second robot is open, with the first beside it, and that they differ as they do. */
async function compared(page) {
  await drawn(page, "after");
  const list = page.locator(".compared");
  await list.waitFor();
  assert.match(await list.textContent(), /Left: welding_arm.*6 links differ: 1 new, 1 gone, 1 moved, 3 changed/s);
  const { changes } = await state(page, "compared");
  assert.equal(changes.find(({ link }) => link === "forearm").change, "moved");
}

test("--compare opens the second robot beside the first", { timeout: 300_000 }, async () => {
  const server = await view("--compare", join(ours, "welding_arm.urdf"), join(folder, "after.urdf"));
  const { page, faults, close } = await tab(set.chrome, server.address);
  await compared(page);
  assert.match(new URL(page.url()).hash, /^#r=after&.*v=welding_arm/);
  assert.doesNotMatch(page.url(), /token/);
  assert.deepEqual(faults, []);
  await close();
  server.end();
});

test("an exported comparison opens so, once, and the gallery is behind it", { timeout: 300_000 }, async (t) => {
  const site = join(folder, "site");
  const done = run(
    "view",
    "--compare",
    join(set.made.robots, "welding_arm"),
    join(folder, "after.urdf"),
    "--export",
    site,
  );
  assert.equal(done.status, 0, done.stderr);
  const server = await serve(site);
  t.after(() => server.end());
  const { page, faults, close } = await tab(set.chrome, server.address);
  await compared(page);
  await page.getByRole("button", { name: "All robots" }).click();
  await page.locator(".card").nth(1).waitFor();
  await open(page, "welding_arm");
  assert.equal(await page.locator(".compared").isVisible(), false);
  assert.deepEqual(faults, []);
  await close();
});

inPage(set, "the distance of two clicked points, which stay on their links", async (page) => {
  await open(page, "welding_arm");
  await page.getByRole("button", { name: "Measure" }).click();
  const box = await page.locator("#picture").boundingBox();
  const spots = await page.evaluate(() => {
    const { app, stage } = globalThis.urdd;
    return ["base", "turret"].map((name) => {
      const bounds = stage.scene.bounds(new Set([app.store.now.robot.link(name)]));
      return stage.view.place(bounds.getCenter(bounds.min.clone()));
    });
  });
  for (const { x, y } of spots) await page.mouse.click(box.x + x, box.y + y);
  const label = page.locator(".segment:visible");
  const shown = async () => {
    const [, length, parts] = /^([\d.]+) mm \((.*) mm\)$/.exec(await label.textContent());
    return [Number(length), parts.split(", ").map((part) => Number(part.replace("−", "-")))];
  };
  const [length, parts] = await shown();
  // What three.js finds under the pointer, computed with its own ray.
  const expected = await page.evaluate(
    ([box, spots]) => {
      const { stage } = globalThis.urdd;
      return spots.map(({ x, y }) => {
        const [hit] = stage.view.ray(box.x + x, box.y + y).intersectObjects(stage.scene.meshes(), false);
        return hit.point.toArray();
      });
    },
    [box, spots],
  );
  const apart = expected[1].map((value, k) => 1000 * (value - expected[0][k]));
  assert.ok(Math.abs(length - Math.hypot(...apart)) < 0.1, `${length} ${apart}`);
  parts.forEach((value, k) => assert.ok(Math.abs(value - apart[k]) < 0.1, `${parts} ${apart}`));
  assert.equal(await page.evaluate(() => globalThis.urdd.app.store.now.selected), null);
  // The turret turns by half a turn about the vertical axis of the base.
  await page.evaluate(() => globalThis.urdd.app.move([Math.PI / 2, 0, 0, 0, 0, 0]));
  await soon(async () => {
    const [x, y, z] = expected[1];
    const turned = [-y, x, z].map((value, k) => 1000 * (value - expected[0][k]));
    (await shown())[1].forEach((value, k) => assert.ok(Math.abs(value - turned[k]) < 0.1, `${value} ${turned}`));
  });
  await page.keyboard.press("Escape");
  assert.equal(await label.count(), 0);
});

inPage(set, "the ground has a shadow, and a scale in words", async (page) => {
  await open(page, "welding_arm");
  const darkest = (grid) =>
    page.evaluate(async (grid) => {
      const { app, stage } = globalThis.urdd;
      app.store.set({ overlays: { ...app.store.now.overlays, grid } });
      stage.look("top");
      const picture = await globalThis.createImageBitmap(await stage.view.picture());
      const canvas = new globalThis.OffscreenCanvas(picture.width, picture.height);
      const context = canvas.getContext("2d");
      context.drawImage(picture, 0, 0);
      const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
      let n = 0;
      for (let k = 0; k < data.length; k += 4) if (data[k] + data[k + 1] + data[k + 2] < 85) n++;
      return n / (data.length / 4);
    }, grid);
  assert.ok((await darkest(true)) > 0.005, `${await darkest(true)}`);
  assert.ok((await darkest(false)) < 0.001, `${await darkest(false)}`);
  assert.equal(await page.locator(".howto span").first().textContent(), "");
  await darkest(true);
  assert.equal(await page.locator(".howto span").first().textContent(), "A square of the ground: 200 mm");
  // The spacing of the lines that are drawn.
  const step = await page.evaluate(() => {
    const lines = globalThis.urdd.stage.view.scene.children.flatMap(({ children }) =>
      children.filter(({ type }) => type === "LineSegments"),
    );
    const xs = lines.flatMap(({ geometry }) =>
      [...geometry.getAttribute("position").array].filter((_, k) => k % 3 === 0),
    );
    const sorted = [...new Set(xs.map((x) => x.toFixed(4)))].map(Number).sort((a, b) => a - b);
    return sorted[1] - sorted[0];
  });
  assert.ok(Math.abs(step - 0.2) < 1e-3, `${step}`);
});
