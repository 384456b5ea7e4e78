// What is dropped on a page without a program: archives of every program, files by themselves, what is no robot, large things.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdirSync, readdirSync, truncateSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { exported } from "./exported.mjs";
import { answered, drawn, dropOn, inPage, namesOf, open, press, repository, setting, soon, state } from "./world.mjs";

const set = setting(["single_link", "gripper"], exported);
const archives = join(repository, "testkit/archives");
const STL =
  "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendloop\nendfacet\nendsolid a\n";

let folders = 0;
/** A new folder with these files, by path. */
function folder(files) {
  const made = join(set.made.folder, `drop-${++folders}`);
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(join(made, path, ".."), { recursive: true });
    writeFileSync(join(made, path), text);
  }
  return (path = "") => join(made, path);
}

/** Packs a folder, under its own name. */
function pack(place, zip, name) {
  const script = "import shutil, sys; shutil.make_archive(sys.argv[1], 'zip', sys.argv[2], sys.argv[3])";
  const done = spawnSync("python3", ["-c", script, place(zip).slice(0, -4), place(), name], { encoding: "utf8" });
  assert.equal(done.status, 0, done.stderr);
}

const mesh = (name) => `<visual><geometry><mesh filename="${name}"/></geometry></visual>`;
const box = (size) => `<visual><geometry><box size="${size} ${size} ${size}"/></geometry></visual>`;

function urdf(name, ...visuals) {
  const links = visuals.map((visual, k) => `<link name="l${k}">${visual}</link>`);
  const joints = visuals.slice(1).map(
    (_, k) =>
      `<joint name="j${k}" type="revolute"><parent link="l0"/><child link="l${k + 1}"/><axis xyz="0 0 1"/>
       <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>`,
  );
  return `<robot name="${name}">${links.join("")}${joints.join("")}</robot>`;
}

/** Waits until a robot is made whole and drawn that is not the one of this id. */
async function whole(page, name, before = null) {
  await state(page, "robot", (robot) => robot?.entry.name === name && robot.entry.id !== before && robot.entry.ready);
  await state(page, "making", ({ making }) => making === null);
  await soon(async () => {
    const is = await page.evaluate(() => globalThis.urdd.app.store.now.robot?.entry.making === null);
    assert.ok(is, "it is made");
  });
  await drawn(page, name);
  return (await state(page, "robot")).entry.id;
}

/** The number of colours of an image. */
async function colours(image) {
  await image.decode();
  const context = new globalThis.OffscreenCanvas(image.naturalWidth, image.naturalHeight).getContext("2d");
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, image.naturalWidth, image.naturalHeight);
  return new Set(new Uint32Array(data.buffer)).size;
}

const gallery = (page) => page.waitForSelector(".gallery:not([hidden])");
const now = (page, key) => page.evaluate((key) => globalThis.urdd.app.store.now[key], key);

inPage(set, "archives of every program become the robot, with its meshes", async (page) => {
  await gallery(page);
  let id = null;
  const all = readdirSync(archives).filter((name) => name.endsWith(".zip"));
  assert.equal(all.length, 10);
  for (const name of all) {
    await dropOn(page, join(archives, name));
    id = await whole(page, "arm", id);
    assert.deepEqual(await now(page, "absent"), [], name);
    const { about } = await state(page, "robot");
    assert.ok(
      about.meshes.plain.every((meshes) => meshes.length === 1),
      name,
    );
  }
});

inPage(
  set,
  "links of an archive to one file are bounded",
  async (page) => {
    await gallery(page);
    const zip = join(folder({ "a.urdf": "" })(), "links.zip");
    const script = `import sys, zipfile
with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as zip:
    zip.writestr("a.urdf", "<robot name='a'><link name='a'/></robot>")
    zip.writestr("big.stl", bytes(30_000_000))
    for k in range(40):
        link = zipfile.ZipInfo(f"m{k}.stl")
        link.create_system, link.external_attr = 3, 0o120777 << 16
        zip.writestr(link, "big.stl")`;
    assert.equal(spawnSync("python3", ["-c", script, zip]).status, 0);
    await dropOn(page, zip);
    const failure = await state(page, "failure");
    assert.match(failure, /more than 1 GB/);
  },
  { faults: null },
);

/** Whether the camera shows all of the robot, as large as it can, on a ground of its size. */
async function isFramed(page) {
  await soon(async () => {
    const found = await page.evaluate(() => {
      const { scene, view, ground } = globalThis.urdd.stage;
      const bounds = scene.bounds();
      const size = bounds.max.clone().sub(bounds.min);
      const radius = size.length() / 2;
      const away = view.camera.position.distanceTo(bounds.max.clone().add(bounds.min).multiplyScalar(0.5));
      const largest = Math.max(size.x, size.y, size.z);
      return { away: away / radius, step: ground.step / largest, far: view.camera.far / radius };
    });
    assert.ok(found.away > 1.5 && found.away < 8, `the camera is ${found.away} radii away`);
    assert.ok(found.step > 0.05 && found.step < 0.5, `a square of the ground is ${found.step} of the robot`);
    assert.ok(found.far > 10, "it is not cut off");
  }, 5);
}

for (const pause of [0, 60, 700])
  inPage(
    set,
    `the camera and the ground are right for robots of every size, with pauses of ${pause} ms`,
    async (page) => {
      await gallery(page);
      // The engine answers about pictures late, so that a further stage of the robot comes before, meanwhile or after.
      await page.evaluate((pause) => {
        const { engine } = globalThis.urdd.app;
        const ask = engine.ask.bind(engine);
        engine.ask = async (call, ...rest) => {
          if (pause > 0 && ["file", "sources", "meshes"].includes(call))
            await new Promise((resolve) => setTimeout(resolve, pause));
          return ask(call, ...rest);
        };
      }, pause);
      let id = null;
      for (const [name, size] of Object.entries({ building: 120, tiny: 0.003, table: 1, house: 12 })) {
        const place = folder({ [`${name}.urdf`]: urdf(name, box(size), box(size / 2)) });
        await dropOn(page, place(`${name}.urdf`));
        id = await whole(page, name, id);
        await isFramed(page);
      }
    },
  );

inPage(set, "the camera follows a robot whose meshes come later", async (page) => {
  await gallery(page);
  const place = folder({ "late.urdf": urdf("late", mesh("hall.stl")), "hall.stl": STL.replaceAll("1 ", "90 ") });
  await dropOn(page, place("late.urdf"));
  await whole(page, "late");
  await dropOn(page, place("hall.stl"));
  await state(page, "absent", (absent) => absent.length === 0);
  await whole(page, "late");
  await isFramed(page);
});

const MJCF = `<mujoco model="one"><compiler meshdir="meshes"/><asset><mesh name="m" file="m.stl"/></asset>
<worldbody><body name="b"><joint type="hinge" axis="0 0 1"/><inertial mass="1" pos="0 0 0" diaginertia="1 1 1"/>
<geom type="mesh" mesh="m"/></body></worldbody></mujoco>`;
const SDF = `<sdf version="1.9"><model name="one"><link name="b"><visual name="v"><geometry><mesh><uri>model://one/meshes/m.stl</uri>
</mesh></geometry></visual></link></model></sdf>`;

for (const [format, file, text] of [
  ["MJCF", "one.xml", MJCF],
  ["SDF", "one.sdf", SDF],
])
  for (const [how, dropped] of [
    ["by itself", (place) => place("meshes/m.stl")],
    ["in its folder", (place) => place("meshes")],
    ["in a folder of another name", (place) => place("elsewhere")],
    ["in a .zip", (place) => place("meshes.zip")],
  ])
    inPage(set, `an ${format} without its mesh asks for it, and takes it ${how}`, async (page) => {
      await gallery(page);
      const place = folder({ [file]: text, "meshes/m.stl": TETRAHEDRON, "elsewhere/deep/m.stl": TETRAHEDRON });
      pack(place, "meshes.zip", "meshes");
      await dropOn(page, place(file));
      const ask = page.locator(".wanted:visible");
      await ask.getByText(format === "SDF" ? /Drop the folder of one here/ : /m\.stl/).waitFor();
      await dropOn(page, dropped(place));
      await state(page, "wanted", (wanted) => wanted.length === 0);
      await whole(page, "one");
      await soon(async () => {
        const { about } = await state(page, "robot");
        assert.ok(about.meshes.plain.some((meshes) => meshes.length > 0));
      });
      assert.equal(await ask.count(), 0);
    });

const TETRAHEDRON = `solid t
${["0 0 0|0 1 0|1 0 0", "0 0 0|1 0 0|0 0 1", "0 0 0|0 0 1|0 1 0", "1 0 0|0 1 0|0 0 1"]
  .map(
    (corners) =>
      `facet normal 0 0 0\nouter loop\n${corners
        .split("|")
        .map((at) => `vertex ${at}\n`)
        .join("")}endloop\nendfacet`,
  )
  .join("\n")}
endsolid t
`;

inPage(set, "a description is one by any name", async (page) => {
  await gallery(page);
  const text = urdf("arm", box(1), box(0.5));
  let id = null;
  for (const name of ["arm.xml", "arm.txt", "arm.sdf", "arm.usda", "arm.zip", "arm"]) {
    await dropOn(page, folder({ [name]: text })(name));
    // An ending that no description has is a part of the name.
    id = await whole(page, name === "arm.txt" ? name : "arm", id);
  }
  await dropOn(page, folder({ "m.stl": TETRAHEDRON, "box.urdf": MJCF })("box.urdf"));
  await page
    .getByText(/m\.stl` was not found/)
    .first()
    .waitFor();
});

inPage(set, "what a stage did not change stays where it is", async (page) => {
  await gallery(page);
  await page.evaluate(() => {
    const { store } = globalThis.urdd.app;
    globalThis.stages = [];
    store.on(["robot"], ({ robot }) => {
      if (robot?.source.kind === "local") globalThis.stages.push(robot.source.files);
    });
  });
  const place = folder({ "robot.urdf": urdf("robot", mesh("m.stl"), box(1)), "m.stl": TETRAHEDRON });
  await dropOn(page, place("robot.urdf"), place("m.stl"));
  await whole(page, "robot");
  const found = await page.evaluate(() => {
    const [first, last] = [globalThis.stages[0], globalThis.stages.at(-1)];
    const of = new Map(first.map(({ path, file }) => [path, file]));
    const same = last.filter(({ path, file }) => of.get(path) === file).map(({ path }) => path);
    return { stages: globalThis.stages.length, first: first.length, last: last.length, same };
  });
  assert.ok(found.stages > 1 && found.last > found.first, JSON.stringify(found));
  assert.ok(found.same.includes("robot.urdf"), JSON.stringify(found));
  assert.ok(
    found.same.some((path) => path.includes("plain_meshes_module/meshes/")),
    JSON.stringify(found),
  );
});

inPage(set, "an MJCF without the file that it includes takes that", async (page) => {
  await gallery(page);
  const scene = '<mujoco model="scene"><include file="parts/body.xml"/></mujoco>';
  const place = folder({ "scene.xml": scene, "body.xml": MJCF, "m.stl": TETRAHEDRON });
  await dropOn(page, place("scene.xml"));
  await page.locator(".wanted:visible").getByText("body.xml").waitFor();
  await dropOn(page, place("body.xml"));
  await page
    .getByText(/m\.stl` was not found/)
    .first()
    .waitFor();
  await dropOn(page, place("m.stl"));
  await whole(page, "scene");
});

inPage(set, "files that are dropped by themselves find their places, whatever the names", async (page) => {
  await gallery(page);
  const names = [
    "package://my_robot_description/meshes/Base.stl",
    "../meshes/visual/arm.stl",
    "file:///home/someone/ws/src/my_robot_description/meshes/hand.stl",
    "/opt/robot/meshes/tool.stl",
    "package://other_package/finger.stl",
  ];
  const parts = names.map((name) => name.split("/").pop());
  const place = folder({
    "robot.urdf": urdf("robot", ...names.map(mesh)),
    ...Object.fromEntries(parts.map((part) => [part, STL])),
    ...Object.fromEntries(parts.slice(0, 3).map((part) => [`my_robot_description/meshes/${part}`, STL])),
  });
  await dropOn(page, place("robot.urdf"), ...parts.map(place));
  const id = await whole(page, "robot");
  assert.deepEqual(await now(page, "absent"), []);
  // At first the URDF alone, then one after the other.
  await dropOn(page, place("robot.urdf"));
  await whole(page, "robot", id);
  await state(page, "absent", (absent) => absent.length === names.length);
  for (let k = 0; k < parts.length; k++) {
    await dropOn(page, place(parts[k]));
    await state(page, "absent", (absent) => absent.length === names.length - k - 1);
    await whole(page, "robot");
  }
});

inPage(set, "what the program does not find in a folder, the page does not find either", async (page) => {
  await gallery(page);
  const place = folder({
    "arm/urdf/arm.urdf": urdf("arm", mesh("meshes/base.stl"), mesh("file:///home/me/arm/meshes/base.stl")),
    "arm/meshes/base.stl": STL,
  });
  await dropOn(page, place("arm"));
  await whole(page, "arm");
  const absent = await state(page, "absent", (absent) => absent.length > 0);
  assert.deepEqual(
    absent.map(({ filename }) => filename),
    ["meshes/base.stl"],
  );
});

inPage(set, "of a folder above 64 MB, each file is found that is there", async (page) => {
  await gallery(page);
  const place = folder({
    "urdf/arm.urdf": urdf(
      "arm",
      mesh("../meshes/a&amp;b.stl"),
      mesh("../meshes/b%20c.stl"),
      mesh("../meshes/sub/../d.stl"),
    ),
    "meshes/a&b.stl": STL,
    "meshes/b c.stl": STL,
    "meshes/d.stl": STL,
    "meshes/other.stl": "",
  });
  truncateSync(place("meshes/other.stl"), 70 * 2 ** 20);
  await dropOn(page, place());
  await whole(page, "arm");
  assert.deepEqual(await now(page, "absent"), []);
});

inPage(set, "Back leads to the gallery and Forward to the robot, and leaving asks", async (page) => {
  await gallery(page);
  const asks = () => page.evaluate(() => !window.dispatchEvent(new window.Event("beforeunload", { cancelable: true })));
  assert.equal(await asks(), false);
  const place = folder({ "one.urdf": urdf("one", box(1), box(2)), "two.urdf": urdf("two", box(1)) });
  await dropOn(page, place("one.urdf"));
  await whole(page, "one");
  assert.equal(await asks(), true);
  await dropOn(page, place("two.urdf"));
  await whole(page, "two");
  await page.goBack();
  await whole(page, "one");
  await page.goBack();
  await gallery(page);
  const cards = await page.locator(".card:visible strong").allTextContents();
  assert.deepEqual(cards.slice().sort(), ["gripper", "one", "single_link", "two"]);
  // What was drawn is on its card: more than the colour of the ground.
  for (const name of ["one", "two"]) {
    const image = page.locator(".card", { has: page.locator(`strong:text-is("${name}")`) }).locator("img");
    assert.ok((await image.evaluate(colours)) > 20, name);
  }
  await page.goForward();
  await whole(page, "one");
  const text = urdf("one", box(1), box(2), box(3));
  await page.evaluate((text) => globalThis.urdd.app.site.here.edit(text), text);
  await state(page, "robot", (robot) => robot?.links.length === 3);
  await page.goBack();
  await gallery(page);
  await open(page, "one");
  assert.equal((await state(page, "draft")).text, text, "an edit outlives the way to the gallery");
});

inPage(set, "a card is removed with its robot, and robots before the last one give their memory back", async (page) => {
  await gallery(page);
  const names = ["a", "b", "c", "d"];
  const place = folder(Object.fromEntries(names.map((name) => [`${name}.urdf`, urdf(name, box(1), box(2))])));
  for (const name of names) {
    await dropOn(page, place(`${name}.urdf`));
    await whole(page, name);
  }
  await page.getByRole("button", { name: "All robots" }).click();
  await gallery(page);
  const ready = async () =>
    (await now(page, "entries")).filter(({ here, ready }) => here && ready).map(({ name }) => name);
  assert.deepEqual(await ready(), ["d"]);
  await soon(async () => assert.ok(page.workers().length <= 1, `${page.workers().length} workers`));
  await page.getByRole("button", { name: "Remove b" }).click();
  await soon(async () => assert.equal(await page.getByRole("button", { name: /^b/ }).count(), 0));
  await open(page, "a");
  await whole(page, "a");
});

inPage(
  set,
  "a name of 20 MB does not hold the page up, and Cancel ends what runs",
  async (page) => {
    await gallery(page);
    const place = folder({ "long.urdf": urdf("long", box(1), box(1)).replaceAll("l1", "x".repeat(20e6)) });
    await page.evaluate(() => {
      let last = performance.now();
      globalThis.longest = 0;
      globalThis.setInterval(() => {
        const now = performance.now();
        globalThis.longest = Math.max(globalThis.longest, now - last);
        last = now;
      }, 20);
    });
    await dropOn(page, place("long.urdf"));
    await state(page, "draft");
    const cancel = page.getByRole("button", { name: "Cancel" });
    // If it is not there any more, the robot is.
    await cancel.click({ timeout: 3000 }).catch(() => undefined);
    await page.waitForTimeout(20_000);
    const longest = await page.evaluate(() => globalThis.longest);
    assert.ok(longest < 5000, `the page stood still for ${longest} ms`);
  },
  { faults: null },
);

inPage(set, "Cancel ends the reading of a drop, and what was open stays", async (page) => {
  await gallery(page);
  const place = folder({ "one.urdf": urdf("one", box(1), box(2)), "big/a.urdf": urdf("big", box(1)) });
  await dropOn(page, place("one.urdf"));
  await whole(page, "one");
  // A worker that never answers.
  await page.evaluate(() => {
    globalThis.urdd.app.engine.apart = () => new Promise(() => undefined);
  });
  pack(place, "big.zip", "big");
  await dropOn(page, place("big.zip"));
  await page.getByRole("button", { name: "Cancel" }).click();
  await soon(async () => assert.equal(await page.locator(".waiting").isVisible(), false));
  assert.equal((await state(page, "robot")).entry.name, "one");
});

inPage(set, "Cancel ends the making of a robot, which stays in the gallery", async (page) => {
  await gallery(page);
  const place = folder({ "slow.urdf": urdf("slow", box(1), box(2)) });
  // It never gets further.
  await page.evaluate(() => {
    const { site } = globalThis.urdd.app;
    const making = { what: "meshes", done: 1, of: 2 };
    site.revision = async (entry) => ({ revision: null, entry: { ...entry, ready: false, making } });
  });
  await dropOn(page, place("slow.urdf"));
  await page.locator(".waiting").getByText("Generating slow: meshes, 1 of 2").waitFor();
  await page.getByRole("button", { name: "Cancel" }).click();
  await gallery(page);
  assert.equal(await page.getByRole("button", { name: /^slow/ }).count(), 1);
});

inPage(set, "no green word about nothing", async (page) => {
  await open(page, "single_link");
  const { answer } = await state(page, "proximity", (value) => value.answer !== null);
  assert.equal(answer.pairs, 0);
  await page.getByText("no pair to check for collisions").first().waitFor();
  for (const tab of ["Joints", "Proximity"]) {
    await page.click(`#tab-${tab}`);
    assert.equal(await page.locator(":is(.verdict-now, .chip, .collision).good:visible").count(), 0, tab);
  }
});

inPage(
  set,
  "what is no robot closes none, and no edit is lost",
  async (page) => {
    await gallery(page);
    const place = folder({
      "one.urdf": urdf("one", box(1), box(2)),
      "notes.txt": "nothing",
      "folder/readme.md": "nothing",
      "folder/data.json": "{}",
      "broken.zip": "PK\u0003\u0004 and so on",
      "sheet.xml": "<sheet/>",
      "urdd.json": "{}",
      "extra.stl": STL,
    });
    pack(place, "none.zip", "folder");
    await dropOn(page, place("one.urdf"));
    await whole(page, "one");
    const text = urdf("one", box(1), box(2), box(3));
    await page.evaluate((text) => globalThis.urdd.app.site.here.edit(text), text);
    await state(page, "robot", (robot) => robot?.links.length === 3);
    await whole(page, "one");
    for (const name of ["notes.txt", "folder", "broken.zip", "none.zip", "sheet.xml", "urdd.json", "extra.stl"]) {
      await page.evaluate(() => globalThis.urdd.app.store.set({ note: null }));
      await dropOn(page, place(name));
      await state(page, "note", (note) => note !== null);
      await whole(page, "one");
      assert.equal((await state(page, "draft")).text, text, name);
      assert.equal((await state(page, "robot")).links.length, 3, name);
      assert.equal(await page.locator(".failure:visible").count(), 0, name);
    }
    // Neither does it close a URDD.
    await page.getByRole("button", { name: "All robots" }).click();
    await open(page, "gripper");
    await dropOn(page, place("notes.txt"));
    await state(page, "note", (note) => /no robot/.test(note ?? ""));
    assert.equal((await state(page, "robot")).entry.name, "gripper");
  },
  { faults: null },
);

/** What somebody who got into a worker would try: how much of it ran. */
const INTRUDER = `
;(async () => {
  let ran = 0;
  for (const act of [() => self.eval("1"), () => new Function("return 1")(), () => importScripts("data:text/javascript,1")])
    try { act(); ran++; } catch {}
  await fetch("https://example.org/").then(() => ran++, () => undefined);
  console.info(self.name + "intruder: " + ran);
})();`;

inPage(
  set,
  "a worker runs no text as code, and asks no other host",
  async (page) => {
    const said = [];
    page.on("console", (message) => said.push(message.text()));
    await gallery(page);
    const place = folder({ "one.urdf": urdf("one", box(1), box(2)) });
    await dropOn(page, place("one.urdf"));
    await whole(page, "one");
    const ran = said.filter((text) => text.includes("intruder:"));
    assert.ok(ran.length >= 2, "in the engine, and in who makes robots");
    assert.deepEqual(
      ran.filter((text) => !text.endsWith("intruder: 0")),
      [],
    );
  },
  {
    faults: null,
    routes: [
      [
        /\.js$/,
        async (route) => {
          const names = namesOf(await (await fetch(set.server.address)).text());
          const name = names.get(new URL(route.request().url()).pathname);
          if (!["worker.js", "make.js"].includes(name)) return route.fallback();
          const text = (await answered(route, name)).toString();
          return route.fulfill({ body: text + INTRUDER, contentType: "text/javascript" });
        },
      ],
    ],
  },
);

inPage(set, "Stop says nothing in red, and the gallery has nothing of the robot before", async (page) => {
  await gallery(page);
  const place = folder({
    "long.urdf": urdf(
      "long",
      ...Array.from({ length: 40 }, (_, k) => mesh("ball.stl").replace("/>", ` scale="${1 + k / 99} 1 1"/>`)),
    ),
  });
  cpSync(join(repository, "conformance/robots/meshes/welding_arm/forearm.stl"), place("ball.stl"));
  await dropOn(page, place("long.urdf"), place("ball.stl"));
  await drawn(page, "long", { isPartial: true });
  await press(page, "Stop");
  await state(page, "making", ({ making, stopped }) => making === null && stopped);
  assert.equal(await page.locator(".broken:visible").count(), 0);
  await state(page, "proximity", ({ error }) => /Generate the rest/.test(error ?? ""));
  await page.getByRole("button", { name: "All robots" }).click();
  await gallery(page);
  assert.deepEqual(await page.locator(".bar .chip:visible").allTextContents(), []);
  // The second stop of the Tab key is in the gallery.
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  assert.notEqual(await page.evaluate(() => document.activeElement.id), "picture");
});
