// What a page on a plain file server makes of a description that is dropped on it. The program is asked about what is saved.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { exported } from "./exported.mjs";
import { drawn, dropOn, inPage, press, repository, run, setting, soon, state } from "./world.mjs";

const set = setting(["gripper", "single_link"], exported);
const robots = join(repository, "conformance/robots");

async function dropped(page, ...paths) {
  await page.waitForSelector(".card");
  await dropOn(page, ...paths);
}

/** Waits until all of the robot is made. */
async function whole(page, name) {
  await state(page, "robot", (robot) => robot !== null && robot.entry.ready && robot.entry.making === null);
  await drawn(page, name);
}

/** Clicks, and keeps what is downloaded; a .zip is unpacked. */
async function saved(page, click) {
  const coming = page.waitForEvent("download");
  await click();
  const download = await coming;
  const folder = join(set.made.folder, `saved-${Date.now()}`);
  mkdirSync(folder);
  const file = join(folder, download.suggestedFilename());
  await download.saveAs(file);
  if (!file.endsWith(".zip")) return file;
  const script = "import sys, zipfile; zipfile.ZipFile(sys.argv[1]).extractall(sys.argv[2])";
  const done = spawnSync("python3", ["-c", script, file, join(folder, "unpacked")], { encoding: "utf8" });
  assert.equal(done.status, 0, done.stderr);
  return join(folder, "unpacked");
}

const click = (page, name) => () => page.getByRole("button", { name, exact: true }).click();

inPage(set, "a URDF becomes a robot: findings first, then the rest; what is saved passes", async (page) => {
  const urdf = join(set.made.folder, "gripper.urdf");
  cpSync(join(robots, "gripper.urdf"), urdf);
  await dropped(page, urdf);
  await state(page, "report", (value) => value.report !== null);
  await whole(page, "gripper");
  const { report } = await state(page, "report", (value) => value.report !== null);
  const native = JSON.parse(run("lint", urdf, "--format", "json").stdout);
  assert.deepEqual(report.urdds[0].findings, native.urdds[0].findings);
  assert.deepEqual(report.urdds[0].programs, native.urdds[0].programs);
  await page.click("#tab-Proximity");
  const { answer } = await state(page, "proximity", (value) => value.answer !== null);
  assert.ok(answer.pairs > 0);
  await click(page, "Save…")();
  await page.getByText("The URDD passes.").waitFor();
  const folder = join(await saved(page, click(page, "Save the URDD")), "gripper");
  const done = run("validate", "--fail-on", "info", folder);
  assert.equal(done.status, 0, done.stdout);
  // Of the program's own bytes only those differ that come from sines and cosines.
  const own = join(set.made.robots, "gripper");
  const files = readdirSync(own, { recursive: true }).filter((path) => /\.(?:json|ya?ml|glb|stl|obj)$/.test(path));
  const others = files.filter((path) => !readFileSync(join(own, path)).equals(readFileSync(join(folder, path))));
  const allowed = /^urdd\.json$|^kinematics_samples_module\/|distance_statistics|^dof_module/;
  assert.deepEqual(
    others.filter((path) => !allowed.test(path)),
    [],
  );
});

inPage(set, "meshes that are missing are asked for by their package, and are taken", async (page) => {
  const urdf = join(set.made.folder, "welding_arm.urdf");
  cpSync(join(robots, "welding_arm.urdf"), urdf);
  await dropped(page, urdf);
  await drawn(page, "welding_arm");
  await page.getByText("Drop the folder of urdd_robots here, or choose it.").waitFor();
  // A browser gives no drop to a page that is busy.
  await whole(page, "welding_arm");
  const found = join(set.made.folder, "urdd_robots");
  cpSync(robots, found, { recursive: true });
  await dropOn(page, found);
  await state(page, "absent", (absent) => absent.length === 0);
  await whole(page, "welding_arm");
  await soon(async () => assert.equal(await page.locator(".absent").isVisible(), false));
  const { about } = await state(page, "robot");
  assert.ok(about.meshes.pieces.every((pieces, link) => pieces.length > 0 || about.links[link].name.includes("point")));
});

inPage(set, "an MJCF and an SDF become robots, and files for other programs are saved", async (page) => {
  await dropped(page, join(repository, "examples/mjcf"));
  await state(page, "robot", (robot) => robot !== null && robot.entry.making === null);
  await click(page, "Save…")();
  await page.getByLabel("Format").selectOption("mjcf");
  const dialog = page.getByRole("dialog");
  const folder = await saved(page, () => dialog.getByRole("button", { name: "Save", exact: true }).click());
  const [file] = readdirSync(folder).filter((name) => name.endsWith(".xml"));
  assert.match(readFileSync(join(folder, file), "utf8"), /<mujoco /);
  const imported = await saved(page, click(page, "Save as URDF, with meshes"));
  const [urdf] = readdirSync(imported).filter((name) => name.endsWith(".urdf"));
  assert.notEqual(run("lint", join(imported, urdf)).status, 2);
  await dialog.getByRole("button", { name: "Close" }).click();
  await dropOn(page, join(repository, "examples/sdf"));
  await state(page, "draft", (draft) => draft?.format === "sdf");
  await state(page, "robot", (robot) => robot !== null && robot.entry.making === null);
  const { report } = await state(page, "report", (value) => value.report !== null);
  assert.equal(report.urdds[0].imported.format, "sdf");
});

inPage(set, "a USD of several layers becomes a robot, and one that is no text has no tab for it", async (page) => {
  await dropped(page, join(repository, "examples/usd"));
  const draft = await state(page, "draft", (draft) => draft?.format === "usd");
  assert.ok(draft.text.startsWith("#usda"));
  const { about } = await state(page, "robot", (robot) => robot !== null && robot.entry.making === null);
  assert.equal(about.links.length, 7);
  await page.getByRole("tab", { name: "Text" }).waitFor();
  await page.getByRole("button", { name: "All robots" }).click();
  await dropOn(page, join(repository, "crates/urdd-usd/tests/fixtures/arm.usdz"));
  const binary = await state(page, "draft", (draft) => draft?.path.endsWith("arm.usdz"));
  assert.equal(binary.text, null);
  const { about: arm } = await state(
    page,
    "robot",
    (robot) => robot?.entry.name === "arm" && robot.entry.making === null,
  );
  assert.deepEqual(
    arm.links.map(({ name }) => name),
    ["base", "upper"],
  );
  assert.equal(await page.getByRole("tab", { name: "Text" }).isVisible(), false);
  await click(page, "Save…")();
  assert.equal(await page.getByRole("button", { name: "Save arm.usdz" }).isVisible(), false);
  const folder = await saved(page, click(page, "Save as URDF, with meshes"));
  assert.ok(readdirSync(folder).some((name) => name.endsWith(".urdf")));
});

inPage(
  set,
  "several robots are cards, of a folder and of a .zip; a xacro file is told how to expand it",
  async (page) => {
    const folder = join(set.made.folder, "several");
    mkdirSync(folder);
    for (const name of ["hand", "planar_base_arm"]) cpSync(join(robots, `${name}.urdf`), join(folder, `${name}.urdf`));
    writeFileSync(join(folder, "odd.urdf.xacro"), '<robot name="odd"/>');
    await dropped(page, folder);
    await page.getByRole("button", { name: /^single_link/ }).click();
    await whole(page, "single_link");
    await page.getByRole("button", { name: "All robots" }).click();
    await page.getByRole("button", { name: /^odd/ }).click();
    await page.getByText(/xacro odd\.urdf\.xacro > odd\.urdf/).waitFor();
    await page.getByRole("button", { name: "Back" }).click();
    const zip = join(set.made.folder, "one");
    const script = "import shutil, sys; shutil.make_archive(sys.argv[1], 'zip', *sys.argv[2:])";
    mkdirSync(join(set.made.folder, "inside"));
    cpSync(join(robots, "scaled_parts.urdf"), join(set.made.folder, "inside/scaled_parts.urdf"));
    assert.equal(spawnSync("python3", ["-c", script, zip, join(set.made.folder, "inside")]).status, 0);
    await page.waitForSelector(".card:visible");
    await dropOn(page, `${zip}.zip`);
    await whole(page, "scaled_parts");
  },
);

inPage(set, "a text is mended and edited, the picture follows, and the edited URDF is saved", async (page) => {
  const urdf = join(set.made.folder, "broken.urdf");
  const good = readFileSync(join(robots, "gripper.urdf"), "utf8");
  writeFileSync(urdf, good.replace("</robot>", "<link name='base'/><link name='base'/></robot>"));
  await dropped(page, urdf);
  await page.getByText(/Generation of broken failed: broken\.urdf/).waitFor();
  await state(page, "report", (value) => value.report?.urdds[0].verdict === "fail");
  const edit = (text) => page.evaluate((text) => globalThis.urdd.app.site.here.edit(text), text);
  await edit(good);
  await whole(page, "broken");
  const { report } = await state(page, "report", (value) => value.report !== null);
  assert.equal(report.urdds[0].verdict, "pass");
  const links = (await state(page, "robot")).links.length;
  // Nonsense at ten keys a second, and then a robot with a link more.
  for (let k = 1; k <= 20; k++) {
    await edit(good.slice(0, good.length - 3 * k));
    await page.waitForTimeout(100);
  }
  await page.getByText(/The page shows the last version that could be read/).waitFor();
  assert.equal((await state(page, "robot")).links.length, links);
  await edit(
    good.replace(
      "</robot>",
      `<link name="more"/><joint name="to_more" type="fixed"><parent link="${(await state(page, "robot")).links[0].name}"/><child link="more"/></joint></robot>`,
    ),
  );
  await state(page, "robot", (robot) => robot?.links.some(({ name }) => name === "more"));
  await whole(page, "broken");
  await click(page, "Save…")();
  const file = await saved(page, click(page, "Save broken.urdf"));
  assert.match(readFileSync(file, "utf8"), /to_more/);
  assert.equal((await state(page, "draft")).isChanged, false);
});

/** A chain of links, each with a mesh of its own size: it takes seconds to make. */
function long(folder) {
  mkdirSync(join(folder, "meshes"), { recursive: true });
  cpSync(join(robots, "meshes/welding_arm/forearm.stl"), join(folder, "meshes/forearm.stl"));
  const links = Array.from({ length: 40 }, (_, k) => {
    const scale = Array(3)
      .fill(1 + k / 100)
      .join(" ");
    return `<link name="l${k}"><visual><geometry><mesh filename="meshes/forearm.stl" scale="${scale}"/></geometry></visual></link>`;
  });
  const joints = links.slice(1).map(
    (_, k) =>
      `<joint name="j${k}" type="revolute"><origin xyz="0 0 0.3"/><parent link="l${k}"/><child link="l${k + 1}"/>
       <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>`,
  );
  writeFileSync(join(folder, "long.urdf"), `<robot name="long">${links.join("")}${joints.join("")}</robot>`);
}

inPage(set, "Stop keeps what is there, and the rest is made when it is asked for", async (page) => {
  const folder = join(set.made.folder, "long");
  long(folder);
  await dropped(page, folder);
  await drawn(page, "long", { isPartial: true });
  await press(page, "Stop");
  await state(page, "making", ({ making, failure }) => making === null && /Stopped/.test(failure));
  await drawn(page, "long");
  assert.equal((await state(page, "robot")).entry.making, null);
  await press(page, "Generate the rest");
  await state(page, "robot", (robot) => robot?.about.meshes.pieces?.length === 40);
});

inPage(
  set,
  "hostile drops: said in words, and the page goes on",
  async (page) => {
    const { folder } = set.made;
    const said = async (pattern, ...paths) => {
      await page.waitForSelector(".card:visible");
      await dropOn(page, ...paths);
      await page.waitForSelector(".failure:not([hidden])");
      await soon(async () => assert.match(await page.locator(".failure p").first().textContent(), pattern), 60);
      await page.getByRole("button", { name: "Back" }).click();
    };
    const bomb = join(folder, "bomb.zip");
    const script = `import sys, zipfile
with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as zip:
    zip.writestr("a.urdf", "<robot name='a'><link name='a'/></robot>")
    with zip.open("b.stl", "w") as file:
        for _ in range(600): file.write(bytes(1 << 20))`;
    assert.equal(spawnSync("python3", ["-c", script, bomb]).status, 0);
    await said(/bytes (?:in total|long); the limit/, bomb);
    writeFileSync(
      join(folder, "cut.zip"),
      Buffer.concat([readFileSync(bomb).subarray(0, 5000), Buffer.from("a.urdf")]),
    );
    await said(/zip|no robot/i, join(folder, "cut.zip"));
    const markup = join(folder, "<img src=x onerror=alert(1)>.urdf");
    writeFileSync(markup, `<robot name="&lt;b&gt;bold"><link name="&lt;script&gt;"/></robot>`);
    await dropOn(page, markup);
    // The name of a robot is one that a folder can have; those of its links are as they are.
    await drawn(page, "_img src=x onerror=alert(1)_");
    assert.equal(await page.locator("img[src=x], b").count(), 0);
    await page.getByRole("button", { name: "All robots" }).click();
    const many = join(folder, "many.urdf");
    const link = (k) =>
      `<link name="l${k}"><visual><geometry><mesh filename="package://p${k}/a.stl"/></geometry></visual></link>`;
    const joint = (k) => `<joint name="j${k}" type="fixed"><parent link="l0"/><child link="l${k}"/></joint>`;
    const all = Array.from({ length: 2000 }, (_, k) => link(k) + (k > 0 ? joint(k) : ""));
    writeFileSync(many, `<robot name="many">${all.join("")}</robot>`);
    await page.waitForSelector(".card:visible");
    await dropOn(page, many);
    await state(page, "report", (value) => value.report !== null);
    assert.equal(await page.evaluate(() => 1 + 1), 2);
  },
  { faults: [] },
);

inPage(set, "a link opens a description beside the page, and nothing else", async (page) => {
  const { site, address } = set.server;
  mkdirSync(join(site, "examples"), { recursive: true });
  cpSync(join(robots, "hand.urdf"), join(site, "examples/hand.urdf"));
  await page.goto(`${address}#from=examples/hand.urdf`);
  await state(page, "robot", (robot) => robot?.entry.name === "hand");
  // By the endings of the program, in any case.
  for (const name of ["HAND.URDF", "hand.world"]) {
    cpSync(join(robots, "hand.urdf"), join(site, "examples", name));
    await page.goto("about:blank");
    await page.goto(`${address}#from=examples/${name}`);
    await state(page, "robot", (robot) => robot?.entry.name.toLowerCase() === "hand");
  }
  for (const elsewhere of [
    "//example.org/a.urdf",
    "https://example.org/a.urdf",
    "../../a.urdf",
    "a/../../b.urdf",
    "robots.json",
  ]) {
    await page.goto("about:blank");
    await page.goto(`${address}#from=${encodeURIComponent(elsewhere)}`);
    await page.waitForSelector(".card:visible");
    assert.equal(await page.evaluate(() => globalThis.urdd.app.store.now.draft), null, elsewhere);
  }
});
