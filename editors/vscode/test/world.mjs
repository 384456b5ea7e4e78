// What the tests share: the sources as modules that Node can import, and a program that stands for `urdd`.

import { build } from "esbuild";
import { chmodSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const extension = dirname(dirname(fileURLToPath(import.meta.url)));
export const repository = join(extension, "../..");

/** A module of src/. */
export async function source(name) {
  const entryPoints = [join(extension, "src", name)];
  const { outputFiles } = await build({ entryPoints, bundle: true, write: false, platform: "node", format: "esm" });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}

/** A new folder, removed after the test. */
export function folder(test) {
  const made = mkdtempSync(join(tmpdir(), "urdd-vscode-"));
  test.after(() => rmSync(made, { recursive: true, force: true }));
  return made;
}

/** A program that runs a script of Node. */
export function program(path, script) {
  writeFileSync(path, `#!${process.execPath}\n${script}`);
  chmodSync(path, 0o755);
  return path;
}
