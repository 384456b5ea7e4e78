// The pictures of the page in README and docs: made here, by `URDD_UPDATE=1 npm --prefix page test`, and held to what the
// page looks like now.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { drawn, inPage, repository, setting, soon, state, view } from "./world.mjs";

/** Share of a colour by which pictures may differ on average: fonts and drivers draw otherwise. */
const ALIKE = 0.06;

const set = setting(["welding_arm"]);

/** Share of a colour by which two pictures differ, the mean over all pixels; 1 where their sizes differ. */
function difference(page, ...pictures) {
  return page.evaluate(
    async (pictures) => {
      const [a, b] = await Promise.all(
        pictures.map(async (text) => {
          const bytes = Uint8Array.from(globalThis.atob(text), (char) => char.charCodeAt(0));
          const image = await globalThis.createImageBitmap(new globalThis.Blob([bytes]));
          const canvas = new globalThis.OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext("2d");
          context.drawImage(image, 0, 0);
          return context.getImageData(0, 0, image.width, image.height).data;
        }),
      );
      if (a.length !== b.length) return 1;
      return a.reduce((sum, value, k) => sum + Math.abs(value - b[k]), 0) / a.length / 255;
    },
    pictures.map((bytes) => bytes.toString("base64")),
  );
}

/** Compares the page with a picture of the documentation. */
async function shows(page, name) {
  await page.getByRole("button", { name: "Fit" }).click();
  await page.mouse.move(450, 708);
  await page.waitForTimeout(800);
  const file = join(repository, "docs/picture", name);
  if (process.env.URDD_UPDATE) writeFileSync(file, await page.screenshot({ type: "png" }));
  const kept = readFileSync(file);
  assert.ok(kept.length < 200_000, `${kept.length} bytes`);
  await soon(async () => {
    const apart = await difference(page, await page.screenshot({ type: "png" }), kept);
    assert.ok(apart < ALIKE, `${apart}: look at the page, then URDD_UPDATE=1`);
  });
}

inPage(set, "README shows the page as it is", async (page) => {
  await page.waitForFunction(() => globalThis.urdd?.stage.settledOn);
  await page.evaluate(() => {
    globalThis.urdd.app.move([0.6, 0.35, -0.35, 0.988, -0.18, 2.243]);
  });
  await page.getByRole("button", { name: "Pieces", exact: true }).click();
  await page.click("#tab-Proximity");
  await page.getByLabel("Kind of shapes").selectOption("hulls");
  await state(page, "proximity", (value) => value.answer !== null);
  await page.evaluate(() => {
    const { app } = globalThis.urdd;
    const { robot } = app.store.now;
    app.store.set({
      pair: [
        [robot.link("base"), 0],
        [robot.link("torch"), 0],
      ],
    });
  });
  await page.locator('.pair[aria-pressed="true"]').scrollIntoViewIfNeeded();
  await shows(page, "page.png");
});

const faulty = setting([], () => view(join(repository, "examples/robots/arm_with_faults.urdf")));

inPage(faulty, "docs/lint.md shows a finding on a robot, and its lines in the text", async (page) => {
  await drawn(page, "arm_with_faults");
  await page.click("#tab-Findings");
  await state(page, "report", ({ report }) => report !== null);
  await page.locator(".place", { hasText: "joint bend" }).first().click();
  await page.locator(".line.at").waitFor();
  await page.evaluate(() => {
    globalThis.urdd.app.move([0.6, 0.7]);
    globalThis.urdd.app.select(null);
  });
  await state(page, "making", ({ making }) => making === null);
  await shows(page, "lint.png");
});
