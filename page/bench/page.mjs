// Figures of the page, in a browser that draws by software: node bench/page.mjs ADDRESS ROBOT
//
// The first picture (where ADDRESS shows one robot, and ROBOT is not given: else a person's click is in it), a slider step, proximity per step, memory after robots were opened and closed.

import { browser, drawn, open, tab } from "../test/world.mjs";

const [address, robot, shapes = "pieces"] = process.argv.slice(2);
const chrome = await browser();
const { page, close } = await tab(chrome, address);
await page.waitForSelector(".card, .row");
if (robot) await open(page, robot);
await drawn(page);
await page.waitForFunction(() => globalThis.urdd.stage.firstPicture !== null);
const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];

const first = await page.evaluate(() => ({
  first: globalThis.urdd.stage.firstPicture,
  triangles: globalThis.urdd.stage.scene
    .meshes()
    .reduce((sum, mesh) => sum + (mesh.geometry.index ?? mesh.geometry.attributes.position).count / 3, 0),
}));
console.log(`first picture ${Math.round(first.first)} ms after the page began, ${first.triangles} triangles`);

// Script of a slider step: from the event to the last listener, twice (the event, and the answer of the worker).
const steps = await page.evaluate(async () => {
  const { app, stage } = globalThis.urdd;
  stage.view.draw = () => undefined;
  const begin = [];
  const { bounds } = app.store.now.robot.dofs[0];
  for (let k = 0; k < 200; k++) {
    const value = bounds[0] + ((bounds[1] - bounds[0]) * (k % 50)) / 50;
    const before = app.store.now.poses;
    let time = 0;
    const original = app.store.set;
    app.store.set = function (change) {
      const start = performance.now();
      original.call(this, change);
      time += performance.now() - start;
    };
    const start = performance.now();
    app.setDof(0, value);
    const all = performance.now() - start;
    const inside = time;
    time = 0;
    while (app.store.now.poses === before) await new Promise((resolve) => setTimeout(resolve, 0));
    begin.push(all + time);
    void inside;
    app.store.set = original;
  }
  return begin;
});
console.log(`a slider step ${median(steps).toFixed(2)} ms of script (median of ${steps.length})`);

const proximity = await page.evaluate(async (shapes) => {
  const { app } = globalThis.urdd;
  await app.engine.ask("proximity", { q: app.store.now.q, kind: shapes, k: 24 });
  const times = [];
  let pairs = 0;
  for (let k = 0; k < 100; k++) {
    const q = await app.engine.ask("random", { k });
    const answer = await app.engine.ask("proximity", { q, kind: shapes, k: 24 });
    times.push(answer.ms);
    pairs = answer.pairs;
  }
  return { times, pairs };
}, shapes);
console.log(
  `proximity of ${proximity.pairs} pairs of ${shapes}: ${median(proximity.times).toFixed(2)} ms a step (median of 100 random configurations)`,
);

// Memory after loading and closing ten robots, in turn, all layers of each: what stays must not grow with their number. ADDRESS shows several.
const session = await page.context().newCDPSession(page);
const names = await page.evaluate(() => globalThis.urdd.app.store.now.entries.map(({ name }) => name));
const memory = async () => {
  await page.evaluate(() => globalThis.urdd.app.close());
  await page.waitForTimeout(500);
  await session.send("HeapProfiler.collectGarbage");
  const { usedSize } = await session.send("Runtime.getHeapUsage");
  const { geometries, textures } = await page.evaluate(() => globalThis.urdd.stage.view.held());
  const engine = await page.evaluate(() => globalThis.urdd.app.engine.ask("memory", {}));
  return { heap: usedSize, geometries, textures, engine };
};
const told = ({ heap, geometries, textures, engine }) =>
  `heap ${(heap / 1e6).toFixed(1)} MB, ${geometries} geometries, ${textures} textures, engine ${(engine / 1e6).toFixed(1)} MB`;
if (names.length > 1) {
  for (let round = 0; round < 10; round++) {
    const name = names[round % names.length];
    await open(page, name);
    for (const layer of ["plain", "hulls", "pieces", "boxes", "spheres"])
      await page.evaluate((layer) => globalThis.urdd.app.setLayer(layer, { on: true }), layer);
    await page.waitForFunction(
      () => !globalThis.urdd.app.store.now.loading && globalThis.urdd.stage.busy.size === 0,
      undefined,
      { timeout: 120_000 },
    );
    // A URDD without skips has no distances.
    await page.evaluate(() =>
      globalThis.urdd.app.engine
        .ask("proximity", { q: globalThis.urdd.app.store.now.q, kind: "hulls", k: 1 })
        .catch(() => null),
    );
    if (round === 0 || round === 9) console.log(`after ${round + 1} robots: ${told(await memory())}`);
  }
}
await close();
await chrome.close();
