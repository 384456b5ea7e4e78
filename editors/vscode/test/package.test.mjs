// What is packed, and that the manifest, the sources and schema/ agree.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { isBuiltin } from "node:module";
import { join } from "node:path";
import { test } from "node:test";
import { strFromU8, unzipSync } from "fflate";
import { extension, folder, repository } from "./world.mjs";

const manifest = JSON.parse(readFileSync(join(extension, "package.json"), "utf8"));
const modules = readdirSync(join(repository, "schema")).filter((name) => name.endsWith("_module"));

test("the version is the program's", () => {
  const cargo = readFileSync(join(repository, "Cargo.toml"), "utf8");
  assert.equal(manifest.version, /^version = "(.+)"$/m.exec(cargo)[1]);
});

test("every module of schema/ has its schema, as JSON and as YAML", () => {
  assert.ok(modules.length > 20);
  const of = (ending) =>
    modules.map((name) => ({ fileMatch: `**/${name}/module.${ending}`, url: `./schemas/${name}.json` }));
  const { jsonValidation, yamlValidation } = manifest.contributes;
  assert.deepEqual(jsonValidation, [{ fileMatch: "**/urdd.json", url: "./schemas/root_metadata.json" }, ...of("json")]);
  assert.deepEqual(yamlValidation, of("yaml"));
});

test("a workspace cannot choose the program, nor let xacro run", () => {
  const { properties } = manifest.contributes.configuration;
  assert.equal(properties["urdd.path"].scope, "machine");
  assert.equal(properties["urdd.xacro"].default, false);
  assert.equal(properties["urdd.xacro"].scope, "machine");
  const { restrictedConfigurations } = manifest.capabilities.untrustedWorkspaces;
  assert.deepEqual(restrictedConfigurations, Object.keys(properties));
});

test("every command is registered, and a comparison needs two selected files", () => {
  const source = readFileSync(join(extension, "src/extension.ts"), "utf8");
  const registered = [...source.matchAll(/registerCommand\("([^"]+)"/g)].map(([, name]) => name);
  const { commands, menus } = manifest.contributes;
  assert.deepEqual(registered.sort(), commands.map(({ command }) => command).sort());
  const [compare] = menus["explorer/context"].filter(({ command }) => command === "urdd.compare");
  assert.match(compare.when, /^listDoubleSelection && /);
});

test("the package holds what it needs, and nothing else", (t) => {
  const vsix = join(folder(t), "urdd.vsix");
  execFileSync("npm", ["run", "--silent", "package", "--", "--out", vsix], { cwd: extension, stdio: "pipe" });
  const files = unzipSync(readFileSync(vsix));
  const names = Object.keys(files);
  const others = names.filter((name) => !name.startsWith("extension/schemas/"));
  assert.deepEqual(others.sort(), [
    "[Content_Types].xml",
    "extension.vsixmanifest",
    "extension/LICENSE.txt",
    "extension/dist/extension.cjs",
    "extension/dist/licences.txt",
    "extension/language-configuration.json",
    "extension/package.json",
    "extension/readme.md",
    "extension/syntaxes/urdf.tmLanguage.json",
  ]);
  for (const { url } of manifest.contributes.jsonValidation) {
    const { anyOf } = JSON.parse(strFromU8(files[`extension/${url.slice(2)}`]));
    for (const { $ref } of anyOf) assert.ok(`extension/schemas/${$ref.slice(2)}` in files, $ref);
  }
  const bundle = strFromU8(files["extension/dist/extension.cjs"]);
  // VS Code itself, and what Node has: all else is in the bundle.
  const required = new Set([...bundle.matchAll(/\brequire\("([^"]+)"\)/g)].map(([, name]) => name));
  const missing = [...required].filter((name) => name !== "vscode" && !isBuiltin(name));
  assert.deepEqual(missing, []);
  assert.match(strFromU8(files["extension/dist/licences.txt"]), /^vscode-languageclient\n/m);
  assert.match(strFromU8(files["extension/LICENSE.txt"]), /MIT License[^]*Apache License/);
});
