// The built site on a plain file server: what a reader does with it. `.ci/site` builds it and runs this.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { browser, drawn, repository, tab } from "../../page/test/world.mjs";
import { serve } from "./serve.mjs";

const picture = process.env.PICTURES;
let chrome, server;

before(async () => {
  server = await serve(join(repository, "target/site"));
  chrome = await browser();
});
after(async () => {
  await chrome?.close();
  server?.end();
});

/** A test with a page of its own, without any console error or request elsewhere. */
function on(name, path, act, options = { colorScheme: "light" }) {
  test(name, { timeout: 120_000 }, async () => {
    const { page, faults, close } = await tab(chrome, server.address + path, options);
    try {
      await act(page);
      if (picture) {
        mkdirSync(picture, { recursive: true });
        await page.screenshot({ path: join(picture, `${name.replaceAll(/\W+/g, "_")}.png`) });
      }
      assert.deepEqual(faults, []);
    } finally {
      await close();
    }
  });
}

on("the start page", "", async (page) => {
  await page.getByRole("heading", { level: 1, name: "What your URDF gets" }).waitFor();
  const images = page.locator("article img");
  assert.equal(await images.count(), 4);
  for (const image of await images.all()) assert.ok(await image.evaluate((image) => image.decode().then(() => image.naturalWidth > 100)));
  await page.getByRole("link", { name: "Try it here" }).waitFor();
});

on("a robot of the start page opens", "", async (page) => {
  await page.getByRole("link", { name: /^quadruped/ }).click();
  await drawn(page, "quadruped");
});

on("the README, for a clone", "clone/", async (page) => {
  await page.getByRole("heading", { level: 1, name: "urdd" }).waitFor();
});

on("llms.txt", "", async (page) => {
  const text = await (await page.request.get(new URL("llms.txt", page.url()).href)).text();
  assert.match(text, /^# URDD\n\n> .+\n\n[^]*\n## Guide\n\n- \[See a robot\]\(docs\/view\/\): .+\n/);
  const links = [...text.matchAll(/^- \[[^\]]+\]\(([^)]+)\): .+$/gm)].map(([, link]) => link);
  assert.ok(links.length > 30, links.join());
  for (const link of links) assert.equal((await page.request.get(new URL(link, page.url()).href)).status(), 200, link);
});

/** Types into the search field, and opens the first page that is found. */
async function search(page, words) {
  await page.getByRole("textbox", { name: "Search" }).click();
  await page.keyboard.type(words);
  const first = page.locator(".md-search-result__item a").first();
  await first.waitFor();
  await first.click();
}

on("a search for a code finds its rule", "", async (page) => {
  await search(page, "MSH018");
  await page.getByRole("heading", { level: 1, name: /^MSH018 / }).waitFor();
  assert.match(new URL(page.url()).pathname, /\/rules\/MSH018\/$/);
  await page.getByRole("heading", { level: 2, name: "Cases" }).waitFor();
  // Its clause in the specification.
  await page.getByRole("link", { name: /^SPEC \d/ }).click();
  await page.waitForURL(/\/SPEC\/#\d+(\.\d+)*$/);
  const target = page.locator(`[id="${new URL(page.url()).hash.slice(1)}"]`);
  assert.equal(await target.count(), 1);
});

on("a search for a command finds its page", "", async (page) => {
  await search(page, "combine recipe");
  await page.getByRole("heading", { level: 1, name: /combine/i }).waitFor();
});

on("the specification", "SPEC/#6.2.3", async (page) => {
  const top = await page.locator('[id="6.2.3"]').evaluate((clause) => clause.getBoundingClientRect().top);
  assert.ok(top > 0 && top < 300, `clause 6.2.3 is at ${top} px`);
  await page.getByRole("link", { name: "DOF003", exact: true }).first().click();
  await page.getByRole("heading", { level: 1, name: /^DOF003 / }).waitFor();
});

on("the rules", "rules/", async (page) => {
  const rules = await page.locator("article table tbody tr").count();
  assert.ok(rules > 150, `${rules} rules`);
  // Each family is named, in the contents too.
  const titles = await page.getByRole("heading", { level: 2 }).allTextContents();
  assert.ok(titles.length > 15);
  for (const title of titles) assert.match(title, /^\w[\w ]+ \([A-Z]{3}\)/);
  await page.getByRole("link", { name: "Meshes (MSH)" }).first().waitFor();
});

on("a schema", "schema/dof_module/", async (page) => {
  const link = page.getByRole("link", { name: "dof_module/1.0.0.json" });
  const schema = await page.evaluate(async (address) => (await fetch(address)).json(), await link.evaluate((a) => a.href));
  assert.equal(schema.$id, "urn:urdd:schema:dof_module:1.0.0");
});

on("the page of a rule opens an example with its fault, to mend", "rules/LNT022/", async (page) => {
  await page.getByRole("link", { name: "Try it in the page" }).click();
  await page.locator(".finding strong", { hasText: "LNT022" }).first().waitFor();
  await page.waitForFunction(() => globalThis.urdd?.app.store.now.draft !== null);
  const codes = await page.evaluate(() =>
    globalThis.urdd.app.store.now.report.report.urdds[0].findings.map(({ code }) => code),
  );
  assert.ok(codes.includes("LNT022"), codes.join());
});

on("the gallery opens a robot", "robots/", async (page) => {
  await page.getByRole("link", { name: /welding_arm/ }).click();
  await drawn(page, "welding_arm");
});

for (const path of ["", "docs/validate/"])
  on(`a page in a narrow window: ${path || "the first"}`, path, async (page) => {
    await page.getByRole("heading", { level: 1 }).waitFor();
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `the page is ${wide} px wider than the window`);
  }, { viewport: { width: 390, height: 800 }, colorScheme: "dark" });
