// What a program shows beside the robot: obstacles and a path. `robot.frame(path=…, world=…)` writes it into the page.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { deflateRawSync } from "node:zlib";
import { inPage, run, setting, soon } from "./world.mjs";

const floats = (values) => Buffer.from(Float32Array.from(values).buffer).toString("base64");
const whole = (values) => Buffer.from(Uint32Array.from(values).buffer).toString("base64");
const at = (x, y, z) => [1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1];
const cube = [0, 1].flatMap((x) => [0, 1].flatMap((y) => [0, 1].map((z) => [x, y, z]))).flat();

/** Each kind, and the box around it. A cylinder and a capsule are along z. */
const WORLD = [
  [{ kind: "cuboid", half_extents: [0.1, 0.2, 0.3] }, at(1, 2, 3), [0.9, 1.8, 2.7], [1.1, 2.2, 3.3]],
  [{ kind: "sphere", radius: 0.25 }, at(1, 0, 0), [0.75, -0.25, -0.25], [1.25, 0.25, 0.25]],
  [{ kind: "capsule", radius: 0.1, half_length: 0.4 }, at(0, 1, 0), [-0.1, 0.9, -0.5], [0.1, 1.1, 0.5]],
  [{ kind: "cylinder", radius: 0.1, half_length: 0.4 }, at(0, 1, 0), [-0.1, 0.9, -0.4], [0.1, 1.1, 0.4]],
  [{ kind: "hull", points: floats(cube) }, at(2, 0, 0), [2, 0, 0], [3, 1, 1]],
  [{ kind: "mesh", vertices: floats(cube), faces: whole([0, 1, 7, 0, 7, 2]) }, at(0, 0, 5), [0, 0, 5], [1, 1, 6]],
  [{ kind: "points", points: floats(cube), radius: 0.05 }, at(0, 0, 0), [-0.05, -0.05, -0.05], [1.05, 1.05, 1.05]],
  [
    // Two rows along y, three columns along x.
    {
      kind: "height_field",
      heights: floats([1, 1, 1, 1, 1, 2]),
      columns: 3,
      cell: [0.5, 0.25],
      thickness: 0.5,
    },
    at(0, 0, 0),
    [-0.25, -0.125, 0.5],
    [1.25, 0.375, 2],
  ],
];

const PATH = { times: [0, 1, 3], rows: [0, 1, 2].map((row) => Array.from({ length: 6 }, () => 0.1 * row)) };

async function page(made) {
  const file = join(made.folder, "one.html");
  const done = run("view", join(made.robots, "welding_arm"), "--export", file);
  assert.equal(done.status, 0, done.stderr);
  const world = WORLD.map(([shape, pose], k) => ({ name: `body ${k}`, pose, shape }));
  const packed = deflateRawSync(JSON.stringify({ q: PATH.rows[2], path: PATH, world })).toString("base64");
  const carried = `<script type="text/plain" id="showing.json">${packed}</script>`;
  const text = readFileSync(file, "utf8").replace(
    '<script type="text/plain" id="robots.json">',
    (tag) => carried + tag,
  );
  writeFileSync(file, text);
  return { address: pathToFileURL(file).href, end: () => undefined };
}

const set = setting(["welding_arm"], page);

inPage(set, "obstacles of each kind are where they are, and a path is played", async (page) => {
  await page.waitForFunction(() => globalThis.urdd?.app.store.now.path, null, { timeout: 120_000 });
  const boxes = await page.evaluate(() => {
    const { obstacles } = globalThis.urdd.stage;
    return obstacles.boxes().map(({ min, max }) => [min.toArray(), max.toArray()]);
  });
  assert.equal(boxes.length, WORLD.length);
  WORLD.forEach(([shape, , low, high], k) => {
    const [min, max] = boxes[k];
    // A round body of facets is within 1 % of its size.
    [...low, ...high].forEach((value, axis) => {
      const found = [...min, ...max][axis];
      assert.ok(Math.abs(found - value) < 0.01, `${shape.kind}: ${found} for ${value}`);
    });
  });
  const q = () => page.evaluate(() => globalThis.urdd.app.store.now.q);
  // The path begins at its first row; on the way, between two of them.
  await soon(async () => assert.deepEqual(await q(), PATH.rows[0]));
  await page.locator('.timeline input[type="range"]').evaluate((slider) => {
    slider.value = "2";
    slider.dispatchEvent(new globalThis.Event("input"));
  });
  await soon(async () => {
    const found = await q();
    found.forEach((value) => assert.ok(Math.abs(value - 0.15) < 1e-12, `${value}`));
  });
});
