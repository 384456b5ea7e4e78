// Whether the robot collides: known from the first picture on, by links, and painted.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { inPage, open, run, setting, soon, state, view } from "./world.mjs";

const FINGERS = 4;

/** A palm with fingers that turn inwards and cross one another; each finger is of two boxes. */
function hand() {
  const finger = (k) => `<link name="finger_${k}">
    <collision><origin xyz="0 0 0.1"/><geometry><box size="0.02 0.02 0.2"/></geometry></collision>
    <collision><origin xyz="0 0 0.22"/><geometry><sphere radius="0.03"/></geometry></collision></link>
    <joint name="turn_${k}" type="revolute"><parent link="palm"/><child link="finger_${k}"/><axis xyz="0 1 0"/>
    <origin xyz="${0.15 * Math.cos((k * Math.PI) / 2)} ${0.15 * Math.sin((k * Math.PI) / 2)} 0.05" rpy="0 0 ${(k * Math.PI) / 2}"/>
    <limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>`;
  return `<robot name="hand"><link name="palm"><visual><geometry><box size="0.4 0.4 0.02"/></geometry></visual></link>
    ${Array.from({ length: FINGERS }, (_, k) => finger(k)).join("")}</robot>`;
}

const set = setting(["welding_arm"], (made) => {
  const urdf = join(made.folder, "hand.urdf");
  writeFileSync(urdf, hand());
  const done = run("generate", urdf, "-o", join(made.robots, "hand"));
  assert.equal(done.status, 0, done.stderr);
  return view(made.robots);
});

/** What the program says: the pairs of links in contact, sorted, of one configuration. */
function native(q) {
  const file = join(set.made.folder, "q.txt");
  writeFileSync(file, `${JSON.stringify(q)}\n`);
  const words = ["check-collisions", join(set.made.robots, "hand"), "--configurations", file];
  const done = run(...words, "--shapes", "pieces", "--format", "json", "--nearest", "100000");
  assert.ok(done.status < 2, done.stderr);
  const { nearest } = JSON.parse(done.stdout.trim().split("\n")[0]);
  const touching = nearest.filter(({ distance }) => distance <= 0).map(({ links }) => links.toSorted().join(" – "));
  return [...new Set(touching)].sort();
}

/** The links whose parts are drawn in the colour of contact. */
function painted(page) {
  return page.evaluate(() => {
    const { stage, app } = globalThis.urdd;
    const canvas = globalThis.document.createElement("canvas").getContext("2d");
    canvas.fillStyle = globalThis.getComputedStyle(globalThis.document.documentElement).getPropertyValue("--error");
    const red = canvas.fillStyle.slice(1);
    const links = stage.scene
      .meshes()
      .filter(({ material }) => material.color.getHexString() === red)
      .map(({ userData }) => app.store.now.robot.links[userData.of.link].name);
    return [...new Set(links)].sort();
  });
}

const pairsNow = (page) =>
  page.evaluate(() => {
    const { contacts, robot } = globalThis.urdd.app.store.now;
    return contacts?.pairs
      .map(({ links }) =>
        links
          .map((link) => robot.links[link].name)
          .sort()
          .join(" – "),
      )
      .sort();
  });

inPage(
  set,
  "the header and the status line say it without a tab being opened, with the program's pairs",
  async (page) => {
    await open(page, "hand");
    assert.equal(await state(page, "tab"), "Joints");
    await page
      .locator(".bar")
      .getByText(/self-collision/)
      .waitFor();
    const zero = await state(page, "q");
    assert.deepEqual(native(zero), []);
    assert.match(await page.locator(".status").textContent(), /no self-collision/);
    assert.deepEqual(await painted(page), []);
    // All fingers in the middle: every two of them touch, unless the URDD skips them.
    const closed = zero.map(() => -0.7);
    await page.evaluate((q) => globalThis.urdd.app.move(q), closed);
    const expected = native(closed);
    assert.ok(expected.length >= 2, expected.join());
    await soon(async () => assert.deepEqual(await pairsNow(page), expected));
    assert.match(await page.locator(".bar").textContent(), new RegExp(`${expected.length} self-collisions`));
    assert.match(await page.locator(".status").textContent(), new RegExp(expected[0].split(" – ")[0]));
    // All of them are painted, in the original shapes too.
    const links = [...new Set(expected.flatMap((pair) => pair.split(" – ")))].sort();
    await soon(async () => assert.deepEqual(await painted(page), links));
    await page.getByRole("button", { name: "Pieces", exact: true }).click();
    await page.waitForFunction(() => globalThis.urdd.stage.scene.has("pieces"));
    await soon(async () => assert.deepEqual(await painted(page), links));
    await page.evaluate((q) => globalThis.urdd.app.move(q), zero);
    await soon(async () => assert.deepEqual(await painted(page), []));
  },
);

inPage(
  set,
  "the list is of links, with their pieces one level down, and contacts are not said to be 0 mm",
  async (page) => {
    await open(page, "hand");
    const closed = (await state(page, "q")).map(() => -0.7);
    await page.evaluate((q) => globalThis.urdd.app.move(q), closed);
    await page.click("#tab-Proximity");
    const expected = native(closed);
    await soon(async () => assert.deepEqual(await pairsNow(page), expected));
    const rows = page.locator(".link-pair:visible");
    await soon(async () => {
      const names = await rows.evaluateAll((all) =>
        all.map((row) =>
          [...row.querySelectorAll(":scope > .pair > .name")]
            .map((side) => side.textContent)
            .sort()
            .join(" – "),
        ),
      );
      assert.equal(new Set(names).size, names.length, "each pair of links once");
      assert.deepEqual(names.slice(0, expected.length).sort(), expected);
    });
    assert.match(await rows.first().textContent(), /in contact/);
    assert.ok(!/\b0 mm/.test(await page.locator(".pairs").innerText()));
    await rows.first().locator(".expand").click();
    assert.match(await rows.first().locator(".pieces .pair").first().textContent(), /piece \d+/);
    // As after its files changed: the same two links, by their names.
    const shown = await rows.first().locator(":scope > .pair").textContent();
    await page.evaluate(() => globalThis.urdd.app.reopen(globalThis.urdd.app.store.now.robot.entry));
    await state(page, "proximity", ({ answer }) => answer !== null);
    await soon(async () => assert.equal(await rows.first().locator(":scope > .pair").textContent(), shown));
    assert.ok(await rows.first().locator(".pieces .pair").first().isVisible());
  },
);

inPage(set, "a chosen pair fades the rest in its tab alone, and Escape or another tab ends it", async (page) => {
  await open(page, "welding_arm");
  const faded = () =>
    page.evaluate(() => globalThis.urdd.stage.scene.meshes().some(({ material }) => material.opacity < 0.5));
  const choose = async () => {
    await page.click("#tab-Proximity");
    await state(page, "proximity", ({ answer }) => answer !== null);
    await page.locator(".pair:visible").first().click();
    await soon(async () => assert.ok(await faded()));
  };
  await choose();
  await page.keyboard.press("Escape");
  await soon(async () => assert.ok(!(await faded())));
  assert.equal(await state(page, "pair", () => true), null);
  await choose();
  await page.click("#tab-Joints");
  await soon(async () => assert.ok(!(await faded())));
  assert.equal(await state(page, "pair", () => true), null);
  await choose();
  await page.getByRole("button", { name: "Show in Skips" }).click();
  // There the pair is chosen, and the robot is whole.
  assert.notEqual(await state(page, "pair"), null);
  await soon(async () => assert.ok(!(await faded())));
  assert.match(await page.locator(".why").textContent(), /Reason: \w+/);
});
