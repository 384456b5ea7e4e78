// The page with one robot, in a frame as a notebook shows it: an origin of its own, and nothing of the notebook's.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { inPage, read, repository, run, setting, soon } from "./world.mjs";

/** A notebook with the output of `robot.frame()` in it. */
async function notebook(made) {
  const file = join(made.folder, "one.html");
  const done = run("view", join(made.robots, "welding_arm"), "--export", file);
  assert.equal(done.status, 0, done.stderr);
  const { sandbox } = /sandbox="(?<sandbox>[^"]*)"/.exec(
    readFileSync(join(repository, "python/lib/urdd/_show.py"), "utf8"),
  ).groups;
  const escaped = readFileSync(file, "utf8").replaceAll("&", "&amp;").replaceAll('"', "&quot;");
  const text = `<!doctype html><title>notebook</title><link rel="icon" href="data:," />
    <script>localStorage.secret = "mine"; document.cookie = "token=mine";</script>
    <iframe sandbox="${sandbox}" style="width: 100%; height: 650px" srcdoc="${escaped}"></iframe>`;
  const server = createServer((_, response) => {
    response.setHeader("content-type", "text/html; charset=utf-8");
    response.end(text);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const size = Buffer.byteLength(text);
  return { address: `http://127.0.0.1:${server.address().port}/`, size, file, end: () => server.close() };
}

const set = setting(["welding_arm"], notebook);

async function inside(page) {
  const frame = await soon(() => {
    const found = page.frames().find((frame) => frame.parentFrame());
    assert.ok(found);
    return found;
  });
  await frame.waitForFunction(
    () => {
      const { urdd } = globalThis;
      return urdd?.app.store.now.robot && urdd.stage.settledOn === urdd.app.store.now.robot;
    },
    null,
    { timeout: 120_000 },
  );
  return frame;
}

inPage(set, "a robot is drawn in a sandboxed frame, moves, and has its report", async (page) => {
  const frame = await inside(page);
  const q = () => frame.evaluate(() => globalThis.urdd.app.store.now.q);
  const poses = () => frame.evaluate(() => [...globalThis.urdd.app.store.now.poses]);
  // It draws plain meshes for those that the file leaves out: none of them is missing.
  assert.deepEqual(await frame.evaluate(() => globalThis.urdd.app.store.now.absent), []);
  const [before, placed] = [await q(), await poses()];
  const slider = frame.locator('.joints input[type="range"]').first();
  await slider.focus();
  for (let k = 0; k < 5; k++) await page.keyboard.press("ArrowRight");
  await soon(async () => {
    assert.notDeepEqual(await q(), before);
    assert.notDeepEqual(await poses(), placed);
  });
  const pixels = await frame.evaluate(async () => {
    const blob = await globalThis.urdd.stage.view.picture();
    const image = await globalThis.createImageBitmap(blob);
    const canvas = new globalThis.OffscreenCanvas(image.width, image.height);
    canvas.getContext("2d").drawImage(image, 0, 0);
    const { data } = canvas.getContext("2d").getImageData(0, 0, image.width, image.height);
    return new Set(Array.from({ length: data.length / 4 }, (_, k) => data.slice(4 * k, 4 * k + 3).join())).size;
  });
  assert.ok(pixels > 50, `${pixels} colours`);
  await frame.click("#tab-Findings");
  await frame
    .getByText(/0 errors|No finding|passes/i)
    .filter({ visible: true })
    .first()
    .waitFor();
  await frame.click("#tab-Proximity");
  await soon(async () => {
    const { answer, error } = await frame.evaluate(() => globalThis.urdd.app.store.now.proximity);
    assert.equal(error, null);
    assert.ok(answer?.nearest.length > 0);
  });
});

inPage(
  set,
  "the frame's scripts reach nothing of the notebook",
  async (page) => {
    const frame = await inside(page);
    const reached = await frame.evaluate(() => {
      const tries = {
        document: () => globalThis.parent.document.title,
        storage: () => globalThis.parent.localStorage.secret,
        own: () => globalThis.localStorage.secret,
        cookie: () => document.cookie,
        address: () => globalThis.parent.location.href,
        top: () => {
          globalThis.top.location.href = "about:blank";
        },
      };
      const found = { origin: globalThis.origin };
      for (const [name, act] of Object.entries(tries)) {
        try {
          found[name] = act() ?? "done";
        } catch (error) {
          found[name] = error.name;
        }
      }
      return found;
    });
    assert.equal(reached.origin, "null");
    for (const name of ["document", "storage", "own", "cookie", "address", "top"])
      assert.equal(reached[name], "SecurityError", name);
    assert.equal(await page.title(), "notebook");
  },
  { faults: null },
);

inPage(
  set,
  "the same file opens from the disk",
  async (page) => {
    await page.waitForFunction(() => globalThis.urdd?.app.store.now.robot, null, { timeout: 120_000 });
    const robots = await page.evaluate(() => globalThis.urdd.app.store.now.entries);
    assert.deepEqual(
      robots.map(({ name, verdict, notes }) => ({ name, verdict, notes })),
      [{ name: "welding_arm", verdict: "pass", notes: [] }],
    );
    assert.equal(read(join(set.made.robots, "welding_arm/urdd.json")).robot_name, "welding_arm");
  },
  { address: () => pathToFileURL(set.server.file).href },
);
