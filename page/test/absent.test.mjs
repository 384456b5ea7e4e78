// Meshes that were not found: said in colour, with links and names, beside the robot and where the layer is chosen.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { drawn, inPage, open, run, setting, soon, state, view } from "./world.mjs";

const joint = (
  name,
  parent,
  child,
) => `<joint name="${name}" type="revolute"><parent link="${parent}"/><child link="${child}"/>
  <origin xyz="0 0 0.5"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>`;

const set = setting(["gripper"], (made) => {
  const urdf = join(made.folder, "half.urdf");
  writeFileSync(
    urdf,
    `<robot name="half"><link name="base"><visual><geometry><box size="0.4 0.4 0.1"/></geometry></visual></link>
    <link name="upper"><visual><geometry><mesh filename="package://nowhere/upper.stl"/></geometry></visual>
      <collision><geometry><cylinder radius="0.05" length="0.4"/></geometry></collision></link>
    <link name="lower"><visual><geometry><mesh filename="lower.dae"/></geometry></visual>
      <visual><geometry><sphere radius="0.1"/></geometry></visual></link>
    <link name="tool"><visual><geometry><mesh filename="&lt;b&gt;.obj"/></geometry></visual></link>
    ${joint("a", "base", "upper")}${joint("b", "upper", "lower")}${joint("c", "lower", "tool")}</robot>`,
  );
  const done = run("generate", urdf, "-o", join(made.robots, "half"));
  assert.equal(done.status, 0, done.stderr);
  return view(made.robots);
});

inPage(set, "the picture, the header and the layer say which meshes were not found", async (page) => {
  await open(page, "half");
  const box = page.locator(".absent");
  await box.getByText("3 meshes were not found, of 3 links").waitFor();
  await box.locator("summary").click();
  assert.deepEqual(await box.locator("li").allTextContents(), [
    "upper: package://nowhere/upper.stl; its collision geometry is drawn instead",
    "lower: lower.dae; the rest of the link is drawn",
    "tool: <b>.obj; nothing is drawn",
  ]);
  await box.getByRole("button", { name: "lower" }).click();
  const { links } = await state(page, "robot");
  assert.equal(links[(await state(page, "selected")).index].name, "lower");
  // In the colour of warnings, which is told from that of other text.
  const colours = await page.evaluate(() => {
    const of = (selector) => globalThis.getComputedStyle(globalThis.document.querySelector(selector)).color;
    return [of(".absent summary"), of("body")];
  });
  assert.notEqual(colours[0], colours[1]);
  await box.getByRole("button", { name: "Close" }).click();
  assert.equal(await box.isVisible(), false);
  await page.getByRole("button", { name: "3 meshes not found" }).click();
  await box.waitFor();
  await page.click("#tab-Shapes");
  const layer = page.locator(".layer", { has: page.locator("#layer-original") });
  assert.match(await layer.textContent(), /3 meshes were not found: upper, lower, tool/);
});

inPage(set, "a robot whose meshes are all there says nothing", async (page) => {
  await open(page, "gripper");
  await soon(async () => assert.ok(await state(page, "contacts")));
  assert.equal(await page.locator(".absent").isVisible(), false);
  await open(page, "half");
  await drawn(page, "half");
  await page.locator(".absent").waitFor();
});
