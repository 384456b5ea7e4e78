// A robot that was put together: its parts are told apart by colour.

import assert from "node:assert/strict";
import { join } from "node:path";
import { inPage, open, run, setting, state, view } from "./world.mjs";

const set = setting(["welding_arm", "gripper"], async (made) => {
  const part = (name) => join(made.robots, name);
  const done = run("combine", part("welding_arm"), part("gripper"), "--at", "torch", "-o", part("cell"));
  assert.equal(done.status, 0, done.stderr);
  return view(made.robots);
});

/** The colour of each link that is drawn, by its index. */
function colours(page) {
  return page.evaluate(() => {
    const found = {};
    globalThis.urdd.stage.view.scene.traverse(({ userData, material }) => {
      if (userData.of && material?.color) found[userData.of.link] = material.color.getHexString();
    });
    return found;
  });
}

inPage(set, "the links of each part have one colour, and no part has another's", async (page) => {
  await open(page, "cell");
  const parts = await page.evaluate(() => globalThis.urdd.app.store.now.robot.parts);
  assert.deepEqual(
    parts.map(({ id, links }) => [id, links.length]),
    [
      ["welding_arm", 9],
      ["gripper", 8],
    ],
  );
  const seen = await colours(page);
  const ofPart = parts.map(({ links }) => new Set(links.filter((link) => link in seen).map((link) => seen[link])));
  assert.deepEqual(
    ofPart.map((of) => of.size),
    [1, 1],
  );
  assert.equal(new Set(ofPart.flatMap((of) => [...of])).size, 2);

  await page.click("#tab-Shapes");
  await page.locator(".part", { hasText: "gripper" }).waitFor();
  await page.click("#by-part");
  await state(page, "byPart", (on) => !on);
  const plain = await colours(page);
  assert.notDeepEqual(plain, seen);
  await page.click("#by-part");
  await state(page, "byPart", (on) => on);
  assert.deepEqual(await colours(page), seen);
});

inPage(set, "a robot of one piece has no list of parts", async (page) => {
  await open(page, "welding_arm");
  await page.click("#tab-Shapes");
  assert.equal(await page.locator("#by-part").isVisible(), false);
});
