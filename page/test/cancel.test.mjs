// A drop that gets no answer: the page says what it does, and ends it when a person asks.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { dropOn, inPage, setting, soon } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-cancel-"));
after(() => rmSync(folder, { recursive: true, force: true }));
const urdf = join(folder, "slow.urdf");
writeFileSync(urdf, '<robot name="slow"><link name="a"/></robot>');
const set = setting(["gripper", "welding_arm"]);

inPage(
  set,
  "a drop without an answer is ended by Cancel, and the request with it",
  async (page) => {
    await page.waitForSelector(".card");
    const ended = page.waitForEvent("requestfailed", { predicate: (request) => request.url().endsWith("/drops") });
    await dropOn(page, urdf);
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
