// The text that a robot is made of: marked, mended, undone, saved. What a fix makes is what the program makes.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { FAULTY, SOUND } from "./faulty.mjs";
import { drawn, inPage, run, setting, soon, state, view } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-text-"));
after(() => rmSync(folder, { recursive: true, force: true }));
const NAME = "robot.urdf";
const file = join(folder, NAME);
writeFileSync(join(folder, "shown.urdf"), SOUND);
const set = setting([], () => view(join(folder, "shown.urdf")));

/** What the program reports of a text, as the page has it. */
function report(text) {
  writeFileSync(file, text);
  return { ...JSON.parse(run("lint", "--format", "json", file).stdout), text };
}

function fixed(text) {
  writeFileSync(file, text);
  run("lint", "--fix", file);
  return readFileSync(file, "utf8");
}

/** Gives the page this text, and someone who lints it anew after each edit. */
async function draft(page, text, { format = "urdf", path = `arm/${NAME}`, first = report(text) } = {}) {
  await drawn(page, "shown");
  await page.exposeFunction("lintText", report);
  await page.evaluate(
    ({ text, format, path, first }) => {
      const { app } = globalThis.urdd;
      const { store } = app;
      Object.assign(app.site.here, {
        edit(text) {
          store.set({ draft: { ...store.now.draft, text, isChanged: true } });
          void globalThis.lintText(text).then((report) => {
            if (store.now.draft?.text === text) store.set({ report: { report, error: null, busy: null } });
          });
        },
        saved: () => store.set({ draft: { ...store.now.draft, isChanged: false } }),
      });
      store.set({
        draft: { path, format, text, isChanged: false },
        report: { report: first, error: null, busy: null },
      });
    },
    { text, format, path, first },
  );
}

const textNow = (page) => page.evaluate(() => globalThis.urdd.app.store.now.draft.text);
const panel = (page) => page.locator("#panel-Text");
const content = (page) => panel(page).locator(".cm-content");

const underlined = (page, word) => panel(page).locator(".cm-lintRange", { hasText: new RegExp(`^${word}$`) });

async function open(page) {
  await page.click("#tab-Text");
  await content(page).waitFor();
}

/** The text, once the page has what it makes of it. */
async function becomes(page, wanted) {
  await soon(async () => assert.equal(await textNow(page), wanted));
}

inPage(set, "findings are marked in the text, and one is mended by a click, undone, and done again", async (page) => {
  await drawn(page, "shown");
  assert.equal(await page.locator("#tab-Text").isVisible(), false, "there is no text to change");
  await draft(page, FAULTY);
  await open(page);
  const { findings } = report(FAULTY).urdds[0];
  const places = findings.flatMap(({ places }) => places);
  const lines = new Set(places.map(({ line }) => line));
  await soon(async () =>
    assert.equal(await panel(page).locator(".cm-gutter-lint .cm-lint-marker").count(), lines.size),
  );

  const { places: found } = findings.find(({ code }) => code === "LNT040");
  await page.click("#tab-Findings");
  const card = page.locator(".finding", { has: page.locator('strong:text-is("LNT040")') });
  await card.locator(".place").first().click();
  await panel(page).getByText(`Line ${found[0].line}: `).waitFor();
  const active = panel(page).locator(".cm-activeLine");
  assert.equal(await active.textContent(), FAULTY.split("\n")[found[0].line - 1]);
  assert.equal(await active.locator(".cm-lintRange").first().textContent(), "uper");

  const mended = FAULTY.replace("uper=", "upper=");
  assert.equal(await underlined(page, "uper").count(), 1);
  await panel(page)
    .locator(".here")
    .getByRole("button", { name: /^Fix: / })
    .first()
    .click();
  await becomes(page, mended);
  assert.ok(await panel(page).getByText("changed", { exact: true }).isVisible());
  await soon(async () => assert.equal(await underlined(page, "uper").count(), 0));
  await panel(page).getByRole("button", { name: "Undo" }).click();
  await becomes(page, FAULTY);
  await page.keyboard.press("Control+Shift+Z");
  await becomes(page, mended);
});

inPage(set, "a tooltip says what a program does with a part, and mends it where it moved to", async (page) => {
  await draft(page, FAULTY);
  await open(page);
  const word = underlined(page, "uper");
  await word.waitFor();
  // Nobody lints this edit, so the report stays that of the text before.
  await page.evaluate(() => {
    const { app } = globalThis.urdd;
    app.site.here.edit = (text) => app.store.set({ draft: { ...app.store.now.draft, text, isChanged: true } });
  });
  await content(page).press("Control+Home");
  await page.keyboard.type("<!-- \u{1F916} -->\n");
  await word.hover();
  const tip = panel(page).locator(".cm-tooltip-lint");
  await tip.getByText("LNT040").waitFor();
  await tip.getByText(/leaves it out|reads it otherwise/).waitFor();
  await tip.getByRole("button", { name: /Fix: / }).click();
  await becomes(page, `<!-- \u{1F916} -->\n${FAULTY.replace("uper=", "upper=")}`);
});

inPage(set, "all that is safe is mended as `urdd lint --fix` does, and saved", async (page) => {
  await draft(page, FAULTY);
  await open(page);
  const all = panel(page).getByRole("button", { name: /^Fix all that is safe \(\d+\)$/ });
  await all.click();
  await becomes(page, fixed(FAULTY));
  await soon(async () => assert.equal(await all.isVisible(), false));
  const download = page.waitForEvent("download");
  await content(page).press("Control+s");
  const saved = await download;
  assert.equal(saved.suggestedFilename(), NAME);
  assert.equal(readFileSync(await saved.path(), "utf8"), fixed(FAULTY));
  assert.equal(await panel(page).getByText("changed", { exact: true }).isVisible(), false);
});

inPage(set, "a fix in Findings changes the text, with the ends of its lines", async (page) => {
  const text = FAULTY.replaceAll("\n", "\r\n");
  await draft(page, text);
  await open(page);
  await content(page).press("Control+Home");
  await page.keyboard.type("<!-- -->");
  await page.keyboard.press("Enter");
  const typed = `<!-- -->\r\n${text}`;
  await becomes(page, typed);
  await state(page, "report", ({ report }) => report.text === typed);
  await page.click("#tab-Findings");
  const card = page.locator(".finding", { has: page.locator('strong:text-is("LNT040")') });
  await card
    .getByRole("button", { name: /^Fix: / })
    .first()
    .click();
  const mended = typed.replace("uper=", "upper=");
  await becomes(page, mended);
  await page.click("#tab-Text");
  await panel(page).getByRole("button", { name: "Undo" }).click();
  await becomes(page, typed);
});

inPage(set, "keys in the text are not those of the page, and it can be left by keys", async (page) => {
  await draft(page, SOUND);
  await page.click("#tab-Info");
  await page.keyboard.press("ArrowRight");
  await content(page).waitFor();
  await page.keyboard.press("ArrowRight");
  await state(page, "tab", (tab) => tab === "Joints");
  await page.keyboard.press("7");
  await content(page).press("Control+End");
  const before = await page.evaluate(() => globalThis.urdd.app.store.now.q);
  await page.keyboard.type("r1/");
  await becomes(page, `${SOUND}r1/`);
  assert.equal(await page.evaluate(() => globalThis.urdd.app.store.now.tab), "Text");
  assert.deepEqual(await page.evaluate(() => globalThis.urdd.app.store.now.q), before, "r is not random");
  await page.keyboard.press("Tab");
  assert.notEqual(await textNow(page), `${SOUND}r1/`, "Tab indents");
  const focused = () => page.evaluate(() => document.activeElement.className);
  assert.equal(await focused(), "editor");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  assert.notEqual(await focused(), "editor");
  await page.evaluate(() => globalThis.urdd.app.store.set({ draft: null }));
  await state(page, "tab", (tab) => tab === "Joints");
  await page.keyboard.press("7");
  assert.equal(await page.evaluate(() => globalThis.urdd.app.store.now.tab), "Joints", "there is no text");
});

inPage(set, "fixes of an import are not for its text", async (page) => {
  await draft(page, FAULTY, { format: "mjcf" });
  await open(page);
  await panel(page)
    .getByText(/Fixes are for the URDF that the import makes/)
    .waitFor();
  await panel(page).locator(".cm-lintRange").first().waitFor();
  assert.equal(await panel(page).getByRole("button", { name: /^Fix/ }).count(), 0);
  await page.click("#tab-Findings");
  assert.equal(
    await page
      .locator("#panel-Findings")
      .getByRole("button", { name: /^Fix: / })
      .count(),
    0,
  );
});

inPage(set, "leaving asks while a change is not saved", async (page) => {
  await draft(page, SOUND);
  const asked = () =>
    page.evaluate(() => !window.dispatchEvent(new window.Event("beforeunload", { cancelable: true })));
  assert.equal(await asked(), false);
  await open(page);
  await content(page).press("Control+End");
  await page.keyboard.type(" ");
  await becomes(page, `${SOUND} `);
  assert.equal(await asked(), true);
});

inPage(set, "hostile texts stay texts", async (page) => {
  const text = `<robot name="</script><img src=x onerror=alert(1)>">\u202egnp\u202a\u2066\u0000\u0007\u2028</robot>\rx\n`;
  await draft(page, text);
  await open(page);
  assert.equal(await textNow(page), text);
  const shown = await panel(page).locator(".cm-specialChar").count();
  assert.equal(shown, 7, "RLO, LRE, LRI, NUL, BEL, LS, CR");
  assert.equal(await panel(page).locator("img:not(.cm-widgetBuffer)").count(), 0);
  await content(page).press("Control+End");
  await page.keyboard.type("!");
  await becomes(page, `${text}!`);
});

inPage(set, "a text of one long line with 100,000 findings can be changed, and a huge one is shown", async (page) => {
  const text = `<robot>${"<link/>".repeat(700_000)}</robot>`;
  const places = Array.from({ length: 100_000 }, (_, k) => ({
    ...{ file: NAME, line: 1, column: 1 + ((k * 7919) % text.length) },
    ...{ pointer: null, subject: null, expected: null, actual: null, message: null, related: [], fixes: [] },
  }));
  const made = report(SOUND);
  const finding = { code: "LNT001", name: "a", severity: "info", message: "b", count: 100_000, programs: [], places };
  const first = { ...made, text, urdds: [{ ...made.urdds[0], findings: [finding] }] };
  await draft(page, text, { first });
  await page.evaluate(() => {
    const { app } = globalThis.urdd;
    app.site.here.edit = (text) => app.store.set({ draft: { ...app.store.now.draft, text, isChanged: true } });
  });
  await open(page);
  await panel(page).getByText("1: 1,000 findings").waitFor();
  assert.equal(await panel(page).locator(".here .finding").count(), 20);
  await content(page).press("Control+End");
  await page.keyboard.type("!");
  await soon(async () => assert.equal(await page.evaluate(() => globalThis.urdd.app.store.now.draft.text.at(-1)), "!"));
  await page.evaluate(() => {
    const { store } = globalThis.urdd.app;
    store.set({ draft: { ...store.now.draft, path: "huge.urdf", text: " ".repeat(10_000_001) } });
  });
  await panel(page).getByText("This text is too large to change here (10,000,001 characters).").waitFor();
  await content(page).press("Control+End");
  await page.keyboard.type("!");
  assert.equal(await page.evaluate(() => globalThis.urdd.app.store.now.draft.text.length), 10_000_001);
});

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
for (const colorScheme of ["dark", "light"]) {
  inPage(
    set,
    `no serious finding of axe-core in the text, ${colorScheme}`,
    async (page) => {
      await draft(page, FAULTY);
      await open(page);
      await panel(page).locator(".cm-lintRange").first().click();
      await panel(page).locator(".here .finding").first().waitFor();
      await content(page).press("Control+f");
      await panel(page).locator(".cm-search").waitFor();
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => globalThis.axe.run());
      const bad = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
      assert.deepEqual(
        bad.map(({ id, nodes }) => [
          id,
          nodes.slice(0, 3).map((node) => node.html.slice(0, 200) + node.failureSummary),
        ]),
        [],
      );
    },
    { colorScheme, bypassCSP: true },
  );
}
