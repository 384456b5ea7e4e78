// The Info panel: the pose of the selected link, in the frame of any other.

import assert from "node:assert/strict";
import { drawn, inPage, setting, soon, state } from "./world.mjs";

const set = setting(["welding_arm"]);

inPage(set, "the pose of the selected link in the frame of another, as position, rpy and quaternion", async (page) => {
  await drawn(page, "welding_arm");
  await page.evaluate(() => {
    const { app } = globalThis.urdd;
    const { robot } = app.store.now;
    app.move(robot.dofs.map((_, k) => 0.3 + 0.1 * k));
    app.select({ kind: "link", index: robot.link("torch") });
  });
  await page.click("#tab-Info");
  // The rotation of rpy about fixed axes, and of the quaternion, beside that of the poses themselves.
  const shown = () =>
    page.evaluate(() => {
      const rows = [...globalThis.document.querySelectorAll("#pose-base + .table dd")].map((row) => row.textContent);
      const numbers = (row) =>
        row
          .replaceAll("−", "-")
          .match(/-?[\d.]+(?:e-?\d+)?/g)
          .map(Number);
      return rows.map((row) => numbers(row).map((value) => (row.endsWith(" mm") ? value / 1000 : value)));
    });
  const expected = (base) =>
    page.evaluate((base) => {
      const { robot, poses } = globalThis.urdd.app.store.now;
      const of = (name) => [...poses.slice(7 * robot.link(name), 7 * robot.link(name) + 7)];
      return [of(base), of("torch")];
    }, base);
  const matrix = ([w, x, y, z]) => [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
  const times = (a, b) => a.map((row) => b[0].map((_, k) => row.reduce((sum, value, i) => sum + value * b[i][k], 0)));
  const transposed = (a) => a[0].map((_, k) => a.map((row) => row[k]));
  const near = (a, b) => a.flat().forEach((value, k) => assert.ok(Math.abs(value - b.flat()[k]) < 2e-4, `${a} ${b}`));
  for (const base of ["base", "wrist", "torch"]) {
    await page.selectOption("#pose-base", { label: base });
    const [from, to] = await expected(base);
    await soon(async () => {
      const [position, [roll, pitch, yaw], quaternion] = await shown();
      const back = transposed(matrix(from.slice(3)));
      const turn = times(back, matrix(to.slice(3)));
      const apart = [0, 1, 2].map((k) => [to[k] - from[k]]);
      near([position], transposed(times(back, apart)));
      near(matrix(quaternion), turn);
      const [c, s] = [Math.cos, Math.sin];
      const x = [
        [1, 0, 0],
        [0, c(roll), -s(roll)],
        [0, s(roll), c(roll)],
      ];
      const y = [
        [c(pitch), 0, s(pitch)],
        [0, 1, 0],
        [-s(pitch), 0, c(pitch)],
      ];
      const z = [
        [c(yaw), -s(yaw), 0],
        [s(yaw), c(yaw), 0],
        [0, 0, 1],
      ];
      near(times(z, times(y, x)), turn);
    });
  }
  await page.evaluate(() => globalThis.urdd.app.select(null));
  await page.locator("#pose-base").waitFor({ state: "hidden" });
  assert.equal(await state(page, "tab"), "Info");
});
