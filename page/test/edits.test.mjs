// Fixes of a report as changes of a text: `urdd lint --fix` says what they must make of it.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { build } from "esbuild";
import { run } from "./world.mjs";
import { FAULTY } from "./faulty.mjs";

const folder = mkdtempSync(join(tmpdir(), "urdd-edits-"));
after(() => rmSync(folder, { recursive: true, force: true }));
const { Lines, apply, changesOf, safeChanges } = await source("edits.ts");

/** A file of the page's sources, as a module of node. */
async function source(name) {
  const entryPoints = [new URL(`../src/${name}`, import.meta.url).pathname];
  const { outputFiles } = await build({ entryPoints, bundle: true, format: "esm", write: false });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}

const FILE = "robot.urdf";
const isFile = (file) => file === FILE;
const edit = (line, column, end_line, end_column, text, file = FILE) => ({
  file,
  line,
  column,
  end_line,
  end_column,
  text,
});
const fix = (...edits) => ({ message: "", is_safe: true, edits });

test("a place is a line and a code point of it, whatever ends the lines", () => {
  const texts = [
    "",
    "a",
    "ab\ncd\r\nef\rgh\n",
    "\u{1F916}a\u{1F916}\u{1F916}b\r\n\u{1F916}é\n\n\u{1F916}",
    "\r\r\n\n\r",
  ];
  for (const text of texts) {
    const lines = new Lines(text);
    let start = 0;
    for (const [k, line] of text.split(/(?<=\r\n|\n|\r(?!\n))/).entries()) {
      const chars = Array.from(line);
      for (let column = 1; column <= chars.length; column++) {
        const before = chars.slice(0, column - 1).join("").length;
        assert.equal(lines.offset(k + 1, column), start + before, JSON.stringify([text, k + 1, column]));
      }
      start += line.length;
    }
    assert.equal(lines.offset(1, Array.from(text).length + 1), text.length, "the end is a place");
    assert.equal(lines.offset(1, Array.from(text).length + 2), null);
    assert.equal(lines.offset(99, 1), null);
    assert.equal(lines.offset(0, 1), null);
    assert.equal(lines.offset(1, 0), null);
  }
});

test("changes replace parts, and of one inside another only the outer one counts", () => {
  const change = (from, to, insert) => ({ from, to, insert });
  assert.equal(apply("abcdef", [change(4, 5, "X"), change(0, 1, "")]), "bcdXf");
  assert.equal(apply("abcdef", [change(2, 3, "no"), change(1, 5, "-")]), "a-f");
  assert.equal(apply("abc", [change(3, 3, "!"), change(0, 0, "?")]), "?abc!");
});

test("a fix of another file, or of another text, changes nothing", () => {
  const lines = new Lines("ab\ncd");
  assert.deepEqual(changesOf(fix(edit(2, 1, 2, 2, "x")), lines, isFile), [{ from: 3, to: 4, insert: "x" }]);
  assert.equal(changesOf(fix(edit(2, 1, 2, 2, "x"), edit(1, 1, 1, 1, "x", "other.urdf")), lines, isFile), null);
  assert.equal(changesOf(fix(edit(3, 1, 3, 1, "x")), lines, isFile), null);
  assert.equal(changesOf(fix(edit(2, 2, 2, 1, "x")), lines, isFile), null, "it ends before it begins");
});

test("of two safe fixes that touch, the first wins; what is not safe is left out", () => {
  const lines = new Lines("abcdefgh");
  const at = (from, to, text) => ({ fixes: [fix(edit(1, from + 1, 1, to + 1, text))] });
  const made = (...places) => apply(lines.text, safeChanges(places, lines, isFile).flat());
  assert.equal(made(at(2, 4, "X"), at(4, 5, "Y"), at(5, 6, "Z")), "abXeZgh");
  assert.equal(made(at(3, 3, "X"), at(3, 3, "Y")), "abcXdefgh");
  assert.equal(made(at(5, 6, "X"), at(0, 1, "Y"), at(4, 5, "Z")), "YbcdeXgh");
  const unsafe = { fixes: [{ ...at(0, 1, "X").fixes[0], is_safe: false }, ...at(1, 2, "Y").fixes] };
  assert.equal(made(unsafe, {}, { fixes: [] }), "aYcdefgh");
});

for (const [name, text] of Object.entries({
  LF: FAULTY,
  CRLF: FAULTY.replaceAll("\n", "\r\n"),
  mixed: FAULTY.replace("\n", "\r\n"),
  "one line": FAULTY.replaceAll("\n", " "),
  "one hides others": FAULTY.replace("<material ", "<controller:x/><material "),
})) {
  test(`all safe fixes make what the program makes: ${name}`, () => {
    const file = join(folder, FILE);
    let mended = text;
    let [rounds, most] = [0, 0];
    for (; rounds < 10; rounds++) {
      writeFileSync(file, mended);
      const [{ findings }] = JSON.parse(run("lint", "--format", "json", file).stdout).urdds;
      const places = findings.flatMap(({ places }) => places);
      const fixes = safeChanges(places, new Lines(mended), isFile);
      if (fixes.length === 0) break;
      most = Math.max(most, fixes.length);
      mended = apply(mended, fixes.flat());
    }
    assert.ok(most >= 5 && rounds >= 2 && rounds < 10, `${rounds} rounds, ${most} fixes at once`);
    writeFileSync(file, text);
    run("lint", "--fix", file);
    assert.equal(mended, readFileSync(file, "utf8"));
  });
}
