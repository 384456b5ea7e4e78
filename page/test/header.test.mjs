// The header in windows of usual sizes: its pills are whole, the most important first, and the rest unfolds.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { drawn, setting, soon, state, tab, view } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-header-"));
after(() => rmSync(folder, { recursive: true, force: true }));

// With something of everything: a missing mesh, warnings, a contact, assumptions, and a long name.
const urdf = join(folder, "arm_with_a_gripper_and_a_camera.urdf");
const ball = '<collision><geometry><sphere radius="0.9"/></geometry></collision>';
const joint = (parent, child, z) =>
  `<joint name="${child}_joint" type="revolute"><origin xyz="0 0 ${z}"/><parent link="${parent}"/><child link="${child}"/>
  <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="0"/></joint>`;
writeFileSync(
  urdf,
  `<robot name="arm"><link name="a">${ball}</link>
  <link name="b"><visual><geometry><mesh filename="package://nowhere/b.obj"/></geometry></visual></link>
  <link name="c">${ball}</link><link name="d">${ball}</link>
  ${joint("a", "b", 1)}${joint("b", "c", 0.1)}${joint("c", "d", 4)}</robot>`,
);
const set = setting([], () => view(urdf));

/** The texts of the pills in the row, and of those that are cut off. */
function pills(page) {
  return page.evaluate(() => {
    const row = globalThis.document.querySelector(".chips");
    const { left, right } = row.getBoundingClientRect();
    const shown = [...row.children].filter((pill) => pill.checkVisibility());
    const isCut = (pill) => {
      const box = pill.getBoundingClientRect();
      return box.left < left - 1 || box.right > Math.min(right, globalThis.innerWidth) + 1;
    };
    return { shown: shown.map((pill) => pill.textContent), cut: shown.filter(isCut).map((pill) => pill.textContent) };
  });
}

for (const [width, height] of [
  [1360, 768],
  [1280, 720],
  [1181, 700],
  [390, 844],
  [320, 640],
])
  test(`${width} x ${height}: pills are whole, and the rest unfolds`, { timeout: 300_000 }, async () => {
    const options = { viewport: { width, height } };
    const { page, faults, close } = await tab(set.chrome, set.server.address, options);
    try {
      await drawn(page);
      // All is said: generated, measured, examined.
      await state(page, "making", ({ making }) => making === null);
      await state(page, "contacts");
      await state(page, "report", ({ report }) => report !== null);
      await soon(async () => assert.match((await pills(page)).shown.join(), /collision/));
      const { shown, cut } = await pills(page);
      assert.deepEqual(cut, []);
      assert.match(shown[0], /self-collision/, "the first pill is the most important one");
      const more = page.locator(".chips .more");
      const hasMore = await more.isVisible();
      const rest = page.locator(".rest > .chip");
      const number = await rest.count();
      assert.equal(hasMore ? await more.textContent() : "+0", `+${number}`);
      const all = [...shown, ...(await rest.allTextContents())].join();
      for (const word of ["self-collision", "warning", "not found", "not saved", "4 links", "assumption"])
        assert.equal(all.split(word).length, 2, `${word} once in ${all}`);
      if (!hasMore) return;
      assert.equal(await rest.first().isVisible(), false);
      await more.click();
      for (const pill of await rest.all()) {
        const { x, y, width: size, height: tall } = await pill.boundingBox();
        assert.ok(x >= 0 && x + size <= width && y >= 0 && y + tall <= height, await pill.textContent());
      }
      await rest.filter({ hasText: "assumption" }).click();
      assert.equal(await state(page, "tab"), "Info");
      assert.equal(await rest.first().isVisible(), false, "it folds");
      assert.deepEqual(faults, []);
    } finally {
      await close();
    }
  });
