// What nobody wants and everybody has: huge, broken, odd and missing inputs.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { closeSync, cpSync, ftruncateSync, mkdirSync, openSync, readdirSync, renameSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { join } from "node:path";
import { test } from "node:test";
import { drawn, dropOn, inPage, open, program, run, setting, state, view } from "./world.mjs";

const ODD = `"><script>window.harmed = true</script><img src=x onerror="window.harmed = true">`;
const BIDI = "arm\u202Egpj.exe";

function escaped(text) {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

function link(name) {
  return `<link name="${escaped(name)}"/>`;
}

function joint(name, parent, child) {
  return `<joint name="${escaped(name)}" type="revolute"><parent link="${escaped(parent)}"/><child link="${escaped(child)}"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>`;
}

function generate(made, name, text, ...words) {
  const urdf = join(made.folder, `${name}.urdf`);
  writeFileSync(urdf, text);
  const done = run("generate", urdf, "-o", join(made.robots, name), ...words);
  assert.equal(done.status, 0, done.stderr);
}

/** A square of so many triangles as binary glTF. */
function large(triangles) {
  const side = Math.ceil(Math.sqrt(triangles / 2));
  const positions = new Float32Array(3 * (side + 1) ** 2);
  for (let y = 0, k = 0; y <= side; y++)
    for (let x = 0; x <= side; x++) positions.set([x / side, y / side, 0.01 * Math.sin(x) * Math.cos(y)], 3 * k++);
  const indices = new Uint32Array(6 * side * side);
  for (let y = 0, k = 0; y < side; y++)
    for (let x = 0; x < side; x++, k += 6) {
      const a = y * (side + 1) + x;
      indices.set([a, a + 1, a + side + 2, a, a + side + 2, a + side + 1], k);
    }
  const json = JSON.stringify({
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      {
        bufferView: 0,
        componentType: 5126,
        count: positions.length / 3,
        type: "VEC3",
        min: [0, 0, -0.01],
        max: [1, 1, 0.01],
      },
      { bufferView: 1, componentType: 5125, count: indices.length, type: "SCALAR" },
    ],
    bufferViews: [
      { buffer: 0, byteLength: positions.byteLength },
      { buffer: 0, byteOffset: positions.byteLength, byteLength: indices.byteLength },
    ],
    buffers: [{ byteLength: positions.byteLength + indices.byteLength }],
  });
  const text = Buffer.from(json.padEnd(Math.ceil(json.length / 4) * 4));
  const head = (length, type) => Buffer.from(new Uint32Array([length, type]).buffer);
  const body = Buffer.concat([Buffer.from(positions.buffer), Buffer.from(indices.buffer)]);
  const parts = [head(text.length, 0x4e4f534a), text, head(body.length, 0x004e4942), body];
  const total = 12 + parts.reduce((sum, part) => sum + part.length, 0);
  return [Buffer.concat([Buffer.from(new Uint32Array([0x46546c67, 2, total]).buffer), ...parts]), 2 * side * side];
}

/** An empty file of this size that takes no room on the disk. */
function hollow(path, size) {
  const file = openSync(path, "w");
  ftruncateSync(file, size);
  closeSync(file);
}

const set = setting(["welding_arm", "gripper"], (made) => {
  const many = Array.from({ length: 2000 }, (_, k) => `link_${k}`);
  const chain = many.map((name, k) => link(name) + (k > 0 ? joint(`joint_${k}`, many[k - 1], name) : ""));
  generate(made, "many", `<robot name="many">${chain.join("")}</robot>`, "--modules", "core");
  const names = [ODD, BIDI, "it's `quoted` \u2069"];
  const odd = names.map((name, k) => link(name) + (k > 0 ? joint(`${name} joint`, names[k - 1], name) : ""));
  generate(made, "odd", `<robot name="${escaped(ODD)}">${odd.join("")}</robot>`, "--modules", "core");
  const heavy = join(made.robots, "heavy");
  cpSync(join(made.robots, "gripper"), heavy, { recursive: true });
  const [mesh, triangles] = large(2_000_000);
  made.triangles = triangles;
  const meshes = join(heavy, "mesh_modules/plain_meshes_module/meshes/glb");
  writeFileSync(join(meshes, readdirSync(meshes)[0]), mesh);
  return view(made.robots);
});

inPage(set, "2,000 links: the tree, sliders and the picture", async (page) => {
  await open(page, "many");
  assert.equal(await page.locator(".row").count(), 2000);
  await page.locator("#find").fill("link_1999");
  assert.equal(await page.locator(".row:visible").count(), 1);
  await page.keyboard.press("Enter");
  assert.deepEqual(await state(page, "selected"), { kind: "link", index: 1999 });
  const { poses } = await page.evaluate(() => globalThis.urdd.app.store.now);
  await page.getByRole("button", { name: "Random", exact: true }).click();
  await state(page, "q", (q) => q.some((value) => value !== 0));
  assert.equal(Object.keys(poses).length, 7 * 2000);
});

inPage(set, "a mesh of two million triangles", async (page) => {
  await open(page, "heavy");
  const drawn = await page.evaluate(() =>
    globalThis.urdd.stage.scene
      .meshes()
      .reduce((sum, { geometry }) => sum + (geometry.index ?? geometry.attributes.position).count / 3, 0),
  );
  assert.ok(drawn >= set.made.triangles && set.made.triangles >= 2_000_000, `${drawn}`);
});

inPage(set, "names with scripts, quotes and marks that turn text are text", async (page) => {
  await open(page, "odd");
  const shown = await page.locator(".row .name").allTextContents();
  assert.deepEqual(shown, [ODD, "arm\\u{202e}gpj.exe", "it's `quoted` \\u{2069}"]);
  for (const name of ["Joints", "Shapes", "Findings", "Info"]) await page.click(`#tab-${name}`);
  await page.locator(".row").first().click();
  await page.waitForTimeout(200);
  assert.equal(await page.evaluate(() => globalThis.harmed), undefined);
  assert.equal(await page.locator("script:not([src])").count(), 0);
});

inPage(set, "a folder that is dropped is validated in the browser, with the program's findings", async (page) => {
  await page.waitForSelector(".card");
  const target = join(set.made.robots, "gripper");
  await dropOn(page, target);
  await drawn(page, "gripper");
  assert.equal((await state(page, "robot")).source.kind, "local");
  await page.click("#tab-Findings");
  const { report } = await state(page, "report", (value) => value.report !== null);
  assert.deepEqual(report, JSON.parse(run("validate", target, "--format", "json").stdout));
});

inPage(set, "a .zip that is dropped is validated in the browser, with the program's findings", async (page) => {
  const target = join(set.made.robots, "gripper");
  const script = "import shutil, sys; shutil.make_archive(sys.argv[1], 'zip', sys.argv[2], 'gripper')";
  const zip = join(set.made.folder, "packed");
  assert.equal(spawnSync("python3", ["-c", script, zip, set.made.robots]).status, 0);
  await page.waitForSelector(".card");
  await dropOn(page, `${zip}.zip`);
  await drawn(page, "packed");
  await page.click("#tab-Findings");
  const { report } = await state(page, "report", (value) => value.report !== null);
  const native = JSON.parse(run("validate", target, "--format", "json").stdout);
  assert.deepEqual(report.urdds[0].findings, native.urdds[0].findings);
  assert.equal(report.urdds[0].verdict, "pass");
});

inPage(set, "a folder without a robot and one of a gigabyte are told what to do", async (page) => {
  const { folder } = set.made;
  const said = async (pattern, ...files) => {
    await page.waitForSelector(".card");
    await dropOn(page, ...files);
    await page.waitForSelector(".failure:not([hidden])");
    assert.match(await page.locator(".failure p").first().textContent(), pattern);
    await page.getByRole("button", { name: "Back" }).click();
  };
  const empty = join(folder, "photos");
  mkdirSync(empty);
  writeFileSync(join(empty, "a.txt"), "a");
  await said(/This is no robot/, empty);
  cpSync(join(set.made.robots, "gripper"), join(folder, "vast"), { recursive: true });
  hollow(join(folder, "vast/film.bin"), 1_100_000_000);
  await said(/more than 1 GB/, join(folder, "vast"));
  hollow(join(folder, "vast.zip"), 1_100_000_000);
  await said(/more than 1 GB/, join(folder, "vast.zip"));
});

inPage(
  set,
  "without WebGL a sentence says so, and the panels work",
  async (page) => {
    await page
      .getByRole("button", { name: /gripper/ })
      .first()
      .click();
    await state(page, "robot");
    await page.getByText(/Cannot draw the robot: this browser has no WebGL/).waitFor();
    await page.getByRole("button", { name: "Middle" }).click();
    await state(page, "q", (q) => q.some((value) => value !== 0));
    await page.click("#tab-Proximity");
    const { answer } = await state(page, "proximity", (value) => value.answer !== null);
    assert.ok(answer.pairs > 0);
    await page.click("#tab-Findings");
    assert.equal((await state(page, "report", (value) => value.report !== null)).report.urdds[0].verdict, "pass");
  },
  {
    first: [
      () => {
        const { prototype } = globalThis.HTMLCanvasElement;
        const original = prototype.getContext;
        prototype.getContext = function (kind, ...rest) {
          return kind.startsWith("webgl") ? null : original.call(this, kind, ...rest);
        };
      },
    ],
  },
);

/** The worker, in which a function of the module traps. */
function trapping(name, times) {
  return async (route) => {
    const response = await route.fetch();
    const script = `
      const real = WebAssembly.instantiate;
      let left = ${times};
      WebAssembly.instantiate = async (...words) => {
        const instance = await real(...words);
        const exports = { ...instance.exports, ${name}(...values) {
          if (left-- > 0) throw new WebAssembly.RuntimeError("unreachable");
          return instance.exports.${name}(...values);
        } };
        return { exports };
      };\n`;
    await route.fulfill({ response, body: script + (await response.text()) });
  };
}

inPage(
  set,
  "a trap while validating: not fully examined, and the robot still moves",
  async (page) => {
    await page.waitForSelector(".card");
    await dropOn(page, join(set.made.robots, "gripper"));
    await drawn(page, "gripper");
    await page.click("#tab-Findings");
    const { error } = await state(page, "report", (value) => value.error !== null);
    assert.match(error, /not fully examined.*engine stopped/);
    await page.getByText(/cannot be validated/).waitFor();
    await page.click("#tab-Joints");
    await page.evaluate(() => {
      globalThis.before = globalThis.urdd.app.store.now.poses;
    });
    await page.getByRole("button", { name: "Random", exact: true }).click();
    await page.waitForFunction(() => globalThis.urdd.app.store.now.poses !== globalThis.before);
  },
  { routes: [["**/worker.js", trapping("urdd_validate", 1)]] },
);

inPage(
  set,
  "a trap of the engine: it is started again with the robot that was open",
  async (page) => {
    await open(page, "gripper");
    const ask = (call, question) =>
      page.evaluate(
        ([call, question]) =>
          globalThis.urdd.app.engine.ask(call, question).then(
            (answer) => answer.length,
            (error) => error.message,
          ),
        [call, question],
      );
    const { links, about } = await state(page, "robot");
    assert.match(String(await ask("explain", { code: "DOF003" })), /engine stopped/);
    assert.equal(await ask("linkPoses", { q: about.zero }), 7 * links.length);
  },
  { routes: [["**/worker.js", trapping("urdd_explain", 1)]] },
);

inPage(
  set,
  "files that vanish while the robot is open",
  async (page) => {
    const target = join(set.made.robots, "welding_arm");
    await open(page, "welding_arm");
    // At once: a folder that is half gone is another robot, which the page would follow.
    renameSync(target, join(set.made.folder, "away"));
    await page.getByText("The files of this robot are gone").waitFor();
    await page.getByRole("button", { name: "Middle" }).click();
    await state(page, "q", (q) => q.some((value) => value !== 0));
    await page.click("#tab-Shapes");
    // Not the pieces: whether the robot collides is always shown, so they may be there already.
    await page.check("#layer-hulls");
    await page.locator(".layer .fault:visible").first().waitFor();
  },
  { faults: null },
);

test("a port that is taken, and no browser", async () => {
  const taken = createServer();
  await new Promise((resolve) => taken.listen(0, "127.0.0.1", resolve));
  const { port } = taken.address();
  const done = run("view", "--no-open", "--port", String(port), join(set.made.robots, "gripper"));
  assert.equal(done.status, 2);
  assert.match(done.stderr, new RegExp(`port ${port} .*--port`));
  taken.close();
  // Without --no-open, and with nothing that could open a page.
  const server = await view(join(set.made.robots, "gripper"), {
    opens: true,
    env: { PATH: "/nonexistent", HOME: "/" },
  });
  await server.said(/no browser could be opened/);
  assert.equal((await fetch(new URL("/", server.address))).status, 200);
  server.end();
  assert.ok(program);
});
