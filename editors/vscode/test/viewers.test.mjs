// What `urdd view` is started with, and what is read from it.

import assert from "node:assert/strict";
import { existsSync, readFileSync, statSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { folder, program, source } from "./world.mjs";

const { address, compared, target, viewArguments, Viewers } = await source("viewers.ts");
const PAGE = "http://127.0.0.1:8642/#token=1f2e3d";

test("the file that is shown", () => {
  assert.equal(target("/robots/arm.urdf"), "/robots/arm.urdf");
  assert.equal(target("/robots/arm.urdf.xacro"), "/robots/arm.urdf.xacro");
  assert.equal(target("/robots/ARM.URDF"), "/robots/ARM.URDF");
  assert.equal(target("/robots/arm/urdd.json"), "/robots/arm");
  for (const other of ["/robots/arm.xml", "/robots/urdf", "/robots/arm/dof_module/module.json"]) {
    assert.equal(target(other), null);
  }
});

test("the arguments: no browser is opened by the program", () => {
  assert.deepEqual(viewArguments(["/robots/an arm.urdf"]), ["view", "/robots/an arm.urdf", "--no-open"]);
  assert.deepEqual(viewArguments(["/old.urdf", "/new.urdf"]), [
    "view",
    "--compare",
    "/old.urdf",
    "/new.urdf",
    "--no-open",
  ]);
});

test("two robots are compared, the older one first", () => {
  const times = { "/a.urdf": 2, "/b.urdf": 1, "/b/urdd.json": 3 };
  const of = (...files) => compared(files, (file) => times[file] ?? 0);
  assert.deepEqual(of("/a.urdf", "/b.urdf"), ["/b.urdf", "/a.urdf"]);
  assert.deepEqual(of("/b.urdf", "/a.urdf"), ["/b.urdf", "/a.urdf"]);
  assert.deepEqual(of("/b/urdd.json", "/a.urdf"), ["/a.urdf", "/b"]);
  // The order of the selection, where nothing else says it.
  assert.deepEqual(of("/y.urdf", "/x.xacro"), ["/y.urdf", "/x.xacro"]);
  for (const files of [[], ["/a.urdf"], ["/a.urdf", "/a.urdf"], ["/a.urdf", "/notes.txt"], Object.keys(times)])
    assert.equal(of(...files), null, files.join());
});

test("the address in the output", () => {
  assert.equal(address(`1 robot: ${PAGE}\nCtrl-C stops it.\n`), PAGE);
  assert.equal(address(`1 robot: ${PAGE}\r\n`), PAGE);
  // Not before its line has ended, and nothing but this machine.
  assert.equal(address(`1 robot: ${PAGE}`), null);
  assert.equal(address("1 robot: http://127.0.0.1.evil.example:1/#token=1\n"), null);
  assert.equal(address("see http://example.org/\n"), null);
  assert.equal(address("see file:///etc/passwd\n"), null);
});

test("a browser gets the path of a page that only this user can read", (t) => {
  const viewers = new Viewers();
  t.after(() => viewers.stop());
  const page = viewers.page(`${PAGE}&q=1`);
  assert.equal(viewers.page(`${PAGE}&q=1`), page);
  assert.ok(!page.includes("1f2e3d"));
  assert.ok(readFileSync(page, "utf8").includes(`content="0; url=${PAGE}&amp;q=1"`));
  if (process.platform !== "win32") {
    assert.equal(statSync(page).mode & 0o777, 0o600);
    assert.equal(statSync(dirname(page)).mode & 0o777, 0o700);
  }
  viewers.stop();
  assert.ok(!existsSync(dirname(page)));
});

/** A program that writes down its process and arguments, prints an address in two pieces, and goes on. */
const SERVES = `
  require("node:fs").appendFileSync(__dirname + "/log", process.pid + " " + process.argv.slice(2).join(" ") + "\\n");
  process.stdout.write("1 robot: http://127.0.0.1:86");
  setTimeout(() => process.stdout.write("42/#token=1f2e3d\\nCtrl-C stops it.\\n"), 50);
  setInterval(() => {}, 1000);
`;

function isRunning(process_) {
  try {
    return process.kill(process_, 0);
  } catch {
    return false;
  }
}

test("a robot has one server, which ends with the extension", async (t) => {
  const made = folder(t);
  const urdd = program(join(made, "urdd"), SERVES);
  const viewers = new Viewers();
  t.after(() => viewers.stop());
  const robot = join(made, "arm.urdf");
  assert.deepEqual(
    await Promise.all([viewers.address(urdd, [robot], process.env), viewers.address(urdd, [robot], process.env)]),
    [PAGE, PAGE],
  );
  assert.equal(await viewers.address(urdd, [robot], process.env), PAGE);

  const started = readFileSync(join(made, "log"), "utf8").trim().split("\n");
  assert.equal(started.length, 1);
  const [one, ...words] = started[0].split(" ");
  assert.deepEqual(words, viewArguments([robot]));
  assert.ok(isRunning(Number(one)));
  viewers.stop();
  for (let tries = 0; isRunning(Number(one)) && tries < 100; tries++) await sleep(20);
  assert.ok(!isRunning(Number(one)));
});

test("a robot whose server failed can be shown again, and the message is the program's", async (t) => {
  const made = folder(t);
  const failing = `console.error("urdd: arm.urdf: no link"); process.exitCode = 2;`;
  const urdd = program(join(made, "urdd"), failing);
  const viewers = new Viewers();
  t.after(() => viewers.stop());
  const robot = join(made, "arm.urdf");
  await assert.rejects(viewers.address(urdd, [robot], process.env), { message: "urdd: arm.urdf: no link" });
  program(urdd, SERVES);
  assert.equal(await viewers.address(urdd, [robot], process.env), PAGE);
});

test("a program that cannot be started is an error", async (t) => {
  const missing = join(folder(t), "urdd");
  assert.ok(!existsSync(missing));
  await assert.rejects(new Viewers().address(missing, ["/arm.urdf"], process.env), /ENOENT/);
});
