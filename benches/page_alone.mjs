// How long a page on a plain file server takes to make a robot of a folder that is dropped on it, beside the program.
//
//     URDD=target/release/urdd node benches/page_alone.mjs FOLDER...
//
// A FOLDER has one URDF and its meshes. Needs `npm --prefix page ci`, python3, and Chromium, which draws on the processor
// here. Prints a table: seconds from the drop until the findings are there, the robot is drawn, it has its pieces, and it has
// all; the memory of the page's process at its largest, by the system; then `urdd generate`, in one thread and in all, and
// how many times as long the page took as one thread. Each the median of RUNS.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { exported } from "../page/test/exported.mjs";
import { browser, drawn, dropOn, program, robots, tab } from "../page/test/world.mjs";

const RUNS = 3;
const PERIOD = 250;
const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];

/** The largest resident set of a renderer of this machine, bytes. */
function memory() {
  let most = 0;
  for (const process of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const words = readFileSync(`/proc/${process}/cmdline`, "utf8");
      if (!words.includes("--type=renderer") || words.includes("extension")) continue;
      const size = /VmRSS:\s+(\d+) kB/.exec(readFileSync(`/proc/${process}/status`, "utf8"));
      most = Math.max(most, 1024 * Number(size?.[1] ?? 0));
    } catch {
      // It has ended.
    }
  }
  return most;
}

async function inPage(address, folder) {
  // Each with a browser of its own, so that none has the memory or the code of another.
  const chrome = await browser();
  let most = 0;
  const watch = setInterval(() => (most = Math.max(most, memory())), PERIOD);
  try {
    const { page, close } = await tab(chrome, address);
    await page.waitForSelector(".card");
    const begun = performance.now();
    const since = () => (performance.now() - begun) / 1000;
    const when = async (condition) => {
      await page.waitForFunction(condition, null, { timeout: 600_000 });
      return since();
    };
    await dropOn(page, folder);
    const lint = when(() => globalThis.urdd.app.store.now.report.report !== null);
    await page.waitForFunction(() => globalThis.urdd.app.store.now.robot !== null, null, { timeout: 600_000 });
    await drawn(page, await page.evaluate(() => globalThis.urdd.app.store.now.robot.entry.name));
    const picture = since();
    const pieces = await when(() => globalThis.urdd.app.store.now.robot?.about.meshes.pieces?.some((all) => all.length > 0));
    const whole = await when(() => globalThis.urdd.app.store.now.robot?.entry.making === null);
    const found = await lint;
    await close();
    return [found, picture, pieces, whole, most / 1e6];
  } finally {
    clearInterval(watch);
    await chrome.close();
  }
}

function generated(folder, env) {
  const out = mkdtempSync(join(tmpdir(), "urdd-alone-"));
  try {
    const urdf = readdirSync(folder, { recursive: true }).find((name) => name.endsWith(".urdf"));
    const begun = performance.now();
    const words = ["generate", join(folder, urdf), "-o", join(out, "made")];
    const done = spawnSync(program, words, { env: { ...process.env, ...env }, encoding: "utf8" });
    if (done.status !== 0) throw new Error(done.stderr);
    return (performance.now() - begun) / 1000;
  } finally {
    rmSync(out, { recursive: true });
  }
}

const made = robots(["gripper", "single_link"]);
const site = await exported(made);
console.log("| robot | findings, s | picture, s | pieces, s | all, s | memory, MB | `urdd generate`, one thread, s | all threads, s | times one thread |");
console.log("|---|---:|---:|---:|---:|---:|---:|---:|---:|");
for (const folder of process.argv.slice(2)) {
  const runs = [];
  for (let run = 0; run < RUNS; run++)
    runs.push([...(await inPage(site.address, folder)), generated(folder, { RAYON_NUM_THREADS: "1" }), generated(folder, {})]);
  const of = runs[0].map((_, column) => median(runs.map((run) => run[column])));
  const words = of.map((value, column) => (column === 4 ? value.toFixed(0) : value.toFixed(1)));
  console.log(`| ${basename(folder)} | ${words.join(" | ")} | ${(of[3] / of[5]).toFixed(1)} |`);
}
site.end();
made.remove();
