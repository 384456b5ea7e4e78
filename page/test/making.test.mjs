// A URDF that is generated while the page is open, and saved; a URDD in the current folder.

import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { drawn, inPage, read, repository, run, setting, soon, state, tab, view } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-making-"));
// A robot of which something has to be assumed, and a package of meshes that is not there.
const urdf = join(folder, "odd.urdf");
writeFileSync(
  urdf,
  `<robot name="odd"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual>
   <visual><geometry><mesh filename="package://nowhere/a.stl"/></geometry></visual></link>
   <link name="b"><visual><origin xyz="0 0 2"/><geometry><sphere radius="0.3"/></geometry></visual></link>
   <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
   <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>`,
);
const set = setting([], () => view(urdf));

inPage(
  set,
  "it is shown when it is made, what was assumed is said, and it is saved where a person says",
  async (page) => {
    await drawn(page, "odd");
    const { notes } = (await state(page, "robot")).entry;
    assert.ok(notes.length > 0);
    // The header folds what has no room.
    const more = page.locator(".chip.more");
    if (await more.isVisible()) await more.click();
    await page.getByText("not saved", { exact: true }).waitFor();
    await page.getByRole("button", { name: /assumption/ }).click();
    assert.equal(await page.locator("#panel-Info .notes li").count(), notes.length);
    const mine = join(folder, "mine");
    mkdirSync(mine);
    writeFileSync(join(mine, "letter.txt"), "mine");
    await page.getByRole("button", { name: "Save…" }).click();
    const dialog = page.getByRole("dialog");
    await dialog.getByLabel("Folder").fill(mine);
    await dialog.getByRole("button", { name: "Save" }).click();
    await dialog.getByText("this folder is not empty").waitFor();
    assert.deepEqual(readdirSync(mine), ["letter.txt"]);
    // A decision that was not saved yet stays, and is saved there.
    await dialog.getByRole("button", { name: "Cancel" }).click();
    await page.click("#tab-Skips");
    await state(page, "skips", (value) => value.answer !== null);
    await page.evaluate(() => {
      const pair = [
        [0, 0],
        [1, 0],
      ];
      globalThis.urdd.app.store.set({ pair });
    });
    await page.getByRole("button", { name: "Skip", exact: true }).click();
    await state(page, "skips", (value) => value.dirty);
    await page.getByText("This URDD is temporary").waitFor();
    await page.getByRole("button", { name: "Save…" }).click();
    const target = join(folder, "saved/odd");
    await dialog.getByLabel("Folder").fill(target);
    await dialog.getByRole("button", { name: "Save" }).click();
    await page.getByText("not saved", { exact: true }).waitFor({ state: "detached" });
    await drawn(page, "odd");
    assert.ok(existsSync(join(target, "urdd.json")));
    assert.notEqual(run("validate", target).status, 2);
    assert.equal((await state(page, "robot")).entry.writable, true);
    await page.getByRole("button", { name: "Save", exact: true }).click();
    await state(page, "skips", (value) => !value.dirty);
    const module = join(target, "link_shapes_modules/link_shapes_skips_module/module.json");
    assert.deepEqual(
      read(module).edits.map(({ link_a, link_b, skip }) => [link_a, link_b, skip]),
      [["a", "b", true]],
    );
  },
  { faults: ["Failed to load resource: the server responded with a status of 409 (Conflict)"] },
);

test(
  "a URDF that makes no robot: the page says why, and shows it once it is mended",
  { timeout: 300_000 },
  async () => {
    const bad = join(folder, "bad.urdf");
    writeFileSync(bad, `<robot name="bad"><link name="a"/><link name="a"/></robot>`);
    const server = await view(bad);
    const { page, close } = await tab(set.chrome, server.address);
    await page.getByText("Generation of bad failed").waitFor();
    writeFileSync(bad, `<robot name="bad"><link name="a"/></robot>`);
    await drawn(page, "bad");
    await close();
    server.end();
    assert.equal(await server.status, 0);
  },
);

test("a pose is saved as a named configuration, and is a button then", { timeout: 300_000 }, async () => {
  const here = join(folder, "named");
  const made = run("generate", join(repository, "conformance/robots/gripper.urdf"), "-o", here);
  assert.equal(made.status, 0, made.stderr);
  const server = await view(here);
  const { page, close } = await tab(set.chrome, server.address);
  await drawn(page);
  await page.click("#tab-Joints");
  await page.getByRole("button", { name: "Middle", exact: true }).click();
  const q = await state(page, "q", (value) => value.some((position) => position !== 0));
  await page.fill("#pose-name", "ready");
  // The page looks for changes of the files while they are saved: its own are none.
  await page.evaluate(() => {
    globalThis.notes = [];
    globalThis.urdd.app.store.on(["note"], ({ note }) => globalThis.notes.push(note));
  });
  let looked = 0;
  await page.route("**/configurations", async (route) => {
    const response = await route.fetch();
    looked = 0;
    await soon(() => assert.ok(looked > 1));
    await route.fulfill({ response });
  });
  page.on("response", (response) => (looked += response.url().endsWith("/revision.json") ? 1 : 0));
  await page.getByRole("button", { name: "Save pose", exact: true }).click();
  await page.getByRole("button", { name: "ready", exact: true }).waitFor();
  const module = join(here, "named_configurations_module/module.json");
  assert.deepEqual(read(module).configurations[0].configuration, q);
  assert.deepEqual(await page.evaluate(() => globalThis.notes), [null, "Saved as `ready`."]);
  await page.getByRole("button", { name: "Zero", exact: true }).click();
  await page.fill("#pose-name", "ready");
  await page.getByRole("button", { name: "Replace pose", exact: true }).click();
  await state(page, "robot", (robot) => robot && robot.named[0].q[0] !== q[0]);
  assert.equal(run("validate", "--fail-on", "info", here).status, 0);
  await close();
});

test("skips of a URDD in the current folder are saved, and the folder stays", { timeout: 300_000 }, async () => {
  const here = join(folder, "gripper");
  const made = run("generate", join(repository, "conformance/robots/gripper.urdf"), "-o", here);
  assert.equal(made.status, 0, made.stderr);
  const server = await view(".", { cwd: here });
  const { page, close } = await tab(set.chrome, server.address);
  await drawn(page);
  await page.click("#tab-Skips");
  await state(page, "skips", (value) => value.answer !== null);
  const { links } = await state(page, "robot");
  await page.evaluate(() => {
    globalThis.urdd.app.store.set({
      pair: [
        [0, 0],
        [2, 0],
      ],
    });
  });
  await page.getByRole("button", { name: "Skip", exact: true }).click();
  await state(page, "skips", (value) => value.dirty);
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await state(page, "skips", (value) => !value.dirty && value.saved === 1);
  const module = join(here, "link_shapes_modules/link_shapes_skips_module/module.json");
  assert.deepEqual(read(module).edits[0].link_a, links[0].name);
  assert.equal(run("validate", "--fail-on", "info", here).status, 0);
  const left = readdirSync(folder).filter((name) => name.startsWith(".urdd"));
  assert.deepEqual(left, [], "nothing is left beside it");
  await close();
  server.end();
});

test.after(() => {
  rmSync(folder, { recursive: true, force: true });
});
