// The exported site on a plain file server.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { exported } from "./exported.mjs";
import { drawn, inPage, open, run, setting, soon, state, tab } from "./world.mjs";

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
  await page.getByText("No robot matches.").waitFor();
});

inPage(set, "the site shows its robots, with their reports, and writes nothing", async (page) => {
  await page.waitForSelector(".card");
  assert.match(await page.locator(".drop").textContent(), /nothing is uploaded/);
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

inPage(set, "a link of the site opens its view in another browser, and Back leads to the gallery", async (page) => {
  await open(page, "gripper");
  await page.getByRole("button", { name: "Middle" }).click();
  const middle = await state(page, "q", (q) => q.some((value) => value !== 0));
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByText("Link copied.").waitFor();
  const link = await page.evaluate(() => globalThis.navigator.clipboard.readText());
  assert.ok(!link.includes("token"), link);
  const other = await tab(set.chrome, link);
  await drawn(other.page, "gripper");
  const q = await state(other.page, "q", (q) => q.some((value) => value !== 0));
  q.forEach((value, dof) => assert.ok(Math.abs(value - middle[dof]) < 1e-6));
  await other.close();
  await page.goBack();
  await page.waitForSelector(".card:visible");
  await page.goto(link);
  await drawn(page, "gripper");
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

inPage(set, "a second export keeps what a person added, and the site works", async (page) => {
  const { site, address } = set.server;
  // The files of the site of before go away: the page must have them.
  await page.waitForSelector(".card");
  await page.waitForLoadState("networkidle");
  const mine = { CNAME: "robots.example", "robots/notes.txt": "mine", "urdd-site/notes.txt": "mine too" };
  mkdirSync(join(site, "robots"), { recursive: true });
  for (const [name, text] of Object.entries(mine)) writeFileSync(join(site, name), text);
  writeFileSync(join(set.made.robots, "gripper/.env"), "SECRET");
  const done = run("view", join(set.made.robots, "gripper"), "--export", site);
  assert.equal(done.status, 0, done.stderr);
  for (const [name, text] of Object.entries(mine)) assert.equal(readFileSync(join(site, name), "utf8"), text);
  // A browser may keep the old page for some seconds; a reload asks the server.
  await page.reload();
  await drawn(page, "gripper");
  const files = await page.evaluate(() => globalThis.urdd.app.store.now.robot.files);
  assert.ok(files.length > 30 && !files.some(({ path }) => path === ".env"));
  for (const { at } of JSON.parse(readFileSync(join(site, "urdd-site.json"), "utf8"))
    .files.filter(({ path }) => path.endsWith(".bin"))
    .map(({ path }) => ({ at: path }))) {
    const response = await fetch(new URL(at, address));
    assert.equal(response.headers.get("content-type"), "application/octet-stream", at);
  }
});
