// What `urdd lint` finds in a URDF, beside its picture: counted, painted, with its place in the text, while it is mended.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { drawn, inPage, repository, run, setting, soon, state, view } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-lint-"));
after(() => rmSync(folder, { recursive: true, force: true }));

const urdf = join(folder, "arm_with_faults.urdf");
const text = readFileSync(join(repository, "examples/robots/arm_with_faults.urdf"), "utf8");

/** As editors do: another file takes the place of the first. */
function write(text) {
  writeFileSync(`${urdf}.new`, text);
  renameSync(`${urdf}.new`, urdf);
}

write(text);
const set = setting([], () => view(urdf));

const codes = (page) => page.locator(".finding:not(.unverified) .heading strong").allTextContents();
const card = (page, code) => page.locator(".finding", { has: page.locator(`strong:text-is("${code}")`) });

inPage(set, "findings are counted without being asked for, painted, and shown in the text", async (page) => {
  await drawn(page, "arm_with_faults");
  const { urdds, totals } = JSON.parse(run("lint", "--format", "json", urdf).stdout);
  await page.locator("#tab-Findings .badge").waitFor();
  const all = totals.error + totals.warning + totals.info;
  assert.ok(all >= 3);
  assert.equal(await page.locator("#tab-Findings .badge").textContent(), String(all));
  const painted = () =>
    page.evaluate(() =>
      [...document.querySelectorAll("#panel-Findings .legend > span")].map((span) => span.textContent.trim()),
    );
  assert.deepEqual(await painted(), [], "another panel is open");
  await page.click("#tab-Findings");
  await soon(async () =>
    assert.deepEqual(await painted(), ["1 link with errors", "1 link with warnings", "1 link without"]),
  );
  assert.deepEqual((await codes(page)).toSorted(), urdds[0].findings.map(({ code }) => code).toSorted());

  const [place] = urdds[0].findings.find(({ code }) => code === "LNT017").places;
  await card(page, "LNT017").locator(".place").click();
  const { robot, selected } = await page.evaluate(() => {
    const { robot, selected } = globalThis.urdd.app.store.now;
    return { robot: robot.links.map(({ name }) => name), selected };
  });
  assert.equal(robot[selected.index], "fore", "the link that the joint moves");
  const line = await card(page, "LNT017").locator(".line.at").textContent();
  assert.equal(line, `${place.line}${text.split("\n")[place.line - 1]}`);
  assert.match(line, /<limit/);

  await card(page, "LNT017").getByRole("button", { name: "Explain" }).click();
  const told = card(page, "LNT017").locator(".explanation");
  await told.getByText(/ROS, Gazebo and Pinocchio refuse the robot/).waitFor();
  assert.doesNotMatch(await told.textContent(), /SPEC/);
  await card(page, "LNT040").getByRole("button", { name: "Explain" }).click();
  const examples = card(page, "LNT040").locator(".explanation li");
  await examples.first().waitFor();
  assert.ok((await examples.count()) > 1, "a list");
});

inPage(set, "findings follow the text: broken, mended, allowed", async (page) => {
  await drawn(page, "arm_with_faults");
  await page.click("#tab-Findings");
  await card(page, "LNT017").waitFor();
  write(text.replace("</joint>", "</jiont>"));
  await soon(async () => assert.ok((await codes(page)).includes("URD011"), await codes(page)));
  await card(page, "URD011").locator(".place").click();
  assert.match(await card(page, "URD011").locator(".line.at").textContent(), /jiont/);
  const mended = text
    .replace('effort="10"/>', 'effort="10" velocity="1"/>')
    .replace("<dynamcs damping", '<dynamics frction="0.1" damping');
  write(mended);
  await soon(async () => {
    const found = await codes(page);
    assert.ok(found.includes("LNT001") && !found.includes("LNT017") && !found.includes("URD011"), found);
  });
  write(mended.replace("<robot ", "<!-- urdd: allow LNT001 the mesh leaves out the counterweight -->\n<robot "));
  await soon(async () => assert.deepEqual((await codes(page)).toSorted(), ["LNT040", "LNT060"]));
  await card(page, "LNT040")
    .getByText(/Fix: .*`?friction`?.*urdd lint --fix/)
    .waitFor();
  await state(page, "report", ({ report }) => report?.totals.error === 0);
});

inPage(set, "the urdd.toml that counts is named, and what is wrong with it", async (page) => {
  const settings = join(folder, "urdd.toml");
  writeFileSync(settings, '[severity]\nLNT017 = "info"\n');
  write(text);
  await drawn(page, "arm_with_faults");
  await page.click("#tab-Findings");
  const verdict = page.locator("#panel-Findings .verdict");
  await verdict.getByText(`With the settings of ${settings}.`).waitFor();
  await card(page, "LNT017").locator(".dot.info").waitFor();
  writeFileSync(settings, "[severity");
  write(text.replace("</robot>", "</robot>\n"));
  await verdict.getByText(/Without your settings: .*urdd\.toml:1/).waitFor();
  await card(page, "LNT017").locator(".dot.error").waitFor();
  rmSync(settings);
});
