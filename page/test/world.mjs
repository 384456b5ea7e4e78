// What the tests stand in: URDDs of our robots, `urdd view`, and a browser that tells of every error and foreign request.
//
// Set URDD to the program, and CHROMIUM where the browser is not /usr/bin/chromium.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { after, before, test } from "node:test";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliDecompressSync } from "node:zlib";
import { chromium } from "playwright-core";

export const repository = join(dirname(fileURLToPath(import.meta.url)), "../..");
export const program = process.env.URDD ?? join(repository, "target/debug/urdd");

export function run(...words) {
  const done = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 28 });
  if (done.error) throw done.error;
  return done;
}

/** What a file of tests stands in: URDDs of these robots, who serves them, and a browser; ended after its tests. */
export function setting(names, serve = (made) => view(made.robots)) {
  const set = {};
  before(async () => {
    set.made = robots(names);
    set.server = await serve(set.made);
    set.chrome = await browser();
  });
  after(async () => {
    await set.chrome?.close();
    set.server?.end();
    set.made?.remove();
  });
  return set;
}

/** A test with a page of its own, which ends without any console error, and without a request elsewhere. */
export function inPage(set, name, act, { faults: expected = [], address, ...options } = {}) {
  test(name, { timeout: 300_000 }, async () => {
    const { page, faults, close } = await tab(set.chrome, address?.() ?? set.server.address, options);
    try {
      await act(page);
      // Where nothing is expected, anything may be: the browser itself tells of answers that are no success.
      if (expected) assert.deepEqual(faults, expected);
    } finally {
      await close();
    }
  });
}

/** A folder with a URDD for each of these of our robots, by name. */
export function robots(names) {
  const folder = mkdtempSync(join(tmpdir(), "urdd-page-"));
  for (const name of names) {
    const made = run(
      "generate",
      join(repository, `conformance/robots/${name}.urdf`),
      "-o",
      join(folder, "robots", name),
    );
    assert.equal(made.status, 0, made.stderr);
  }
  return { folder, robots: join(folder, "robots"), remove: () => rmSync(folder, { recursive: true, force: true }) };
}

export function allNames() {
  const names = readdirSync(join(repository, "conformance/robots")).filter((name) => name.endsWith(".urdf"));
  return names.map((name) => name.slice(0, -".urdf".length)).sort();
}

export function read(path) {
  return JSON.parse(readFileSync(path, "utf8"));
}

/** `urdd view`: its address, its exit status once it ended, what it says besides, and how to end it. */
export async function view(...words) {
  const { cwd, env, opens = false } = typeof words.at(-1) === "object" ? words.pop() : {};
  const child = spawn(program, ["view", ...(opens ? [] : ["--no-open"]), ...words], { cwd, env });
  let [text, errors] = ["", ""];
  child.stderr.on("data", (data) => {
    errors += data;
  });
  const status = new Promise((resolve) => child.on("exit", resolve));
  // A test that fails may not come to end it.
  process.on("exit", () => child.kill());
  const address = await new Promise((resolve, reject) => {
    child.stdout.on("data", (data) => {
      text += data;
      const found = /http:\/\/\S+/.exec(text);
      if (found) resolve(found[0]);
    });
    child.on("exit", (code) => reject(new Error(`urdd view ended: ${code} ${errors}`)));
  });
  const said = (pattern) => soon(() => assert.match(errors, pattern), 30);
  return { address, status, said, input: child.stdin, end: () => child.kill("SIGINT") };
}

export async function browser() {
  const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
  const quiet = [
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
  ];
  const args = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", ...quiet];
  const start = () => chromium.launch({ executablePath, args });
  // Chromium crashed in one of some thousand starts, before any page. Whether it starts is not what the tests try.
  return start().catch((error) => {
    console.error(`the browser did not start, and is started again: ${error}`);
    return start();
  });
}

/** A file of the page as it was built last, in the folder that URDD_DIST names. */
const built = (name) => brotliDecompressSync(readFileSync(join(process.env.URDD_DIST, `${name}.br`)));

/** Names of the page's files by the paths that they have in a site. */
export function namesOf(page) {
  const words = /<meta name="urdd-files" content="([^"]*)"/.exec(page)?.[1].split(" ") ?? [];
  return new Map(words.flatMap((name, k) => (k % 2 === 0 ? [[`/${words[k + 1]}`, name]] : [])));
}

/** What a site answers for a file of the page: that of the page as it was built last, where there is one. */
export async function answered(route, name) {
  return process.env.URDD_DIST ? built(name) : (await route.fetch()).body();
}

/** The page as it was built last, where URDD_DIST names its folder: the program need not be built again for it. */
async function fromDist(context) {
  if (!process.env.URDD_DIST) return;
  const types = { js: "text/javascript", css: "text/css", wasm: "application/wasm" };
  const policy = /<meta http-equiv="Content-Security-Policy"[^>]*>/;
  const all = ["app.js", "editor.js", "make.js", "worker.js", "style.css", "make.wasm", "urdd.wasm"];
  const names = new Map(all.map((name) => [`/${name}`, name]));
  await context.route(/\/(?:index\.html)?(?:[?#].*)?$/, async (route) => {
    const response = await route.fetch();
    const text = await response.text();
    for (const [path, name] of namesOf(text)) names.set(path, name);
    await route.fulfill({ response, body: text.replace(policy, policy.exec(built("index.html").toString())[0]) });
  });
  await context.route(/\.(?:js|css|wasm)$/, async (route) => {
    const name = names.get(new URL(route.request().url()).pathname);
    const contentType = types[name?.split(".").pop()];
    await (contentType ? route.fulfill({ body: built(name), contentType }) : route.continue());
  });
}

/** A page of which every console error, failure and request elsewhere is kept. */
export async function tab(chrome, address, { first, routes, ...options } = {}) {
  const context = await chrome.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: "dark", ...options });
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await fromDist(context);
  // Playwright's 30 seconds are too few on a machine that others use.
  context.setDefaultTimeout(90_000);
  const page = await context.newPage();
  const faults = [];
  const { host } = new URL(address);
  for (const script of first ?? []) await page.addInitScript(script);
  for (const [pattern, answer] of routes ?? []) await page.route(pattern, answer);
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall|WebGL|swiftshader/i.test(message.text()))
      faults.push(message.text());
  });
  page.on("pageerror", (error) => faults.push(String(error.stack)));
  page.on("request", (request) => {
    const url = new URL(request.url());
    if (!["blob:", "data:"].includes(url.protocol) && url.host !== host) faults.push(`a request to ${url}`);
  });
  await page.goto(address);
  return { page, faults, close: () => context.close() };
}

/** Drags files or folders of this machine onto the page, as a person does: again, if the page was too busy to see it. */
export async function dropOn(page, ...files) {
  const session = await page.context().newCDPSession(page);
  const data = { items: [], files, dragOperationsMask: 1 };
  await page.evaluate(() => {
    globalThis.wasDropped = false;
    globalThis.addEventListener("drop", () => (globalThis.wasDropped = true), { capture: true, once: true });
  });
  for (let tries = 0; tries < 5; tries++) {
    for (const type of ["dragEnter", "dragOver", "drop"])
      await session.send("Input.dispatchDragEvent", { type, x: 640, y: 360, data });
    const was = page.waitForFunction(() => globalThis.wasDropped, null, { timeout: 3000 });
    if (await was.catch(() => false)) return;
  }
  throw new Error("the page saw no drop");
}

/** Opens a robot of the gallery, and waits until it is drawn. */
export async function open(page, name) {
  const back = page.getByRole("button", { name: "All robots" });
  if (await back.isVisible()) await back.click();
  await page
    .locator(".card", { has: page.locator(`strong:text-is("${name}")`) })
    .first()
    .click();
  await drawn(page, name);
}

/** Presses a button of the header, which folds what has no room. */
export async function press(page, name) {
  const more = page.locator(".chip.more");
  if (await more.isVisible()) await more.click();
  await page.getByRole("button", { name, exact: true }).click();
}

/**
 * Waits for the picture of a robot. A partial one, which is shown while the rest is made, does not count: the whole one takes its
 * place, and that of its report.
 */
export async function drawn(page, name, { isPartial = false } = {}) {
  const isDrawn = ({ name, isPartial }) => {
    const { robot, loading } = globalThis.urdd?.app.store.now ?? {};
    const isMade = robot && (isPartial || robot.entry.making === null);
    return isMade && (!name || robot.entry.name === name) && !loading && globalThis.urdd.stage.settledOn === robot;
  };
  try {
    await page.waitForFunction(isDrawn, { name, isPartial }, { timeout: 120_000 });
  } catch (error) {
    const seen = await page.evaluate(() => {
      const { robot, loading, failure, server, making } = globalThis.urdd?.app.store.now ?? {};
      const { href, hash } = globalThis.location;
      const isSettled = globalThis.urdd?.stage.settledOn === robot;
      return { robot: robot?.entry.name, isSettled, loading, failure, server, making, hash: hash || href };
    });
    throw new Error(`${name ?? "the robot"} is not drawn: ${JSON.stringify(seen)}`, { cause: error });
  }
}

/** What this check returns once it holds: the page gets there in its own time, later on a machine that is busy. */
export async function soon(check, seconds = 60) {
  for (const end = Date.now() + 1000 * seconds; ;) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() > end) throw error;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }
}

/** A value of the page's state, once it is as wanted. */
export function state(page, key, wanted = (value) => value !== null) {
  return soon(async () => {
    const value = await page.evaluate((key) => globalThis.urdd.app.store.now[key], key);
    assert.ok(wanted(value), `${key} stays ${JSON.stringify(value)?.slice(0, 300)}`);
    return value;
  }, 120);
}
