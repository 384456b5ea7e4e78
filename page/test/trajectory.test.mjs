// Trajectories from files: what is shown when, where it collides, and files that are none.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { drawn, dropOn, inPage, run, setting, soon, state } from "./world.mjs";

const set = setting(["welding_arm"]);

const shown = (page) => page.evaluate(() => globalThis.urdd.app.store.now.q);
const load = (page, name, text) =>
  page.setInputFiles(".timeline input[type=file]", { name, mimeType: "text/csv", buffer: Buffer.from(text) });
const seek = (page, time) =>
  page.evaluate((time) => {
    const slider = globalThis.document.querySelector(".timeline input[type=range]");
    slider.value = String(time);
    slider.dispatchEvent(new globalThis.Event("input"));
  }, time);
const near = (found, expected) =>
  found.forEach((value, dof) => assert.ok(Math.abs(value - expected[dof]) < 1e-9, `${found} ${expected}`));

/** The names of the DOFs, and rows of random configurations. */
const rowsOf = (page, count) =>
  page.evaluate(async (count) => {
    const { app } = globalThis.urdd;
    const { dofs } = app.store.now.robot;
    const rows = Array.from({ length: count }, (_, row) =>
      dofs.map(({ bounds }, dof) => {
        const [low, high] = bounds ?? [-3, 3];
        return low + (high - low) * (0.5 + 0.5 * Math.sin(1.7 * row + 2.3 * dof));
      }),
    );
    return { names: dofs.map(({ name }) => name), rows };
  }, count);

inPage(set, "a CSV with times is shown as it says, and as fast", async (page) => {
  await drawn(page, "welding_arm");
  const { names, rows } = await rowsOf(page, 3);
  const head = ["time", ...names].reverse();
  const line = (time, row) => [time, ...row].reverse().join(",");
  const text = `# a comment\n${head.join(",")}\n${line(10, rows[0])}\n${line(10.5, rows[1])}\n${line(12, rows[2])}\n`;
  await load(page, "motion.csv", text);
  await page.locator(".timeline").waitFor();
  near(await shown(page), rows[0]);
  assert.match(await page.locator(".timeline .actions output").textContent(), /^0\.00 of 2\.00 s$/);
  await seek(page, 0.5);
  near(await shown(page), rows[1]);
  await seek(page, 1.25);
  near(
    await shown(page),
    rows[1].map((value, dof) => (value + rows[2][dof]) / 2),
  );
  // To its end, at four times the speed.
  await seek(page, 0);
  await page.selectOption(".timeline select", { label: "4 ×" });
  const begin = Date.now();
  await page.click("#timeline-play");
  await soon(async () => assert.equal(await page.locator("#timeline-play").textContent(), "Play"), 60);
  assert.ok(Date.now() - begin >= 450, "2 s take half a second");
  near(await shown(page), rows[2]);
  // Round and round, until it is stopped.
  await page.check("#timeline-loop");
  await page.click("#timeline-play");
  await page.waitForTimeout(1200);
  assert.equal(await page.locator("#timeline-play").textContent(), "Pause");
  await page.click("#timeline-play");
  await page.getByRole("button", { name: "Close" }).click();
  await page.locator(".timeline").waitFor({ state: "hidden" });
});

inPage(set, "the timeline says how much of it collides, as check-collisions does", async (page) => {
  await drawn(page, "welding_arm");
  const { rows } = await rowsOf(page, 40);
  const file = join(set.made.folder, "random.jsonl");
  writeFileSync(file, rows.map((row) => `${JSON.stringify(row)}\n`).join(""));
  const checked = run("check-collisions", join(set.made.robots, "welding_arm"), "-c", file, "--format", "json");
  const hits = checked.stdout
    .trim()
    .split("\n")
    .filter((line) => JSON.parse(line).in_collision === true).length;
  assert.ok(hits > 0 && hits < 40, `${hits} of 40`);
  await dropOn(page, file);
  await soon(async () => {
    const said = await page.locator(".timeline .along").textContent();
    assert.equal(said, `self-collision for ${Math.ceil((100 * hits) / 40)} % of the time`);
  });
  // Red is drawn where it collides.
  const red = await page.evaluate(() => {
    const strip = globalThis.document.querySelector(".timeline > canvas");
    const { data } = strip.getContext("2d").getImageData(0, 0, strip.width, 1);
    return [...data.keys()].filter((k) => k % 4 === 0 && data[k] > 200 && data[k + 2] < 150).length / strip.width;
  });
  assert.ok(Math.abs(red - hits / 40) < 0.05, `${red} ${hits / 40}`);
  const saved = page.waitForEvent("download");
  await page.selectOption(".timeline select", { label: "4 ×" });
  await page.getByRole("button", { name: "Record" }).click();
  const video = await saved;
  assert.equal(video.suggestedFilename(), "random.webm");
});

inPage(set, "files that are no trajectory of this robot are refused with their line", async (page) => {
  await drawn(page, "welding_arm");
  const { names, rows } = await rowsOf(page, 2);
  const row = rows[0].join(",");
  const json = JSON.stringify(rows[0]);
  for (const [text, message] of [
    ["", /bad\.csv has no configuration/],
    ["1,2\n", /line 1: 2 values, where 6 are expected/],
    [`${row}\n${row.replace(/^[^,]*/, "x")}\n`, /line 2: a value is not a finite number/],
    [`${row}\nnan${row.slice(row.indexOf(","))}\n`, /line 2: a value is not a finite number/],
    [`elbow,knee\n${row}\n`, /line 1: this robot has no DOF/],
    [`${names.slice(1).join(",")}\n`, /line 1: the column for the DOF .* is missing/],
    [`time,${names.join(",")}\n2,${row}\n1,${row}\n`, /line 3: the time goes back/],
    [`${json}\n[1, 2]\n`, /line 2: 2 values; this robot has 6 DOFs/],
    [`${json}\n{"nobody": 1}\n`, /line 2: this robot has no DOF/],
    [`${json}\n[1, 2\n`, /line 2: /],
    [`${`[${"0,".repeat(5)}0]\n`.repeat(1_000_001)}`, /line 1000001: more than a million/],
  ]) {
    await page.evaluate(() => globalThis.urdd.app.store.set({ note: null }));
    await load(page, "bad.csv", text);
    const note = await state(page, "note");
    assert.match(note, message);
    assert.ok(await page.locator(".timeline").isHidden());
  }
});

inPage(
  set,
  "plots have the values of each joint and its limits, and ghosts are where it begins and ends",
  async (page) => {
    await drawn(page, "welding_arm");
    const { rows } = await rowsOf(page, 30);
    // The second joint is beyond its limit at one time.
    rows[12][1] = 3;
    await load(page, "motion.csv", rows.map((row) => row.join(",")).join("\n"));
    await page.locator(".timeline").waitFor();
    await page.getByLabel("Plots").check();
    await seek(page, 12 / 30);
    const value = page.locator(".plots output").nth(1);
    await soon(async () => assert.equal(await value.textContent(), `${((3 * 180) / Math.PI).toFixed(2)}°`));
    assert.match(await value.getAttribute("class"), /bad/);
    assert.doesNotMatch((await page.locator(".plots output").nth(2).getAttribute("class")) ?? "", /bad/);
    // The curve is highest in the column of that row, and above the line of the upper limit.
    const found = await page.evaluate(() => {
      const canvas = globalThis.document.querySelectorAll(".plots canvas")[1];
      const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const first = (isWanted) => {
        const at = [...Array(width * height).keys()].find((k) => isWanted(...data.subarray(4 * k, 4 * k + 4)));
        return [at % width, Math.floor(at / width)];
      };
      return {
        width,
        curve: first((r, g, b, a) => a > 200 && b > 1.5 * r),
        limit: first((r, g, b, a) => a > 100 && r > 1.5 * b),
      };
    });
    assert.ok(Math.abs(found.curve[0] - (found.width * 12) / 29) < 4, JSON.stringify(found));
    assert.ok(found.curve[1] < found.limit[1], JSON.stringify(found));
    // Each ghost has the link's place in the first or the last row.
    const ghosts = () => page.evaluate(() => globalThis.urdd.app.store.now.ghosts.map((poses) => [...poses]));
    const expected = await page.evaluate(
      async (rows) => {
        const { engine } = globalThis.urdd.app;
        return Promise.all(rows.map(async (q) => [...(await engine.ask("linkPoses", { q }))]));
      },
      [rows[0], rows[29]],
    );
    assert.deepEqual(await ghosts(), expected);
    const drawnGhosts = () =>
      page.evaluate(() => {
        const places = [];
        globalThis.urdd.stage.view.scene.traverse(({ material, matrixWorld }) => {
          if (material?.opacity === 0.22) places.push(matrixWorld.elements.slice(12, 15));
        });
        return places;
      });
    const places = await drawnGhosts();
    assert.ok(places.length > 0 && places.length % 2 === 0, `${places.length}`);
    assert.notDeepEqual(places.slice(0, places.length / 2), places.slice(places.length / 2));
    await page.getByLabel("Start and end").uncheck();
    assert.deepEqual(await ghosts(), []);
    await soon(async () => assert.deepEqual(await drawnGhosts(), []));
  },
);
