// The exported site on a plain file server.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createServer } from "node:net";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { browser, open, robots, run, state, tab } from "./world.mjs";

let chrome;
let made;
let server;
let address;

async function freePort() {
  const probe = createServer();
  await new Promise((resolve) => probe.listen(0, "127.0.0.1", resolve));
  const { port } = probe.address();
  await new Promise((resolve) => probe.close(resolve));
  return port;
}

before(async () => {
  made = robots(["welding_arm", "gripper"]);
  const site = join(made.folder, "site");
  const done = run("view", made.robots, "--export", site);
  assert.equal(done.status, 0, done.stderr);
  const port = await freePort();
  address = `http://127.0.0.1:${port}/`;
  server = spawn("python3", ["-m", "http.server", "--bind", "127.0.0.1", "--directory", site, String(port)], {
    stdio: "ignore",
  });
  for (let tries = 0; ; tries++) {
    try {
      await fetch(address);
      break;
    } catch (error) {
      if (tries > 100) throw error;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }
  chrome = await browser();
});

after(async () => {
  await chrome?.close();
  server?.kill();
  made?.remove();
});

test("the site shows its robots, with their reports, and writes nothing", { timeout: 300_000 }, async () => {
  const { page, faults, close } = await tab(chrome, address);
  await page.waitForSelector(".card");
  assert.match(await page.locator(".drop").textContent(), /Nothing is uploaded/);
  await open(page, "welding_arm");
  await page.click("#tab-Findings");
  const { report } = await state(page, "report", (value) => value.report !== null);
  assert.deepEqual(report, JSON.parse(run("validate", join(made.robots, "welding_arm"), "--format", "json").stdout));
  await page.click("#tab-Skips");
  await state(page, "skips", (value) => value.answer !== null);
  assert.equal(await page.getByRole("button", { name: "Save", exact: true }).count(), 0);
  assert.equal(await page.getByRole("button", { name: "Download the files" }).count(), 1);
  assert.deepEqual(faults, []);
  await close();
});
