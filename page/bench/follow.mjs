// The page beside a program that moves the robot: node bench/follow.mjs URDD [SECONDS]
//
// Sends 60 configurations a second to `urdd view --follow`, and says how many the page showed, how long after they were
// sent, and what its memory was before and after.

import { browser, drawn, tab, view } from "../test/world.mjs";

const [urdd, seconds = "60"] = process.argv.slice(2);
const server = await view(urdd, "--follow");
const chrome = await browser();
const { page, close } = await tab(chrome, server.address);
await drawn(page);
const session = await page.context().newCDPSession(page);
const memory = async () => {
  await session.send("HeapProfiler.collectGarbage");
  return (await session.send("Runtime.getHeapUsage")).usedSize / 2 ** 20;
};
const dofs = await page.evaluate(() => globalThis.urdd.app.store.now.robot.dofs.length);
const row = (value) => `${JSON.stringify(Array.from({ length: dofs }, () => value))}\n`;
server.input.write(row(0));
await page.evaluate(() => {
  globalThis.shown = new Map();
  globalThis.pictures = 0;
  const { app, stage } = globalThis.urdd;
  // The poses of a configuration are what the picture shows.
  app.store.on(["poses"], ({ q }) => globalThis.shown.set(Math.round(q[0] * 1e6), Date.now()));
  const draw = stage.view.draw.bind(stage.view);
  stage.view.draw = (...words) => {
    globalThis.pictures++;
    return draw(...words);
  };
});
await page.waitForTimeout(3000);
const before = await memory();
const sent = new Map();
const begin = Date.now();
const count = 60 * Number(seconds);
for (let k = 1; k <= count; k++) {
  server.input.write(row(k / 1e6));
  sent.set(k, Date.now());
  const wait = begin + (1000 * k) / 60 - Date.now();
  if (wait > 0) await new Promise((resolve) => setTimeout(resolve, wait));
}
await page.waitForTimeout(2000);
const [entries, pictures] = await page.evaluate(() => [[...globalThis.shown], globalThis.pictures]);
await page.evaluate(() => globalThis.shown.clear());
const late = entries.flatMap(([k, time]) => (sent.has(k) ? [time - sent.get(k)] : [])).sort((a, b) => a - b);
const at = (part) => late[Math.min(late.length - 1, Math.floor(part * late.length))];
console.log(`${late.length} of ${count} configurations shown, ${pictures} pictures, in ${seconds} s`);
console.log(`shown after ${at(0.5)} ms (median), ${at(0.99)} ms (99 %), ${at(1)} ms at most`);
console.log(`memory ${before.toFixed(1)} MiB before, ${(await memory()).toFixed(1)} MiB after`);
await close();
await chrome.close();
server.end();
