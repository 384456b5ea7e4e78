// Whether everybody can use the page: axe-core on every panel, dark and light.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";
import { open, setting, state, tab } from "./world.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const set = setting(["welding_arm", "gripper"]);

for (const colorScheme of ["dark", "light"]) {
  test(`no serious finding of axe-core, ${colorScheme}`, { timeout: 300_000 }, async () => {
    const { page, close } = await tab(set.chrome, set.server.address, { colorScheme, bypassCSP: true });
    await page.waitForSelector(".card");
    await page.evaluate(axe);
    const bad = [];
    const look = async (where) => {
      const { violations } = await page.evaluate(() => globalThis.axe.run());
      for (const { id, impact, nodes } of violations) {
        if (impact === "serious" || impact === "critical")
          bad.push(
            `${where}: ${id}: ${nodes
              .map((node) => `${node.html.slice(0, 120)} ${node.failureSummary?.slice(0, 160)}`)
              .slice(0, 3)
              .join(" | ")}`,
          );
      }
    };
    await look("gallery");
    await open(page, "welding_arm");
    for (const name of ["Joints", "Shapes", "Proximity", "Skips", "Findings", "Info"]) {
      await page.click(`#tab-${name}`);
      if (name === "Proximity") {
        await state(page, "proximity", (value) => value.answer !== null);
        await page.locator(".pair").first().click();
      }
      if (name === "Skips") await state(page, "skips", (value) => value.answer !== null);
      if (name === "Findings") await state(page, "report", (value) => value.report !== null);
      await look(name);
    }
    await close();
    assert.deepEqual(bad, []);
  });
}
