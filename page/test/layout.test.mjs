// Narrow windows: panels fold, the picture keeps most of the screen, and all is reached by touch and by keys.

import assert from "node:assert/strict";
import { test } from "node:test";
import { drawn, setting, soon, state, tab } from "./world.mjs";

const set = setting(["welding_arm", "gripper"]);
const TABS = ["Joints", "Shapes", "Proximity", "Skips", "Findings", "Info"];

/** Opens a robot in a window of this size, by taps where it has touch. */
async function narrow(width, height, options, act) {
  const { page, faults, close } = await tab(set.chrome, set.server.address, {
    viewport: { width, height },
    ...options,
  });
  try {
    const card = page.locator(".card", { hasText: "welding_arm" });
    await (options.hasTouch ? card.tap() : card.click());
    await drawn(page, "welding_arm");
    await act(page);
    assert.deepEqual(faults, []);
  } finally {
    await close();
  }
}

/** The share of the window that the picture has, and what sticks out of the window. */
function layout(page) {
  return page.evaluate(() => {
    const { innerWidth: width, innerHeight: height } = globalThis;
    const box = globalThis.document.querySelector(".stage canvas").getBoundingClientRect();
    const out = [...globalThis.document.querySelectorAll("button, select, input, h1, .status > *")].filter(
      (element) => {
        if (!element.checkVisibility()) return false;
        // What scrolls may be out of sight.
        if (element.closest(".tablist, .body, .rows, .views")) return false;
        const { left, right, top, bottom } = element.getBoundingClientRect();
        return left < -1 || right > width + 1 || top < -1 || bottom > height + 1;
      },
    );
    return {
      share: (box.width * box.height) / (width * height),
      out: out.map((element) => element.outerHTML.slice(0, 80)),
    };
  });
}

for (const [width, height, least] of [
  [390, 844, 0.6],
  [768, 1024, 0.6],
  [900, 700, 0.5],
  [1280, 720, 0.4],
  [1920, 1080, 0.5],
])
  test(`${width} x ${height}: the picture keeps its share, and nothing sticks out`, { timeout: 300_000 }, () =>
    narrow(width, height, {}, async (page) => {
      const { share, out } = await layout(page);
      assert.deepEqual(out, []);
      assert.ok(share >= least, `${share}`);
    }),
  );

test("390 x 844 by touch: every panel, the tree, and the picture again", { timeout: 300_000 }, () =>
  narrow(390, 844, { hasTouch: true, isMobile: true }, async (page) => {
    for (const name of TABS) {
      await page.locator(`#tab-${name}`).tap();
      await page.locator(`#panel-${name}`).waitFor();
      const { share, out } = await layout(page);
      assert.deepEqual(out, [], name);
      assert.ok(share > 0.3, `${name}: ${share}`);
    }
    await page.locator("#tab-Info").tap();
    await page.locator("#panel-Info").waitFor({ state: "hidden" });
    assert.equal(await page.locator(".tree").isVisible(), false);
    await page.getByRole("button", { name: "Links" }).tap();
    await page.locator(".row", { hasText: "torch" }).first().tap();
    assert.equal((await state(page, "selected")).kind, "link");
    await page.locator(".tree").waitFor({ state: "hidden" });
  }),
);

test("900 x 700 by keys: a link is found, a panel is opened, and Escape folds", { timeout: 300_000 }, () =>
  narrow(900, 700, {}, async (page) => {
    await page.keyboard.press("Escape");
    await page.locator("#picture").focus();
    await page.keyboard.press("/");
    await page.keyboard.type("torch");
    await page.keyboard.press("Enter");
    assert.equal((await state(page, "selected")).kind, "link");
    await page.keyboard.press("Escape");
    await page.locator("#picture").focus();
    await page.keyboard.press("Escape");
    await page.locator(".tree").waitFor({ state: "hidden" });
    await page.keyboard.press("4");
    await soon(async () => assert.equal(await state(page, "tab"), "Skips"));
    await page.locator("#panel-Skips").waitFor();
  }),
);
