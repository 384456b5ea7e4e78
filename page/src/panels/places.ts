/** Places in files: what they name, what is said there, the fixes of it, and a click shows the text. */

import type { App } from "../app";
import { linkOf } from "../findings";
import type { Place } from "../findings";
import { fixesOf, isDraft, mend } from "../fixes";
import { button, fill, h, prose } from "../ui/dom";
import { message, count, name } from "../ui/format";
import { keep, keyed } from "../ui/opened";

/** Number of places shown at first, and added by each click. */
const SHOWN = 5;
const MORE = 50;

/** The places of something that was found at `of` places, of which these are in the report; `what` is the key of what is open of it. */
export function placeList(app: App, what: string, all: readonly Place[], of: number): HTMLElement {
  const { opened } = app.store.now;
  const list = h("ul", { class: "places" });
  const more = button("", { class: "tiny" }, () => {
    show(shown + MORE);
    opened.set(what, shown);
  });
  const last = h("li", {}, more);
  let shown = 0;
  const show = (n: number): void => {
    for (const [key, place] of withKeys(what, all.slice(0, n)).slice(shown)) last.before(placeRow(app, key, place));
    shown = Math.min(n, all.length);
    const left = all.length - shown;
    more.hidden = left === 0;
    more.textContent = `Show ${Math.min(left, MORE)} more of ${count(of, "place")}`;
    const cut = of - all.length;
    last.hidden = left === 0 && cut <= 0;
    if (left === 0 && cut > 0)
      fill(
        last,
        h("span", { class: "hint" }, `${count(cut, "place")} more ${cut === 1 ? "is" : "are"} not in the report`),
      );
  };
  list.append(last);
  show(opened.get(what) ?? SHOWN);
  return list;
}

/** Places with their keys, by what they name: their lines change as a file is written. */
function withKeys(what: string, all: readonly Place[]): [string, Place][] {
  return keyed(all, ({ file, subject, pointer }) => [what, file, subject, pointer].join("\n"));
}

function placeRow(app: App, key: string, place: Place): HTMLElement {
  const { robot, opened, draft } = app.store.now;
  const link = robot ? linkOf(robot, place) : null;
  const related = withKeys(key, place.related);
  const macro = place.written_at?.macro_name;
  const isInDraft = draft !== null && place.line !== null && isDraft(draft, place.file);
  const fixes = fixesOf(draft, place);
  const fix = fixes.length === 0 ? place.fixes?.[0] : undefined;
  const where = place.file ? `${place.file}${place.line ? `:${place.line}` : ""}` : null;
  const texts = [place.subject, where, place.pointer].filter((text): text is string => Boolean(text));
  const text = h("div", { class: "excerpt", hidden: true });
  const label = prose(name(texts[0] ?? "the robot as a whole"));
  const go = button(label, { class: "place", title: texts.map(name).join("\n") }, () => {
    // Links are numbered anew in another version of the robot.
    if (link !== null && app.store.now.robot === robot) app.select({ kind: "link", index: link });
    if (isInDraft) app.store.set({ tab: "Text", textAt: { line: place.line ?? 1, column: place.column } });
    else if (place.file !== null && place.line !== null) toggle(place.file, place.line);
  });
  const toggle = (path: string, line: number): void => {
    text.hidden = !text.hidden;
    go.setAttribute("aria-expanded", String(!text.hidden));
    keep(opened, key, !text.hidden);
    if (!text.hidden && text.childElementCount === 0) void showText(app, path, line, place.column, text);
  };
  if (place.line !== null && !isInDraft) go.setAttribute("aria-expanded", "false");
  if (opened.has(key) && !isInDraft && place.file !== null && place.line !== null) toggle(place.file, place.line);
  if (link === null && place.line === null) go.disabled = true;
  return h(
    "li",
    {},
    go,
    place.subject && where && h("span", { class: "kind" }, ` ${name(where)}`),
    macro && h("span", { class: "kind" }, ` in the macro ${name(macro)}`),
    place.message && h("span", { class: "what" }, ...prose(name(place.message))),
    fix &&
      h(
        "span",
        { class: "what" },
        ...prose(`Fix: ${name(fix.message)}${fix.is_safe ? "; `urdd lint --fix` does it" : ""}`),
      ),
    fixes.length > 0 && h("div", { class: "actions" }, ...fixes.map((fix) => fixButton(fix, () => mend(app, fix)))),
    (place.expected ?? place.actual) !== null &&
      h(
        "dl",
        {},
        place.expected !== null && h("dt", {}, "expected"),
        place.expected !== null && h("dd", {}, name(place.expected)),
        place.actual !== null && h("dt", {}, "found"),
        place.actual !== null && h("dd", {}, name(place.actual)),
      ),
    place.related.length > 0 &&
      h("ul", { class: "places" }, ...related.map(([key, other]) => placeRow(app, key, other))),
    text,
  );
}

/** The text of a file in the report. */
async function textOf(app: App, path: string): Promise<string> {
  const { report } = app.store.now.report;
  const urdd = report?.urdds[0];
  if (urdd?.kind !== "urdf") return new TextDecoder().decode(await app.engine.ask("file", { path }));
  if (urdd.path !== path || !report?.text) throw new Error("the page does not have this file");
  return report.text;
}

/** Shows the lines around a place. */
async function showText(app: App, path: string, line: number, column: number | null, into: HTMLElement): Promise<void> {
  try {
    const found = excerpt(await textOf(app, path), line, column);
    if (!found) throw new Error("the file no longer has this line");
    fill(
      into,
      ...found.map(({ number, text, isPlace }) =>
        h(
          "div",
          { class: isPlace ? "line at" : "line" },
          h("span", { class: "number" }, String(number)),
          h("code", {}, name(text)),
        ),
      ),
    );
  } catch (error) {
    fill(into, h("p", { class: "hint" }, `The text cannot be shown: ${message(error)}`));
  }
}

/** A button that makes a fix. */
export function fixButton({ message, is_safe }: { message: string; is_safe: boolean }, click: () => void): HTMLElement {
  const title = is_safe
    ? "Has one right answer: `urdd lint --fix` does it"
    : "One way to mend it: `urdd lint --fix` leaves it to you";
  return button([is_safe ? "Fix: " : "Possible fix: ", ...prose(name(message))], { class: "fix", title }, click);
}

/** Number of lines before and after, and maximum number of characters of a line. */
const AROUND = 2;
const WIDTH = 160;

/** A few lines around a position, which count from 1, columns in characters. Null if the text has no such line. */
function excerpt(
  text: string,
  line: number,
  column: number | null,
): { number: number; text: string; isPlace: boolean }[] | null {
  const all = text.split(/\r\n|\n|\r/);
  if (line < 1 || line > all.length) return null;
  const first = Math.max(1, line - AROUND);
  const lines = all.slice(first - 1, line + AROUND).map((text, k) => {
    const isPlace = first + k === line;
    return { number: first + k, text: cut(text, isPlace ? (column ?? 1) : 1), isPlace };
  });
  while (lines.at(-1)?.text === "" && lines.at(-1)?.isPlace === false) lines.pop();
  return lines;
}

/** The part of a long line around a column: a document can be a single line. */
function cut(text: string, column: number): string {
  const chars = Array.from(text);
  if (chars.length <= WIDTH) return text;
  const start = Math.max(0, Math.min(column - 1 - WIDTH / 4, chars.length - WIDTH));
  const end = start + WIDTH;
  return (start > 0 ? "…" : "") + chars.slice(start, end).join("") + (end < chars.length ? "…" : "");
}
