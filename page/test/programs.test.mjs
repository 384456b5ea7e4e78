// What programs do with a URDF: chips above the findings, and what each does with its places in the text.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { drawn, inPage, repository, run, setting, soon, view } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-programs-"));
after(() => rmSync(folder, { recursive: true, force: true }));
const urdf = join(folder, "arm_with_faults.urdf");
const text = readFileSync(join(repository, "examples/robots/arm_with_faults.urdf"), "utf8");
const write = (text) => {
  writeFileSync(`${urdf}.new`, text);
  renameSync(`${urdf}.new`, urdf);
};
write(text);
const set = setting([], () => view(urdf));

/** The words of a chip of a program, from what the command says of it. */
const WORDS = {
  null: ["good", "loads it"],
  reads: ["warning", "loads it, and reads some of it otherwise"],
  drops: ["warning", "loads it without some of it"],
  refuses: ["error", "refuses it"],
  crashes: ["error", "crashes on it"],
};
const asked = () => JSON.parse(run("lint", "--format", "json", urdf).stdout).urdds[0].programs;
const chips = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll("#panel-Findings .programs .chip")].map((chip) => [
      chip.dataset.program,
      chip.className,
      chip.getAttribute("aria-label"),
    ]),
  );
const shown = (page) => page.locator("#program");

inPage(set, "each program has a chip with what it does, and its places are in the text", async (page) => {
  write(text);
  await drawn(page, "arm_with_faults");
  await page.click("#tab-Findings");
  // The three versions of urdfdom refuse it alike: one chip. No velocity of a limit, no ROS, and no Gazebo.
  const expected = asked()
    .filter(({ program }) => !["urdfdom4", "urdfdom3", "sdformat14", "sdformat16"].includes(program))
    .map(({ family, does }) => {
      const [look, words] = WORDS[does];
      return [family, `chip ${look}`, `${family} ${words}`];
    });
  assert.deepEqual(expected[0], ["ROS", "chip error", "ROS refuses it"]);
  assert.ok(expected.some(([, look]) => look === "chip good") && expected.some(([, look]) => look === "chip warning"));
  await soon(async () => assert.deepEqual(await chips(page), expected));
  assert.ok(await shown(page).isHidden());

  // By keys, as by a click: what it does, with the place; once more, and it is gone.
  const ros = page.locator('.programs [data-program="ROS"]');
  await ros.focus();
  await page.keyboard.press("Enter");
  assert.equal(await ros.getAttribute("aria-expanded"), "true");
  assert.equal(await page.evaluate(() => document.activeElement.dataset.program), "ROS");
  assert.match(await shown(page).textContent(), /ROS \(urdfdom 6\) 6\.0\.0.*refuses the robot: velocity is missing/);
  const [{ effects }] = asked();
  await shown(page).locator(".place").click();
  const line = await shown(page).locator(".line.at").textContent();
  assert.equal(line, `${effects[0].line}${text.split("\n")[effects[0].line - 1]}`);
  assert.match(line, /<limit/);
  await ros.focus();
  await page.keyboard.press("Enter");
  assert.ok(await shown(page).isHidden());

  // What MuJoCo does with any robot is apart, and a place chooses its link.
  await page.click('.programs [data-program="MuJoCo"]');
  const usual = shown(page).locator("details.usual");
  assert.match(await usual.locator("summary").textContent(), /5 places/);
  assert.ok(await usual.locator(".place").first().isHidden());
  assert.equal(await shown(page).locator(":scope > .places .place").count(), 1);
  assert.match(await shown(page).textContent(), /leaves it out: <dynamcs> is not an element of URDF/);
  await usual.locator("summary").click();
  await usual.locator(".place", { hasText: "link upper: visual" }).click();
  const selected = await page.evaluate(() => {
    const { robot, selected } = globalThis.urdd.app.store.now;
    return robot.links[selected.index].name;
  });
  assert.equal(selected, "upper");
});

inPage(set, "chips follow the text, and those of urdd.toml come first", async (page) => {
  write(text);
  await drawn(page, "arm_with_faults");
  await page.click("#tab-Findings");
  await page.click('.programs [data-program="Pinocchio"]');
  // Mended, it is loaded; what is open stays so.
  write(text.replace('effort="10"/>', 'effort="10" velocity="1"/>').replace("<dynamcs damping", "<dynamics damping"));
  await page.locator('.programs [data-program="Pinocchio"].good').waitFor();
  assert.match(await shown(page).locator("h2").textContent(), /^Pinocchio loads it$/);
  writeFileSync(join(folder, "urdd.toml"), 'for = ["drake", "humble"]\n');
  write(text);
  await soon(async () => {
    const names = (await chips(page)).map(([name]) => name);
    assert.deepEqual(names.slice(0, 2), ["Drake", "ROS humble (urdfdom 3)"], names.join());
    assert.ok(names.includes("ROS (urdfdom 6), ROS jazzy (urdfdom 4)"), names.join());
  });
  await page.locator(".programs").getByText("others:").waitFor();
  rmSync(join(folder, "urdd.toml"));
});

inPage(
  set,
  "what is open among findings stays open, and the panel where it is, while the file is saved",
  async (page) => {
    write(text);
    // So low that the panel scrolls.
    await page.setViewportSize({ width: 1280, height: 420 });
    await drawn(page, "arm_with_faults");
    await page.click("#tab-Findings");
    await page.click('.programs [data-program="MuJoCo"]');
    const usual = shown(page).locator("details.usual");
    await usual.locator("summary").click();
    // A rule's page, and the text of a place.
    const inertia = page.locator("article", { hasText: "LNT001" });
    await inertia.getByRole("button", { name: "Explain" }).click();
    await inertia.locator(".explanation p").first().waitFor();
    await inertia.locator(".place").click();
    await inertia.locator(".line.at").waitFor();
    const panel = page.locator("#panel-Findings");
    const place = () => panel.evaluate(({ scrollTop }) => scrollTop);
    await panel.evaluate((panel) => panel.scrollTo(0, 300));
    assert.equal(await place(), 300);
    const lines = () =>
      page.evaluate(() => globalThis.urdd.app.store.now.report.report?.text.split("\n").length ?? null);
    const before = await lines();
    // A line above all: each place is a line further down.
    write(`<!-- new -->\n${text}`);
    await soon(async () => assert.equal(await lines(), before + 1));
    assert.ok(await usual.evaluate(({ open }) => open));
    assert.ok(await inertia.locator(".explanation p").first().isVisible());
    assert.match(await inertia.locator(".line.at").textContent(), /^18.*<inertia/);
    assert.equal(await inertia.locator(".place").getAttribute("aria-expanded"), "true");
    assert.equal(await place(), 300);
    // A chip can be clicked while the file is read.
    const chosen = await page.evaluate(async () => {
      const { app } = globalThis.urdd;
      const { document } = globalThis;
      let shown = null;
      app.store.on(["robot"], ({ robot }) => {
        if (robot || shown !== null) return;
        document.querySelector('.programs [data-program="Drake"]').click();
        shown = document.querySelector("#program h2")?.textContent ?? "nothing";
        document.querySelector('.programs [data-program="MuJoCo"]').click();
      });
      await app.reopen(app.store.now.robot.entry);
      return shown;
    });
    assert.match(chosen, /^Drake loads it/);
    await soon(async () => assert.equal(await lines(), before + 1));
    // A click closes it for good.
    await inertia.locator(".place").click();
    await usual.locator("summary").click();
    write(text);
    await soon(async () => assert.equal(await lines(), before));
    assert.ok(!(await usual.evaluate(({ open }) => open)));
    assert.ok(await inertia.locator(".excerpt").isHidden());
    assert.ok(await inertia.locator(".explanation p").first().isVisible());
  },
);

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
for (const colorScheme of ["dark", "light"]) {
  inPage(
    set,
    `no serious finding of axe-core, ${colorScheme}`,
    async (page) => {
      write(text);
      await drawn(page, "arm_with_faults");
      await page.click("#tab-Findings");
      await page.click('.programs [data-program="MuJoCo"]');
      await shown(page).locator("details.usual summary").click();
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => globalThis.axe.run("#panel-Findings"));
      const bad = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
      assert.deepEqual(
        bad.map(({ id, nodes }) => `${id}: ${nodes[0].html}`),
        [],
      );
    },
    { colorScheme, bypassCSP: true },
  );
}

const made = setting(["gripper"]);
inPage(made, "a URDD has no chips of programs", async (page) => {
  await drawn(page, "gripper");
  await page.click("#tab-Findings");
  await page.locator("#panel-Findings .verdict.pass").waitFor();
  assert.ok(await page.locator(".programs").isHidden());
});
