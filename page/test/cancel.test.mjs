// A drop that gets no answer: the page says what it does, and ends it when a person asks.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { dropOn, inPage, open, setting, soon, state } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-cancel-"));
after(() => rmSync(folder, { recursive: true, force: true }));
// Which only a program expands.
const xacro = join(folder, "slow.urdf.xacro");
writeFileSync(xacro, '<robot name="slow"><link name="a"/></robot>');
const set = setting(["gripper", "welding_arm"]);

inPage(
  set,
  "a drop without an answer is ended by Cancel, and the request with it",
  async (page) => {
    await page.waitForSelector(".card");
    const ended = page.waitForEvent("requestfailed", { predicate: (request) => request.url().endsWith("/drops") });
    await dropOn(page, xacro);
    const waiting = page.locator(".waiting");
    await waiting.getByText(/Sending 1 file \(\d+ B\)/).waitFor();
    await waiting.getByRole("button", { name: "Cancel" }).click();
    assert.match((await ended).failure().errorText, /ABORTED/);
    await page.locator(".card").first().waitFor();
    await soon(async () => assert.equal(await page.locator(".failure").isVisible(), false));
  },
  // The server never comes to answer.
  { routes: [["**/drops", () => undefined]] },
);

// Answers that came after another robot was opened were once written into memory of the engine that was free by then.
const held = [];
let late = 0;
inPage(
  set,
  "no file of a robot is read any more when another one was opened meanwhile",
  async (page) => {
    await open(page, "welding_arm");
    // All requests at once that the page makes: the queue behind them is longer.
    await soon(() => assert.equal(held.length, 8));
    await open(page, "gripper");
    late = 0;
    for (const route of held.splice(0)) await route.continue();
    await state(page, "proximity", (value) => value.answer !== null);
    await page.waitForTimeout(500);
    assert.equal(late, 0);
    assert.equal(await page.evaluate(() => globalThis.urdd.app.store.now.failure), null);
  },
  {
    routes: [
      [
        "**/robots/welding_arm/files/**/convex_decomposition_meshes_module/meshes/**",
        (route) => {
          late++;
          held.push(route);
        },
      ],
    ],
  },
);
