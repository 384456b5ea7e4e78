/** The matrix of skipped pairs with their reasons, and the user's edits. */

import type { App } from "../app";
import { SHAPE_KINDS } from "../engine/protocol";
import type { ShapeKind, SkipEdit, SkipsAnswer } from "../engine/protocol";
import type { RobotModel } from "../model";
import { decide, download, isOf, isSkipped, letterAt, load, save, undo } from "../skips";
import type { Pair } from "../state";
import { button, cut, fill, h } from "../ui/dom";
import { count, name } from "../ui/format";
import { SHAPE_NAMES, skipNearer } from "./proximity";
import { at, draw, isAt, REASONS, reasonClass, region } from "./skip_matrix";

/** Maximum number of rows with names. */
const MAX_LABELS = 17;

export function skips(app: App): HTMLElement {
  /** The two links whose pieces are shown, one level down. */
  let down: [number, number] | null = null;
  const kind = h(
    "select",
    { "aria-label": "Shapes" },
    ...SHAPE_KINDS.map((shapes) => h("option", { value: shapes }, SHAPE_NAMES[shapes])),
  );
  kind.value = "hulls";
  const canvas = h("canvas", {
    class: "matrix",
    tabindex: "0",
    role: "application",
    "aria-label": "Skips of pairs of shapes; arrow keys move",
  });
  // At the top, where they do not move when the content changes.
  const up = button("Links", { class: "tiny", "aria-pressed": "true" }, () => {
    down = null;
    reload("hulls");
  });
  const into = button(
    "Its pieces",
    { class: "tiny", "aria-pressed": "false", title: "The pieces of the chosen pair of links" },
    () => {
      const { pair } = app.store.now;
      if (!pair) return;
      down = [pair[0][0], pair[1][0]];
      reload("pieces");
    },
  );
  const legend = h("div", { class: "legend" });
  const said = h("p", { class: "hint said", "aria-live": "polite" });
  const chosen = h("div", {});
  const edits = h("div", {});
  const empty = h("p", { class: "empty" });
  const headline = h(
    "div",
    { class: "headline" },
    h("h2", {}, "Skipped pairs"),
    h("span", { class: "spring" }),
    h("span", { class: "segments level", role: "group", "aria-label": "Level" }, up, into),
    kind,
  );
  const labels = h("div", { class: "labels", "aria-hidden": "true" });
  const columns = h("div", { class: "labels columns-of", "aria-hidden": "true" });
  const matrix = h("div", { class: "matrix-box" }, columns, labels, canvas);
  const panel = h("div", { class: "panel" }, headline, matrix, said, legend, chosen, edits, empty);
  const reload = (shapes: ShapeKind): void => {
    kind.value = shapes;
    void load(app, shapes);
  };
  kind.addEventListener("change", () => {
    down = null;
    reload(kind.value as ShapeKind);
  });
  const render = (): void => {
    const { skips: state, robot, pair } = app.store.now;
    const { answer, error } = state;
    const has = robot !== null && answer !== null && answer.places.length > 0;
    for (const element of [matrix, legend, said]) element.hidden = !has;
    up.setAttribute("aria-pressed", String(down === null));
    into.setAttribute("aria-pressed", String(down !== null));
    into.disabled = pair === null;
    empty.hidden = has;
    empty.textContent = error
      ? `The skips cannot be shown: ${error}`
      : answer && !has
        ? "This robot has no shapes, so there are no pairs."
        : "";
    fill(chosen);
    fill(edits);
    if (!has) return;
    const shown = region(answer, down);
    const named = shown.rows.length <= MAX_LABELS;
    const across = shown.columns.length <= MAX_LABELS;
    labels.hidden = !named;
    columns.hidden = !across;
    fill(labels, ...(named ? shown.rows.map((shape) => label(robot, answer, shape, pair)) : []));
    fill(columns, ...(across ? shown.columns.map((shape) => label(robot, answer, shape, pair)) : []));
    draw(canvas, answer, shown, pair);
    fill(
      legend,
      ...[...REASONS].flatMap(([letter, text]) => {
        const n = tally(answer, (i, j) => letterAt(answer, i, j) === letter);
        return n > 0
          ? [h("span", { class: `key reason-${reasonClass(letter)}` }, `${text} (${n.toLocaleString("en")})`)]
          : [];
      }),
      h("span", { class: "hint" }, "Strong: skipped. Pale: checked."),
    );
    said.textContent = standing();
    if (pair) fill(chosen, ...decision(app, robot, answer, pair));
    fill(edits, ...listed(app, answer));
  };
  /** A summary of the selected pair, or of all pairs. */
  const standing = (): string => {
    const { skips: state, robot, pair } = app.store.now;
    if (!state.answer || !robot) return "";
    const at = pair && shapesOf(state.answer, pair);
    return at ? words(robot, state.answer, at) : summary(state.answer);
  };
  const under = (event: PointerEvent): [number, number] | null => {
    const { answer } = app.store.now.skips;
    const box = canvas.getBoundingClientRect();
    return (
      answer && at(region(answer, down), (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height)
    );
  };
  const choose = (answer: SkipsAnswer, i: number, j: number): void => {
    const [a, b] = [answer.places[i], answer.places[j]];
    if (a && b) app.store.set({ pair: [a, b] });
  };
  canvas.addEventListener("pointermove", (event) => {
    const place = under(event);
    const {
      robot,
      skips: { answer },
    } = app.store.now;
    if (place && robot && answer) said.textContent = words(robot, answer, place);
  });
  canvas.addEventListener("pointerleave", () => {
    said.textContent = standing();
  });
  canvas.addEventListener("pointerdown", (event) => {
    const place = under(event);
    const { answer } = app.store.now.skips;
    if (place && answer) choose(answer, ...place);
  });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key];
    const {
      skips: { answer },
      pair,
      robot,
    } = app.store.now;
    if (!step || !answer || !robot) return;
    event.preventDefault();
    const { rows, columns } = region(answer, down);
    const index = (list: number[], shape: [number, number] | undefined): number =>
      Math.max(
        0,
        list.findIndex((k) => answer.places[k]?.[0] === shape?.[0] && answer.places[k]?.[1] === shape?.[1]),
      );
    const i = rows[index(rows, pair?.[0]) + (step[0] ?? 0)];
    const j = columns[index(columns, pair?.[1]) + (step[1] ?? 0)];
    if (i === undefined || j === undefined) return;
    choose(answer, i, j);
    said.textContent = words(robot, answer, [i, j]);
  });
  app.store.on(["skips", "robot", "pair"], render);
  addEventListener("urdd-theme", render);
  app.store.on(["robot"], () => {
    down = null;
  });
  app.store.on(["tab", "robot"], ({ tab, robot, skips: { answer, error } }) => {
    if (tab === "Skips" && robot && !answer && !error) void load(app, kind.value as ShapeKind);
  });
  return panel;
}

/** The name beside a row. */
function label(robot: RobotModel, answer: SkipsAnswer, shape: number, pair: Pair | null): HTMLElement {
  const [link, piece] = answer.places[shape] ?? [0, 0];
  const text = name(robot.nameOf(link));
  const chosen = pair?.some((one) => isAt(answer, shape, one));
  return h(
    "span",
    { class: chosen ? "cut chosen" : "cut", title: text },
    ...cut(answer.kind.startsWith("piece") ? `${text} ${piece}` : text),
  );
}

function tally(answer: SkipsAnswer, counts: (i: number, j: number) => boolean): number {
  let n = 0;
  for (let i = 0; i < answer.places.length; i++) {
    for (let j = i + 1; j < answer.places.length; j++) if (counts(i, j)) n++;
  }
  return n;
}

function summary(answer: SkipsAnswer): string {
  const skipped = tally(answer, (i, j) => isSkipped(answer, i, j));
  const all = (answer.places.length * (answer.places.length - 1)) / 2;
  return `${skipped.toLocaleString("en")} of ${count(all, "pair")} are skipped.`;
}

function words(robot: RobotModel, answer: SkipsAnswer, [i, j]: [number, number]): string {
  const of = (k: number): string => {
    const [link, piece] = answer.places[k] ?? [0, 0];
    return name(robot.nameOf(link)) + (answer.kind.startsWith("piece") ? ` piece ${piece}` : "");
  };
  const reason = REASONS.get(letterAt(answer, i, j)) ?? "";
  return `${of(i)} · ${of(j)}: ${reason}, ${isSkipped(answer, i, j) ? "skipped" : "checked"}`;
}

/** The row and the column of a pair of shapes. */
function shapesOf(answer: SkipsAnswer, pair: Pair): [number, number] | null {
  const [i = -1, j = -1] = pair.map((one) => answer.places.findIndex((_, shape) => isAt(answer, shape, one)));
  return i < 0 || j < 0 ? null : [i, j];
}

/** The reasons of pairs of shapes with their counts, and the last edit. */
function whys(answer: SkipsAnswer, pairs: [number, number][], links: [string, string]): string {
  const reasons = new Map<string, number>();
  for (const [i, j] of pairs) {
    const text = REASONS.get(letterAt(answer, i, j)) ?? "no reason given";
    reasons.set(text, (reasons.get(text) ?? 0) + 1);
  }
  const edit = answer.edits?.filter((edit) => isOf(edit, links)).at(-1);
  const found = [...reasons].map(([text, n]) => (pairs.length > 1 ? `${text} (${n.toLocaleString("en")})` : text));
  const decided = edit && `edited: ${edit.skip ? "skip" : "check"}${edit.reason ? `, ${name(edit.reason)}` : ""}`;
  return [found.join(", "), decided].filter(Boolean).join("; ");
}

/** The possible edits of the selected pair of links. */
function decision(app: App, robot: RobotModel, answer: SkipsAnswer, pair: Pair): Node[] {
  const links: [number, number] = [pair[0][0], pair[1][0]];
  const [a, b] = links.map((link) => robot.nameOf(link)) as [string, string];
  const pairs = answer.places.flatMap(([first], i) =>
    answer.places.flatMap(([second], j): [number, number][] =>
      first === links[0] && second === links[1] && i !== j ? [[i, j]] : [],
    ),
  );
  const skipped = pairs.filter(([i, j]) => isSkipped(answer, i, j)).length;
  const state =
    pairs.length === 0
      ? "no pair"
      : skipped === pairs.length
        ? "skipped"
        : skipped === 0
          ? "checked"
          : `${skipped} of ${pairs.length} skipped`;
  const title = [
    h("h2", {}, `${name(a)} · ${name(b)}: ${state}`),
    h("p", { class: "why" }, `Reason: ${whys(answer, pairs, [a, b])}`),
  ];
  if (answer.edits === null)
    return [...title, h("p", { class: "hint" }, "A legacy URDD has no edits: generate a new URDD to edit skips.")];
  if (links[0] === links[1])
    return [...title, h("p", { class: "hint" }, "Shapes of one link are never checked against each other.")];
  const reason = h("input", {
    type: "text",
    placeholder: "Reason (saved with the edit)",
    "aria-label": "Reason",
    maxlength: 10000,
  });
  const say = (skip: boolean): SkipEdit => ({ link_a: a, link_b: b, skip, reason: reason.value.trim() });
  return [
    ...title,
    reason,
    h(
      "div",
      { class: "actions" },
      button("Skip", "All pairs of shapes of these two links", () => void decide(app, [say(true)])),
      button("Check", "All pairs of shapes of these two links", () => void decide(app, [say(false)])),
      ...skipNearer(app, links, () => reason.value.trim()),
    ),
  ];
}

function listed(app: App, answer: SkipsAnswer): Node[] {
  const { skips: state, robot } = app.store.now;
  if (!answer.edits || !robot) return [];
  const canUndo = state.before.length > 0 || state.saved > 0;
  const back = button(
    state.before.length > 0 || state.saved === 0 ? "Undo" : "Undo the save",
    {},
    () => void undo(app),
  );
  back.disabled = !canUndo;
  const writable = robot.entry.writable && app.site.mode === "live";
  const keep = writable
    ? button("Save", { class: "main" }, () => void save(app))
    : button("Download the files", { class: "main" }, () => download(app));
  keep.disabled = !state.dirty;
  return [
    h("h2", {}, state.dirty ? "Edits, not saved yet" : "Edits"),
    answer.edits.length === 0 &&
      h("p", { class: "hint" }, "None: skips follow from the reasons. Click a pair to edit it."),
    h(
      "ul",
      { class: "notes" },
      ...answer.edits.map((edit) =>
        h(
          "li",
          {},
          `${name(edit.link_a)} · ${name(edit.link_b)}: ${edit.skip ? "skip" : "check"}${edit.reason ? `, ${name(edit.reason)}` : ""}`,
        ),
      ),
    ),
    h("div", { class: "actions" }, back, keep),
    !writable &&
      state.dirty &&
      h(
        "p",
        { class: "hint" },
        robot.entry.here
          ? "Save… at the top writes them into the URDD."
          : robot.entry.temporary
            ? "This URDD is temporary. Save it with Save… at the top: then edits can be saved in its folder."
            : "This page cannot write the URDD: it is from a site or an archive.",
      ),
  ].filter((node) => node !== false);
}
