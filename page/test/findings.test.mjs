// Findings: counted one way everywhere, all of their places, the text there, in the order in which to mend them.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { inPage, run, setting, soon, state, view } from "./world.mjs";

/** A URDD with many faults: places beyond what is shown at first, formats and misplaced shapes. */
function spoil(folder) {
  const change = (path, edit) => {
    const file = join(folder, path);
    const document = JSON.parse(readFileSync(file, "utf8"));
    edit(document);
    writeFileSync(file, JSON.stringify(document, null, 2));
  };
  change("link_shapes_modules/link_shapes_approximations_module/module.json", (document) => {
    const move = (value) => {
      if (Array.isArray(value)) value.forEach(move);
      else if (value !== null && typeof value === "object") {
        if (typeof value.radius === "number") value.radius *= 0.5;
        Object.values(value).forEach(move);
      }
    };
    move(document);
  });
  change("dof_module/module.json", (document) => {
    document.odd = 1;
  });
}

const set = setting(["welding_arm"], (made) => {
  spoil(join(made.robots, "welding_arm"));
  return view(made.robots);
});

const number = (text) => Number(/[\d,]+/.exec(text)[0].replaceAll(",", ""));

inPage(set, "the header, the tab, the headings and the program have one number", async (page) => {
  const target = join(set.made.robots, "welding_arm");
  await page.waitForFunction(() => globalThis.urdd?.stage.settledOn);
  await page.click("#tab-Findings");
  const { report } = await state(page, "report", (value) => value.report !== null);
  const printed = run("validate", target).stdout;
  const [, all, errors] = /(\d+) findings?: (\d+) errors?/.exec(printed);
  assert.ok(Number(all) > report.urdds[0].findings.length && Number(errors) > 5, printed.slice(-300));
  assert.equal(number(await page.locator(".bar .chip.error").textContent()), Number(errors));
  assert.equal(number(await page.locator("#tab-Findings .badge").textContent()), Number(all));
  assert.match(
    await page.locator("#panel-Findings .verdict").textContent(),
    new RegExp(`${all} findings: ${errors} errors`),
  );
  for (const grouping of ["severity", "module", "link"]) {
    await page.getByLabel("Group findings by").selectOption(grouping);
    const headings = (await page.locator(".findings h2").allTextContents()).filter((text) => text.includes(", of "));
    const sum = headings.reduce((sum, text) => sum + number(/: ([\d,]+), of/.exec(text)[1]), 0);
    assert.equal(sum, Number(all), headings.join(" | "));
  }
});

inPage(set, "errors come by what they do, and all places and their text can be seen", async (page) => {
  await page.waitForFunction(() => globalThis.urdd?.stage.settledOn);
  await page.click("#tab-Findings");
  const { report } = await state(page, "report", (value) => value.report !== null);
  const order = ["wrong-motion", "wrong-place", "missing-geometry", "collisions", "format", "appearance", "looseness"];
  const severities = ["error", "warning", "info"];
  const rank = ({ severity, consequence }) => 10 * severities.indexOf(severity) + order.indexOf(consequence);
  const codes = await page.locator(".finding:not(.unverified) .heading strong").allTextContents();
  const ranks = codes.map((code) => rank(report.urdds[0].findings.find((finding) => finding.code === code)));
  assert.deepEqual(
    ranks,
    ranks.toSorted((a, b) => a - b),
    codes.join(),
  );
  // Of one code, what has most places comes first.
  const many = report.urdds[0].findings.toSorted((a, b) => b.places.length - a.places.length)[0];
  assert.ok(many.places.length > 5, "a finding of many places");
  const card = page.locator(".finding", { has: page.locator(`strong:text-is("${many.code}")`) }).first();
  assert.equal(await card.locator(".places > li:has(.place)").count(), 5);
  for (let more = card.getByRole("button", { name: /^Show \d+ more/ }); await more.isVisible();) await more.click();
  assert.equal(await card.locator(".places > li:has(.place)").count(), many.places.length);
  // What the report leaves out is said.
  const cut = report.urdds[0].findings.find(({ places_cut }) => places_cut > 0);
  const short = page.locator(".finding", {
    has: page.locator(`strong:text-is("${cut.code}")`),
    hasText: `${cut.count} places`,
  });
  assert.match(await short.textContent(), new RegExp(`${cut.places_cut} places more are not in the report`));
  // The text at a place is that of the file.
  const place = many.places.find(({ line }) => line > 1);
  assert.ok(place, JSON.stringify(many.places[0]));
  const at = card.locator(".places > li:has(.place)").nth(many.places.indexOf(place));
  await at.locator(".place").click();
  const text = await at.locator(".line.at code").textContent();
  const lines = readFileSync(join(set.made.robots, "welding_arm", place.file), "utf8").split("\n");
  assert.equal(text.trim(), lines[place.line - 1].trim());
  assert.ok((await at.locator(".line").count()) >= 3);
  // All that was opened stays so when the findings are filtered, and are not.
  const filter = page.getByLabel("Filter findings");
  await filter.fill("no such words");
  await card.waitFor({ state: "detached" });
  await filter.fill("");
  await soon(async () => assert.equal(await at.locator(".line.at code").textContent(), text));
  assert.equal(await card.locator(".places > li:has(.place)").count(), many.places.length);
});

inPage(set, "a fault of most links paints none, unless it is chosen, and a legend says so", async (page) => {
  await page.waitForFunction(() => globalThis.urdd?.stage.settledOn);
  await page.click("#tab-Findings");
  await state(page, "report", (value) => value.report !== null);
  const red = () =>
    page.evaluate(() => {
      const canvas = globalThis.document.createElement("canvas").getContext("2d");
      canvas.fillStyle = globalThis.getComputedStyle(globalThis.document.documentElement).getPropertyValue("--error");
      const error = canvas.fillStyle.slice(1);
      const meshes = globalThis.urdd.stage.scene.meshes();
      const all = new Set(meshes.map(({ userData }) => userData.of.link)).size;
      const of = meshes.filter(({ material }) => material.color.getHexString() === error);
      return [new Set(of.map(({ userData }) => userData.of.link)).size, all];
    });
  await soon(async () => assert.equal((await red())[0], 0));
  await page.selectOption("#painted", "worst");
  assert.match(await page.locator("#panel-Findings .legend").textContent(), /Not shown: \w+ \(\d+ of 9 links\)/);
  await soon(async () => assert.equal((await red())[0], 0));
  const code = /(\w+) \(\d+ of 9/.exec(await page.locator("#panel-Findings .legend").textContent())[1];
  await page.selectOption("#painted", code);
  await soon(async () => {
    const [painted, all] = await red();
    assert.ok(painted > all / 2, `${painted} of ${all}`);
  });
  assert.match(await page.locator("#panel-Findings .legend").textContent(), /\d+ links? with errors/);
});
