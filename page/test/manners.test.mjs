// Small things that a person notices: steps of sliders, units, poses taken back, sweeps, names, and buttons that stay.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { inPage, open, run, setting, soon, state, view } from "./world.mjs";

const set = setting(["welding_arm"], (made) => {
  const urdf = join(made.folder, "dark.urdf");
  const black = `<material name="black"><color rgba="0.01 0.01 0.01 1"/></material>`;
  const joint = (
    name,
    parent,
    child,
    axis,
    type,
    bounds,
  ) => `<joint name="${name}" type="${type}"><parent link="${parent}"/>
    <child link="${child}"/><origin xyz="0 0 0.6"/><axis xyz="${axis}"/><limit ${bounds} effort="1" velocity="20"/></joint>`;
  writeFileSync(
    urdf,
    `<robot name="dark"><link name="a"><visual><geometry><box size="0.5 0.5 0.5"/></geometry>${black}</visual></link>
    <link name="b"><visual><geometry><sphere radius="0.3"/></geometry>${black}</visual></link>
    <link name="c"><visual><geometry><box size="0.1 0.1 0.3"/></geometry>${black}</visual></link>
    ${joint("turn", "a", "b", "0 0 1", "revolute", `lower="-6.28" upper="6.28"`)}
    ${joint("slide", "b", "c", "0 0 1", "prismatic", `lower="0" upper="0.4"`)}</robot>`,
  );
  const done = run("generate", urdf, "-o", join(made.robots, "dark"));
  assert.equal(done.status, 0, done.stderr);
  return view(made.robots);
});

const near = (a, b, within) => assert.ok(Math.abs(a - b) < within, `${a} ${b}`);

inPage(set, "sliders have fine steps, values are whole, and units are changed once for all", async (page) => {
  await open(page, "dark");
  const slider = page.getByRole("slider", { name: "turn" });
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  near((await state(page, "q"))[0], Math.PI / 1800, 1e-12);
  // 40 pixels with Shift: a tenth of what they are without.
  const box = await slider.boundingBox();
  await page.keyboard.down("Shift");
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 40, box.y + box.height / 2, { steps: 8 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  near((await state(page, "q"))[0], Math.PI / 1800 + (40 * 12.56) / box.width / 10, 0.02);
  const entry = page.getByRole("spinbutton", { name: "turn, degrees" });
  await entry.fill("-124.88");
  await entry.press("Enter");
  near((await state(page, "q"))[0], (-124.88 * Math.PI) / 180, 1e-9);
  await entry.blur();
  const [inside, room] = await entry.evaluate((input) => [input.scrollWidth, input.clientWidth]);
  assert.ok(inside <= room && (await entry.inputValue()) === "-124.88", `${inside} in ${room}`);
  await page.getByRole("button", { name: "Angles in degrees" }).click();
  await page.getByRole("button", { name: "Lengths in millimetres" }).click();
  assert.equal(await page.getByRole("spinbutton", { name: "turn, radians" }).inputValue(), "-2.1796");
  const slide = page.getByRole("spinbutton", { name: "slide, metres" });
  await slide.fill("0.123");
  await slide.press("Enter");
  near((await state(page, "q"))[1], 0.123, 1e-12);
  await soon(async () => assert.match(await page.locator(".row", { hasText: "c" }).last().textContent(), /0\.123 m$/));
  await page.click("#tab-Proximity");
  await soon(async () => assert.match(await page.locator(".pairs").innerText(), /\d m\b/));
  assert.ok(!/mm/.test(await page.locator(".pairs").innerText()));
  await page.reload();
  await page.getByRole("button", { name: "Angles in radians" }).waitFor();
});

inPage(set, "poses are taken back and made again", async (page) => {
  await open(page, "welding_arm");
  const zero = await state(page, "q");
  await page.getByRole("button", { name: "Middle" }).click();
  const middle = await state(page, "q", (q) => q.some((value) => value !== 0));
  await page.waitForTimeout(400);
  await page.getByRole("button", { name: "Random", exact: true }).click();
  const random = await state(page, "q", (q) => q.some((value, dof) => value !== middle[dof]));
  await page.keyboard.press("Control+z");
  assert.deepEqual(await state(page, "q"), middle);
  await page.getByRole("button", { name: "Undo the last move" }).click();
  assert.deepEqual(await state(page, "q"), zero);
  await page.keyboard.press("Control+Shift+Z");
  await page.keyboard.press("Control+Shift+Z");
  assert.deepEqual(await state(page, "q"), random);
});

inPage(
  set,
  "a sweep is no faster than 45 degrees a second, whatever the joint allows, and is stopped",
  async (page) => {
    await open(page, "dark");
    await page.getByRole("button", { name: "Sweep turn" }).click();
    // By the times that pictures have, which the sweep goes by, so that a busy machine makes no difference: in a
    // picture the sweep's step comes first, as it was asked for first. Two pictures may have one time.
    const fastest = await page.evaluate(async () => {
      const look = () =>
        new Promise((resolve) =>
          globalThis.requestAnimationFrame((time) => resolve({ q: globalThis.urdd.app.store.now.q[0], time })),
        );
      let [fastest, before] = [0, await look()];
      for (const end = before.time + 2000; before.time < end;) {
        const now = await look();
        if (now.time === before.time) continue;
        fastest = Math.max(fastest, (1000 * Math.abs(now.q - before.q)) / (now.time - before.time));
        before = now;
      }
      return fastest;
    });
    assert.ok(fastest > 0.1 && fastest < (Math.PI / 4) * 1.001, String(fastest));
    await page.getByRole("button", { name: "Sweep turn" }).click();
    const q = await state(page, "q");
    await page.waitForTimeout(300);
    assert.deepEqual(await state(page, "q"), q);
  },
);

inPage(set, "frames have names and a size", async (page) => {
  await open(page, "welding_arm");
  await page.getByRole("button", { name: "Frames" }).click();
  await soon(async () => assert.ok((await page.locator(".names span:visible").count()) >= 4));
  const { links } = await state(page, "robot");
  const names = await page.locator(".names span").allTextContents();
  assert.deepEqual(names.toSorted(), links.map(({ name }) => name).sort());
  await page.click("#tab-Shapes");
  await page.locator("#frame-size").fill("-1");
  near(await state(page, "frameSize"), 0.1, 1e-9);
  await page.getByText("100 mm", { exact: true }).waitFor();
  await page.uncheck("#overlay-names");
  await soon(async () => assert.equal(await page.locator(".names span:visible").count(), 0));
});

inPage(set, "skips: columns have names, the reason is there, and no button comes under the pointer", async (page) => {
  await open(page, "welding_arm");
  await page.click("#tab-Skips");
  await state(page, "skips", ({ answer }) => answer !== null);
  const { links } = await state(page, "robot");
  const columns = await page.locator(".columns-of > span").allTextContents();
  assert.ok(columns.length > 4 && columns.every((name) => links.some((link) => link.name === name)), columns.join());
  await page.evaluate(() => {
    const { robot } = globalThis.urdd.app.store.now;
    globalThis.urdd.app.store.set({
      pair: [
        [robot.link("base"), 0],
        [robot.link("turret"), 0],
      ],
    });
  });
  assert.match(await page.locator(".why").textContent(), /^Reason: (?:always in contact|adjacent)/);
  const button = page.getByRole("button", { name: "Its pieces" });
  const { x, y, width, height } = await button.boundingBox();
  await button.click();
  await state(page, "skips", ({ answer }) => answer.kind === "pieces");
  const under = await page.evaluate(
    ([x, y]) => globalThis.document.elementFromPoint(x, y).textContent,
    [x + width / 2, y + height / 2],
  );
  assert.equal(under, "Its pieces");
});

inPage(set, "a black robot is told from the dark ground", async (page) => {
  await open(page, "dark");
  await page.waitForTimeout(300);
  const contrast = await page.evaluate(async () => {
    const { stage } = globalThis.urdd;
    const image = await globalThis.createImageBitmap(await stage.view.picture());
    const context = new globalThis.OffscreenCanvas(image.width, image.height).getContext("2d", {
      willReadFrequently: true,
    });
    context.drawImage(image, 0, 0);
    const ratio = image.width / stage.view.canvas.clientWidth;
    const luminance = (point) => {
      const place = stage.view.place(point);
      const [r, g, b] = context.getImageData(place.x * ratio, place.y * ratio, 1, 1).data;
      const linear = (value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4);
      return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    };
    // Along a line across the sphere: the ground beside it, and its rim and middle.
    const { poses } = globalThis.urdd.app.store.now;
    const centre = stage.view.controls.target.clone().set(poses[7], poses[8], poses[9]);
    const right = centre.clone().setFromMatrixColumn(stage.view.camera.matrixWorld, 0);
    const at = (share) => luminance(centre.clone().addScaledVector(right, 0.3 * share));
    const ground = at(1.35);
    const found = [0, 0.3, 0.6, 0.8, 0.9, 0.96].map(at);
    return Math.max(...found.map((value) => (Math.max(value, ground) + 0.05) / (Math.min(value, ground) + 0.05)));
  });
  // What WCAG asks of parts of a picture is 3; a black ball on the ground of before had 1.1.
  assert.ok(contrast > 1.6, String(contrast));
});
