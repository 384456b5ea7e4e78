// The schemas as VS Code's own JSON service reads them: real documents pass, a wrong one does not.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import json from "vscode-json-languageservice";
import { extension, repository } from "./world.mjs";

const { getLanguageService, TextDocument } = json;
const { jsonValidation } = JSON.parse(readFileSync(join(extension, "package.json"), "utf8")).contributes;
const service = getLanguageService({
  schemaRequestService: (uri) => Promise.resolve(readFileSync(fileURLToPath(uri), "utf8")),
  workspaceContext: { resolveRelativePath: (relative, base) => new URL(relative, base).href },
});

before(() => {
  execFileSync("node", ["build.mjs"], { cwd: extension });
  service.configure({
    schemas: jsonValidation.map(({ fileMatch, url }) => ({
      fileMatch: [`/${fileMatch}`],
      uri: pathToFileURL(join(extension, url)).href,
    })),
  });
});

/** What the service says of a document. */
async function findings(path, text = readFileSync(path, "utf8")) {
  const document = TextDocument.create(pathToFileURL(path).href, "json", 1, text);
  return (await service.doValidation(document, service.parseJSONDocument(document))).map(({ message }) => message);
}

function documents(folder) {
  const all = readdirSync(folder, { recursive: true, withFileTypes: true });
  const paths = all.map((entry) => join(entry.parentPath ?? entry.path, entry.name));
  return paths.filter((path) => basename(path) === "urdd.json" || /_module[/\\]module\.json$/.test(path));
}

test("URDDs of version 1 and of before pass", async () => {
  const paths = ["examples/urdds/arm", "conformance/bases/legacy"].flatMap((one) => documents(join(repository, one)));
  assert.ok(paths.length > 8, `${paths.length} documents`);
  for (const path of paths) assert.deepEqual(await findings(path), [], path);
});

test("a value of another type is found, at its place", async () => {
  const path = join(repository, "examples/urdds/arm/dof_module/module.json");
  const wrong = JSON.parse(readFileSync(path, "utf8"));
  wrong.num_dofs = "six";
  assert.equal((await findings(path, JSON.stringify(wrong))).length, 1);
  const root = join(dirname(path), "../urdd.json");
  assert.equal((await findings(root, '{ "urdd_version": 1 }')).length > 0, true);
});

test("a key's description is shown", async () => {
  const path = join(repository, "examples/urdds/arm/dof_module/module.json");
  const text = readFileSync(path, "utf8");
  const document = TextDocument.create(pathToFileURL(path).href, "json", 1, text);
  const place = document.positionAt(text.indexOf('"num_dofs"') + 2);
  const hover = await service.doHover(document, place, service.parseJSONDocument(document));
  assert.match(JSON.stringify(hover), /degrees of freedom|DOFs/i);
});
