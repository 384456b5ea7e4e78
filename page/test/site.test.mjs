// The exported site on a plain file server.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createServer } from "node:net";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { drawn, inPage, open, run, setting, soon, state, tab } from "./world.mjs";

async function freePort() {
  const probe = createServer();
  await new Promise((resolve) => probe.listen(0, "127.0.0.1", resolve));
  const { port } = probe.address();
  await new Promise((resolve) => probe.close(resolve));
  return port;
}

/** The exported site on a plain file server. */
async function exported(made) {
  const site = join(made.folder, "site");
  const done = run("view", made.robots, "--export", site);
  assert.equal(done.status, 0, done.stderr);
  const port = await freePort();
  const address = `http://127.0.0.1:${port}/`;
  const server = spawn("python3", ["-m", "http.server", "--bind", "127.0.0.1", "--directory", site, String(port)], {
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
  return { address, end: () => server.kill() };
}

const set = setting(["welding_arm", "gripper"], exported);

inPage(set, "the gallery has a picture, links, DOFs and the verdict of each robot, and finds by them", async (page) => {
  await page.waitForSelector(".card img");
  const texts = await page.locator(".card").allTextContents();
  assert.match(
    texts.find((text) => text.startsWith("welding_arm")),
    /9 links · 6 DOFs.*passes/,
  );
  // They are fetched when they come into view.
  await soon(async () => {
    const drawn = await page.locator(".card img").evaluateAll((all) => all.map((image) => image.naturalWidth));
    assert.deepEqual(drawn, [320, 320]);
  });
  await page.getByRole("searchbox", { name: "Find a robot" }).fill("9 links");
  assert.equal(await page.locator(".card:visible").count(), 1);
  await page.getByRole("searchbox", { name: "Find a robot" }).fill("nothing of the kind");
  await page.getByText("No robot is like that.").waitFor();
});

inPage(set, "the site shows its robots, with their reports, and writes nothing", async (page) => {
  await page.waitForSelector(".card");
  assert.match(await page.locator(".drop").textContent(), /Nothing is uploaded/);
  await open(page, "welding_arm");
  await page.click("#tab-Findings");
  const { report } = await state(page, "report", (value) => value.report !== null);
  assert.deepEqual(
    report,
    JSON.parse(run("validate", join(set.made.robots, "welding_arm"), "--format", "json").stdout),
  );
  await page.click("#tab-Skips");
  await state(page, "skips", (value) => value.answer !== null);
  assert.equal(await page.getByRole("button", { name: "Save", exact: true }).count(), 0);
  assert.equal(await page.getByRole("button", { name: "Download the files" }).count(), 1);
});

test("a page in one file opens from the disk, and a robot moves in it", { timeout: 300_000 }, async () => {
  const file = join(set.made.folder, "one.html");
  assert.equal(run("view", join(set.made.robots, "gripper"), "--export", file).status, 0);
  const { page, faults, close } = await tab(set.chrome, pathToFileURL(file).href);
  await drawn(page, "gripper");
  const before = await state(page, "q");
  await page.getByRole("button", { name: "Random", exact: true }).click();
  await state(page, "q", (q) => q.some((value, dof) => value !== before[dof]));
  await page.click("#tab-Findings");
  const { report } = await state(page, "report", (value) => value.report !== null);
  assert.equal(report.urdds[0].verdict, "pass");
  await page.click("#tab-Proximity");
  await state(page, "proximity", (value) => value.answer !== null);
  assert.deepEqual(faults, []);
  await close();
});
