// Configurations that a program sends: the page follows them.

import assert from "node:assert/strict";
import { join } from "node:path";
import { drawn, inPage, setting, state, view } from "./world.mjs";

const set = setting(["gripper"], ({ robots }) => view(join(robots, "gripper"), "--follow"));

const shown = (page) => page.evaluate(() => globalThis.urdd.app.store.now.q);

inPage(set, "the page shows each configuration that a program sends, 60 a second", async (page) => {
  await drawn(page, "gripper");
  const zero = await shown(page);
  const row = (value) => `${JSON.stringify(zero.map(() => value))}\n`;
  set.server.input.write(row(0.001));
  await state(page, "q", (q) => q.every((value) => value === 0.001));
  // What is shown, each time that it changes.
  await page.evaluate(() => {
    globalThis.seen = [];
    globalThis.urdd.app.store.on(["q"], ({ q }) => globalThis.seen.push(q[0]));
  });
  for (let k = 1; k <= 120; k++) {
    set.server.input.write(row(k / 10_000));
    await new Promise((resolve) => setTimeout(resolve, 1000 / 60));
  }
  await state(page, "q", (q) => q.every((value) => value === 0.012));
  const seen = await page.evaluate(() => globalThis.seen);
  assert.ok(
    seen.every((value, k) => k === 0 || value >= seen[k - 1] || k === 1),
    "in their order",
  );
  assert.ok(seen.length > 10, `${seen.length} of 120 were shown`);
  // The picture, not only the sliders.
  const poses = await page.evaluate(async () => {
    const { app } = globalThis.urdd;
    const found = await app.engine.ask("linkPoses", { q: app.store.now.q });
    return [[...found], [...app.store.now.poses]];
  });
  assert.deepEqual(poses[0], poses[1]);
  // A move by hand stays until the program sends the next, and no step of undo is of a program.
  await page.evaluate(() => globalThis.urdd.app.move(globalThis.urdd.app.store.now.q.map(() => 0)));
  await page.evaluate(() => globalThis.urdd.app.step("back"));
  assert.deepEqual(
    await shown(page),
    zero.map(() => 0.012),
  );
});

inPage(
  set,
  "a window that is opened later begins with the last one; other numbers of values are refused",
  async (page) => {
    await drawn(page, "gripper");
    await state(page, "q", (q) => q.every((value) => value === 0.012));
    const { address } = set.server;
    const token = new URL(address).hash.slice("#token=".length);
    const sent = await fetch(new URL("robots/gripper/states", address), {
      method: "POST",
      headers: { "x-urdd-token": token, "content-type": "application/json" },
      body: JSON.stringify({ q: [1, 2, 3, 4, 5, 6, 7, 8, 9] }),
    });
    assert.equal(sent.status, 400);
    assert.match(await sent.text(), /^expected one value for each DOF, so \d+; found 9\n$/);
    assert.deepEqual(
      await shown(page),
      (await shown(page)).map(() => 0.012),
    );
  },
);
