// The program is found where a workspace cannot put one, and settings are answered as the server asks.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { delimiter, join, relative } from "node:path";
import { test } from "node:test";
import { folder, program, source } from "./world.mjs";

const { find, notFound, section, withPackages } = await source("program.ts");

test("a name is looked up in the absolute folders of PATH alone", (t) => {
  const made = folder(t);
  for (const name of ["first", "second", "third"]) mkdirSync(join(made, name));
  // Neither a folder nor a text file is a program.
  mkdirSync(join(made, "first/urdd"));
  writeFileSync(join(made, "second/urdd"), "");
  const urdd = program(join(made, "third/urdd"), "");
  const path = (...names) => ({ PATH: names.map((name) => join(made, name)).join(delimiter) });

  assert.equal(find("urdd", path("first", "second", "third")), urdd);
  assert.equal(find("urdd", path("first", "second")), null);
  assert.equal(find("urdd", {}), null);
  assert.equal(find("urdd", { PATH: relative(process.cwd(), join(made, "third")) }), null);
  assert.equal(find("urdd", { PATH: `${delimiter}.${delimiter}` }), null);
});

test("a path has to be absolute", (t) => {
  const urdd = program(join(folder(t), "urdd"), "");
  assert.equal(find(urdd, {}), urdd);
  assert.equal(find(relative(process.cwd(), urdd), process.env), null);
  assert.equal(find("./urdd", process.env), null);
  assert.equal(find(urdd + "2", {}), null);
});

test("the message says what to do", () => {
  assert.match(notFound("urdd"), /pip install urdd.*urdd\.path/);
  assert.match(notFound("bin/urdd"), /`bin\/urdd`.*absolute path/);
});

test("folders of packages come before those of ROS", () => {
  const settings = { xacro: false, packagePaths: ["/a b", "/c"], baseline: "" };
  const ros = { HOME: "/root", ROS_PACKAGE_PATH: "/opt/ros" };
  const all = ["/a b", "/c", "/opt/ros"].join(delimiter);
  assert.deepEqual(withPackages(settings, ros), { HOME: "/root", ROS_PACKAGE_PATH: all });
  assert.deepEqual(withPackages({ ...settings, packagePaths: [] }, { HOME: "/root" }), { HOME: "/root" });
});

test("the server gets its own settings and no others", () => {
  const settings = { xacro: false, packagePaths: ["/opt/ros"], baseline: "/known.json" };
  assert.deepEqual(section(settings, "urdd"), settings);
  assert.equal(section(settings, "urdd.xacro"), false);
  assert.deepEqual(section(settings, "urdd.packagePaths"), ["/opt/ros"]);
  assert.equal(section(settings, "urdd.baseline"), "/known.json");
  for (const other of [undefined, "", "urdd.path", "editor", "constructor"]) {
    assert.equal(section(settings, other), undefined);
  }
});
