// URDFs as their authors work on them: changed on disk, broken and mended, in a folder, dropped on the page.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { drawn, dropOn, inPage, open, setting, soon, state, tab, view } from "./world.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-live-"));
after(() => rmSync(folder, { recursive: true, force: true }));

const MESH = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

function robot({ upper = 1, radius = 0.3, joint = "j", more = "" } = {}) {
  return `<robot name="arm">${more}<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
    <link name="b"><visual><origin xyz="0 0 2"/><geometry><sphere radius="${radius}"/></geometry></visual></link>
    <joint name="${joint}" type="revolute"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="${upper}" effort="1" velocity="1"/></joint></robot>`;
}

/** As editors do: another file takes the place of the first. */
function replace(path, text) {
  writeFileSync(`${path}.new`, text);
  renameSync(`${path}.new`, path);
}

const urdf = join(folder, "arm.urdf");
writeFileSync(urdf, robot());
const set = setting([], () => view(urdf));

const isWhole = (robot) => robot && robot.entry.making === null;
const height = (page) => page.evaluate(() => globalThis.urdd.stage.scene.bounds().max.z);
const bounds = (page) => page.evaluate(() => globalThis.urdd.app.store.now.robot?.about.dofs.at(-1).bounds);

inPage(set, "a limit and a radius that change on disk are shown, and the view stays", async (page) => {
  await drawn(page, "arm");
  await page.click("#tab-Info");
  await page.evaluate(() => {
    globalThis.urdd.app.setDof(0, 0.5);
    globalThis.urdd.stage.place([3, 4, 5, 0, 0, 1]);
    globalThis.urdd.app.select({ kind: "link", index: 1 });
  });
  const before = await height(page);
  replace(urdf, robot({ upper: 2, radius: 0.6 }));
  await soon(async () => assert.deepEqual(await bounds(page), [-1, 2]));
  await drawn(page, "arm");
  await soon(async () => assert.ok((await height(page)) > before + 0.1, `${before} ${await height(page)}`));
  const view = async () => {
    const { q, tab, selected } = await page.evaluate(() => {
      const { q, tab, selected } = globalThis.urdd.app.store.now;
      return { q, tab, selected };
    });
    const camera = await page.evaluate(() => globalThis.urdd.stage.view.camera.position.toArray());
    return { q, tab, selected, camera: camera.map((x) => Math.round(1e6 * x) / 1e6) };
  };
  const expected = { q: [0.5], tab: "Info", selected: { kind: "link", index: 1 }, camera: [3, 4, 5] };
  assert.deepEqual(await view(), expected);
  // The rest follows: distances, and no change of the view.
  await state(page, "robot", isWhole);
  await page.click("#tab-Proximity");
  await state(page, "proximity", ({ answer }) => answer !== null);
  assert.deepEqual(await view(), { ...expected, tab: "Proximity" });
  // Joints and links are known by their names: a new link before them moves their indices.
  replace(urdf, robot({ upper: 0.25, radius: 0.6, more: `<link name="world"/>` + fixed("world", "a") }));
  await soon(async () => assert.deepEqual(await bounds(page), [-1, 0.25]));
  const now = await view();
  assert.deepEqual(now.q, [0.25], "the position stays within its new limits");
  const { links } = await state(page, "robot");
  assert.equal(links[now.selected.index].name, "b");
});

function fixed(parent, child) {
  return `<joint name="${parent}_${child}" type="fixed"><parent link="${parent}"/><child link="${child}"/></joint>`;
}

inPage(set, "lists stay where they are scrolled while the file is saved", async (page) => {
  const more = Array.from({ length: 20 }, (_, k) => `<link name="tool ${k}"/>${turning("b", `tool ${k}`)}`).join("");
  replace(urdf, robot({ more }));
  await page.setViewportSize({ width: 1280, height: 420 });
  await drawn(page, "arm");
  await soon(async () => assert.equal(await page.locator(".joint").count(), 21));
  const lists = { "#panel-Joints": 400, "#links .rows": 150 };
  for (const [list, top] of Object.entries(lists))
    await page.locator(list).evaluate((element, top) => element.scrollTo(0, top), top);
  replace(urdf, robot({ more, upper: 0.5 }));
  await soon(async () => assert.deepEqual(await bounds(page), [-1, 0.5]));
  await drawn(page, "arm");
  for (const [list, top] of Object.entries(lists))
    assert.equal(await page.locator(list).evaluate(({ scrollTop }) => scrollTop), top, list);
  replace(urdf, robot());
  await soon(async () => assert.equal(await page.locator(".joint").count(), 1));
});

function turning(parent, child) {
  return fixed(parent, child)
    .replace('type="fixed"', 'type="continuous"')
    .replace("</joint>", '<axis xyz="1 0 0"/></joint>');
}

inPage(set, "a URDF that breaks: the page says so, keeps the picture, and goes on when it is mended", async (page) => {
  replace(urdf, robot());
  await drawn(page, "arm");
  const line = page.locator(".broken");
  assert.equal(await line.isVisible(), false);
  replace(urdf, robot().replace("</joint>", "</jiont>"));
  await line.getByText(/The page shows the last version that could be read.*arm\.urdf/).waitFor();
  assert.ok(await state(page, "robot"));
  assert.equal(await page.locator(".failure").isVisible(), false);
  rmSync(urdf);
  await line.getByText(/arm\.urdf/).waitFor();
  replace(urdf, robot({ upper: 0.75 }));
  await soon(async () => assert.deepEqual(await bounds(page), [-1, 0.75]));
  await line.waitFor({ state: "hidden" });
});

inPage(set, "a URDF that is dropped with its meshes is shown with them, and alone without", async (page) => {
  await drawn(page, "arm");
  // A browser gives no drop to a page that is busy.
  await state(page, "robot", isWhole);
  const dropped = join(folder, "dropped_description");
  for (const inside of ["urdf", "meshes"]) mkdirSync(join(dropped, inside), { recursive: true });
  const mesh = `<robot name="tool"><link name="a"><visual><geometry>
    <mesh filename="package://dropped_description/meshes/tool.obj"/></geometry></visual></link></robot>`;
  writeFileSync(join(dropped, "urdf/tool.urdf"), mesh);
  writeFileSync(join(dropped, "meshes/tool.obj"), MESH);
  writeFileSync(join(dropped, "notes.txt"), "mine");
  await dropOn(page, dropped);
  await drawn(page, "tool");
  const { entry } = await state(page, "robot", (robot) => isWhole(robot) && robot.entry.name === "tool");
  assert.equal(entry.temporary, true);
  // Nothing but that no link has a collision element.
  assert.equal(entry.notes.length, 1);
  assert.match(entry.notes[0], /no link has a collision element/);
  assert.equal(await page.getByRole("button", { name: /not found/ }).count(), 0);
  // The files of the drop that its URDF names, and the folder above it.
  await dropOn(page, join(dropped, "urdf/tool.urdf"), join(dropped, "meshes"));
  await state(page, "robot", (robot) => isWhole(robot) && robot.entry.id === "here.2");
  assert.equal(await page.getByRole("button", { name: /not found/ }).count(), 0);
  await dropOn(page, join(dropped, "urdf/tool.urdf"));
  // The header may have folded the button that says so.
  await state(page, "absent", (absent) => absent.length === 1);
  // A .zip of the folder has what is missing.
  const script = "import shutil, sys; shutil.make_archive(sys.argv[1], 'zip', *sys.argv[2:])";
  const zip = join(folder, "zipped");
  assert.equal(spawnSync("python3", ["-c", script, zip, folder, "dropped_description"]).status, 0);
  await dropOn(page, `${zip}.zip`);
  await state(page, "absent", (absent) => absent.length === 0);
  await state(page, "robot", (robot) => isWhole(robot) && robot.entry.id === "here.3");
  assert.equal(await page.getByRole("button", { name: /not found/ }).count(), 0);
  await page.getByRole("button", { name: "All robots" }).click();
  assert.equal(await page.locator(".card").count(), 4);
});

test("a folder of URDFs is a gallery, and each is generated when it is opened", { timeout: 300_000 }, async () => {
  const robots = join(folder, "robots");
  mkdirSync(robots);
  for (const name of ["one", "two"]) writeFileSync(join(robots, `${name}.urdf`), robot());
  const server = await view(robots);
  const { page, faults, close } = await tab(set.chrome, server.address);
  await page.locator(".card").nth(1).waitFor();
  assert.equal(await page.getByText("generated when it is opened").count(), 2);
  // Each card has a picture before.
  await page.locator(".card img").nth(1).waitFor();
  assert.equal(await page.getByText("generated when it is opened").count(), 2);
  await open(page, "one");
  await state(page, "robot", isWhole);
  await page.getByRole("button", { name: "All robots" }).click();
  await page
    .locator(".card", { hasText: "one" })
    .getByText(/passes|fails/)
    .waitFor();
  await page.locator(".card", { hasText: "two" }).getByText("generated when it is opened").waitFor();
  assert.deepEqual(faults, []);
  await close();
  server.end();
});

test(
  "cards are drawn when they become visible, and one that cannot be is as it was",
  { timeout: 300_000 },
  async () => {
    const robots = join(folder, "many");
    mkdirSync(robots);
    const names = Array.from({ length: 60 }, (_, k) => `robot_${String(k).padStart(2, "0")}`);
    for (const name of names) writeFileSync(join(robots, `${name}.urdf`), robot());
    writeFileSync(join(robots, "robot_00.urdf"), "<robot name=");
    const server = await view(robots);
    const { page, faults, close } = await tab(set.chrome, server.address);
    const of = (name) => page.locator(".card", { has: page.locator(`strong:text-is("${name}")`) });
    await of("robot_01").locator("img").waitFor();
    const pictures = page.locator(".card img");
    // Until all that are visible have one.
    let count = 0;
    await soon(async () => {
      const before = count;
      count = await pictures.count();
      await new Promise((resolve) => setTimeout(resolve, 1500));
      assert.equal(before, count);
    });
    assert.ok(count > 3 && count < 55, `${count} pictures`);
    assert.equal(await of("robot_00").locator("img").count(), 0);
    await of("robot_00").getByText("generated when it is opened").waitFor();
    assert.equal(await of("robot_59").locator("img").count(), 0);
    await of("robot_59").scrollIntoViewIfNeeded();
    await of("robot_59").locator("img").waitFor();
    await of("robot_59").click();
    await drawn(page, "robot_59");
    assert.deepEqual(faults, []);
    await close();
    server.end();
  },
);
