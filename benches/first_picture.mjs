// How long `urdd view robot.urdf` takes to the first picture with sliders, and a change on disk to its picture.
//
//     URDD=target/release/urdd node benches/first_picture.mjs ROBOT.urdf...
//
// Needs `npm --prefix page ci` and Chromium, which draws on the processor here. Prints a table: milliseconds from the start of
// the program until it has the robot for the page, until the page, then opened in a browser that runs, has drawn it, until the
// page has all that `generate` makes, and from a changed joint limit in the URDF to its picture; each the median of RUNS. The
// URDF is copied beside itself, and the copy is removed.

import { readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { browser, drawn, tab, view } from "../page/test/world.mjs";

const RUNS = 3;
const median = (values) => Math.round(values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)]);

/** Waits until the program can answer for a robot. */
async function ready(address, name) {
  const headers = { "x-urdd-token": /token=([^&]+)/.exec(address)[1] };
  for (;;) {
    const answer = await fetch(new URL(`robots/${name}/revision.json`, address), { headers });
    if (!answer.ok) throw new Error(await answer.text());
    const { entry } = await answer.json();
    if (entry.failure) throw new Error(entry.failure);
    if (entry.ready) return;
    await new Promise((resolve) => setTimeout(resolve, 5));
  }
}

async function measured(chrome, urdf) {
  const text = readFileSync(urdf, "utf8");
  const limit = /(<limit\b[^>]*\bupper=")[^"]*"/.exec(text);
  if (!limit) throw new Error(`${urdf} has no limit to change`);
  const name = `bench_${basename(urdf, ".urdf")}`;
  const copy = join(dirname(urdf), `${name}.urdf`);
  writeFileSync(copy, text);
  let close = async () => undefined;
  let server;
  try {
    const begun = performance.now();
    server = await view(copy);
    await ready(server.address, name);
    const program = performance.now() - begun;
    let page;
    ({ page, close } = await tab(chrome, server.address));
    await drawn(page, name);
    const first = performance.now() - begun;
    await page.waitForFunction(() => globalThis.urdd.app.store.now.robot?.entry.making === null, null, { timeout: 300_000 });
    await drawn(page, name);
    const whole = performance.now() - begun;
    await page.evaluate(() => {
      const { dofs } = globalThis.urdd.app.store.now.robot.about;
      globalThis.before = JSON.stringify(dofs.map(({ bounds }) => bounds));
    });
    const changed = performance.now();
    writeFileSync(`${copy}.new`, text.replace(limit[0], `${limit[1]}0.01234"`));
    renameSync(`${copy}.new`, copy);
    await page.waitForFunction(() => {
      const dofs = globalThis.urdd.app.store.now.robot?.about.dofs ?? [];
      return JSON.stringify(dofs.map(({ bounds }) => bounds)) !== globalThis.before;
    });
    await drawn(page, name);
    return [program, first, whole, performance.now() - changed];
  } finally {
    await close();
    server?.end();
    await server?.status;
    rmSync(copy, { force: true });
  }
}

const chrome = await browser();
console.log("| robot | program, ms | first picture, ms | all of it, ms | a change, ms |\n|---|---:|---:|---:|---:|");
for (const urdf of process.argv.slice(2)) {
  const runs = [];
  for (let run = 0; run < RUNS; run++) runs.push(await measured(chrome, urdf));
  const cells = [0, 1, 2, 3].map((column) => median(runs.map((run) => run[column])));
  console.log(`| ${basename(urdf, ".urdf")} | ${cells.join(" | ")} |`);
}
await chrome.close();
