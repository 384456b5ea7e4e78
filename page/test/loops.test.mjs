// Kinematic loops: what follows does, what is open is said, in the panel and in the picture.

import assert from "node:assert/strict";
import { join } from "node:path";
import { drawn, inPage, repository, setting, soon, view } from "./world.mjs";

const set = setting([], () => view(join(repository, "examples/robots/pinch_gripper.urdf")));

const shown = (page) =>
  page.evaluate(() => {
    const { q, robot } = globalThis.urdd.app.store.now;
    return Object.fromEntries(robot.dofs.map(({ name }, dof) => [name.replace("_joint", ""), q[dof]]));
  });
const said = (page) => page.locator(".loops-said").textContent();
const isSaid = (page, words) => soon(async () => assert.match(await said(page), words));
const slide = (page, dof, value) =>
  page.evaluate(
    ([dof, value]) => {
      const slider = globalThis.document.querySelector(`input[type=range][aria-label="${dof}_joint"]`);
      slider.value = String(value);
      slider.dispatchEvent(new globalThis.Event("input"));
    },
    [dof, value],
  );
const near = (found, expected, tolerance = 1e-6) =>
  assert.ok(Math.abs(found - expected) < tolerance, `${found} ${expected}`);

inPage(set, "a robot with loops opens closed, and what follows does", async (page) => {
  await drawn(page, "pinch_gripper");
  await isSaid(page, /^2 loops and 1 coupling, closed\. 1 DOF moves freely\.$/);
  assert.equal(await page.locator(".loop-ends .segment:visible").count(), 0);
  const before = await shown(page);
  // Farther than one step: it stays on its branch.
  await slide(page, "left_driver", 0.8);
  await soon(async () => near((await shown(page)).left_driver, 0.8));
  const after = await shown(page);
  for (const part of ["driver", "finger", "follower"]) near(after[`right_${part}`], -after[`left_${part}`]);
  assert.ok(Math.abs(after.left_follower - before.left_follower) > 0.05);
  await isSaid(page, /closed/);
  // One that follows moves the others. After a pause, it is another step for undo.
  await page.waitForTimeout(400);
  await slide(page, "right_driver", 0.25);
  await soon(async () => near((await shown(page)).right_driver, 0.25));
  near((await shown(page)).left_driver, -0.25);
  await isSaid(page, /closed/);
  // Joints that follow say so.
  const kinds = await page.locator(".joint .kind").allTextContents();
  assert.equal(kinds.filter((kind) => kind.endsWith("· follows")).length, 5);
  assert.equal(await page.locator("#joint-0 .kind").textContent(), "revolute");
  // Undo takes the whole robot back.
  await page.getByRole("button", { name: "Undo the last move" }).click();
  await soon(async () => near((await shown(page)).left_driver, 0.8));
  await isSaid(page, /closed/);
});

inPage(set, "a loop that is open is red with its gap", async (page) => {
  await drawn(page, "pinch_gripper");
  await isSaid(page, /closed/);
  await page.getByRole("button", { name: "Zero" }).click();
  await isSaid(page, /^2 of 2 loops open:$/);
  const lines = await page.locator(".loops li").allTextContents();
  assert.match(lines.join("; "), /^left_pin: 4\.24 mm apart; right_pin: 4\.24 mm apart$/);
  await soon(async () => assert.equal(await page.locator(".loop-ends .segment.alarming:visible").count(), 2));
  assert.match((await page.locator(".loop-ends .segment:visible").first().textContent()) ?? "", /4\.24 mm/);
  // Without the overlay, the panel still says it.
  await page.getByRole("tab", { name: "Shapes" }).click();
  await page.getByLabel("Ends of loops").uncheck();
  await soon(async () => assert.equal(await page.locator(".loop-ends .segment:visible").count(), 0));
  await page.getByLabel("Ends of loops").check();
  await page.getByRole("tab", { name: "Joints" }).click();
  // A joint is moved alone, where a person wants it.
  await page.getByRole("button", { name: "Closed", exact: true }).click();
  await isSaid(page, /closed/);
  const before = await shown(page);
  await page.getByLabel("Keep loops closed").uncheck();
  await slide(page, "left_driver", 0.7);
  await soon(async () => near((await shown(page)).left_driver, 0.7));
  near((await shown(page)).left_follower, before.left_follower, 1e-12);
  await isSaid(page, /open/);
  // Kept closed again, it closes from where it is.
  await page.getByLabel("Keep loops closed").check();
  await isSaid(page, /closed/);
});
