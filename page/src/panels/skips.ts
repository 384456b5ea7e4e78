/** Links by links: which pairs collision checks skip, and why. */

import type { App } from "../app";
import { SHAPE_KINDS } from "../engine/protocol";
import type { ShapeKind, SkipsAnswer } from "../engine/protocol";
import type { RobotModel } from "../model";
import { fill, h } from "../ui/dom";
import { count, name } from "../ui/format";
import { SHAPE_NAMES } from "./proximity";

/** Letters of `wasm/src/pairs.rs`, in the order of the specification. */
export const REASONS = new Map([
  ["s", "same link"],
  ["a", "always in contact"],
  ["j", "adjacent"],
  ["d", "in contact at rest"],
  ["n", "never in contact"],
  ["-", "sometimes in contact"],
  ["?", "no reason given"],
]);

const SIDE = 340;

export function skips(app: App): HTMLElement {
  const kind = h(
    "select",
    { "aria-label": "Shapes" },
    ...SHAPE_KINDS.map((shapes) => h("option", { value: shapes }, SHAPE_NAMES[shapes])),
  );
  kind.value = "hulls";
  const canvas = h("canvas", { class: "matrix", tabindex: "0", role: "img", "aria-label": "Skips of pairs of links" });
  const legend = h("div", { class: "legend" });
  const said = h("p", { class: "hint", "aria-live": "polite" });
  const edits = h("div", {});
  const empty = h("p", { class: "empty" });
  const panel = h(
    "div",
    { class: "panel" },
    h("div", { class: "headline" }, h("h2", {}, "Skipped pairs"), kind),
    canvas,
    said,
    legend,
    edits,
    empty,
  );
  kind.addEventListener("change", () => {
    void app.loadSkips(kind.value as ShapeKind);
  });
  const render = (): void => {
    const {
      skips: { answer, error },
      robot,
      pair,
    } = app.store.now;
    const has = robot !== null && answer !== null && answer.places.length > 0;
    canvas.hidden = !has;
    legend.hidden = !has;
    empty.hidden = has;
    empty.textContent = error
      ? `There are no skips to show: ${error}`
      : has
        ? ""
        : answer
          ? "This robot has no shapes, and so no pairs."
          : "";
    if (!has) {
      fill(edits);
      return;
    }
    draw(canvas, answer, pair);
    fill(
      legend,
      ...[...REASONS].flatMap(([letter, text]) => {
        const n = tally(answer, letter);
        return n > 0
          ? [
              h(
                "span",
                { class: `key reason-${letter === "-" ? "none" : letter === "?" ? "open" : letter}` },
                `${text} (${n.toLocaleString("en")})`,
              ),
            ]
          : [];
      }),
    );
    said.textContent = summary(answer);
    fill(edits, ...listed(answer));
  };
  const under = (event: PointerEvent): [number, number] | null => {
    const { answer } = app.store.now.skips;
    if (!answer) return null;
    const box = canvas.getBoundingClientRect();
    const n = answer.places.length;
    const [i, j] = [
      Math.floor(((event.clientY - box.top) / box.height) * n),
      Math.floor(((event.clientX - box.left) / box.width) * n),
    ];
    return i >= 0 && j >= 0 && i < n && j < n ? [i, j] : null;
  };
  canvas.addEventListener("pointermove", (event) => {
    const at = under(event);
    const {
      robot,
      skips: { answer },
    } = app.store.now;
    if (at && robot && answer) said.textContent = words(robot, answer, at);
  });
  canvas.addEventListener("pointerleave", () => {
    const { answer } = app.store.now.skips;
    if (answer) said.textContent = summary(answer);
  });
  canvas.addEventListener("pointerdown", (event) => {
    const at = under(event);
    const { answer } = app.store.now.skips;
    const [a, b] = [answer?.places[at?.[0] ?? -1], answer?.places[at?.[1] ?? -1]];
    if (a && b) app.store.set({ pair: [a, b] });
  });
  app.store.on(["skips", "robot", "pair"], render);
  addEventListener("urdd-theme", render);
  app.store.on(["tab", "robot"], ({ tab, robot, skips: { answer, error } }) => {
    if (tab === "Skips" && robot && !answer && !error) void app.loadSkips(kind.value as ShapeKind);
  });
  return panel;
}

function letterAt(answer: SkipsAnswer, i: number, j: number): string {
  return answer.reasons?.[i]?.[j] ?? (i === j ? "s" : "?");
}

function isSkipped(answer: SkipsAnswer, i: number, j: number): boolean {
  return answer.skipped[i]?.[j] === "1";
}

function tally(answer: SkipsAnswer, letter: string): number {
  let n = 0;
  for (let i = 0; i < answer.places.length; i++) {
    for (let j = i + 1; j < answer.places.length; j++) if (letterAt(answer, i, j) === letter) n++;
  }
  return n;
}

function summary(answer: SkipsAnswer): string {
  let n = 0;
  const all = (answer.places.length * (answer.places.length - 1)) / 2;
  for (let i = 0; i < answer.places.length; i++) {
    for (let j = i + 1; j < answer.places.length; j++) if (isSkipped(answer, i, j)) n++;
  }
  return `${n.toLocaleString("en")} of ${count(all, "pair")} are skipped.`;
}

function words(robot: RobotModel, answer: SkipsAnswer, [i, j]: [number, number]): string {
  const of = (k: number): string => {
    const [link, piece] = answer.places[k] ?? [0, 0];
    return name(robot.links[link]?.name ?? "") + (answer.shapes.startsWith("piece") ? ` piece ${piece}` : "");
  };
  const reason = REASONS.get(letterAt(answer, i, j)) ?? "";
  return `${of(i)} · ${of(j)}: ${reason}, ${isSkipped(answer, i, j) ? "skipped" : "checked"}`;
}

function listed(answer: SkipsAnswer): Node[] {
  if (!answer.edits || answer.edits.length === 0) return [];
  return [
    h("h2", {}, "Edits"),
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
  ];
}

function draw(canvas: HTMLCanvasElement, answer: SkipsAnswer, pair: [[number, number], [number, number]] | null): void {
  const n = answer.places.length;
  const ratio = Math.min(window.devicePixelRatio, 2);
  const side = Math.round(SIDE * ratio);
  canvas.width = side;
  canvas.height = side;
  const context = canvas.getContext("2d");
  if (!context) return;
  const style = getComputedStyle(canvas);
  const color = (key: string): string => style.getPropertyValue(`--reason-${key}`);
  const colors = new Map(
    [...REASONS.keys()].map((letter) => [letter, color(letter === "-" ? "none" : letter === "?" ? "open" : letter)]),
  );
  const cell = side / n;
  const gap = cell > 6 ? 1 : 0;
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      context.globalAlpha = isSkipped(answer, i, j) ? 1 : 0.3;
      context.fillStyle = colors.get(letterAt(answer, i, j)) ?? "#888";
      context.fillRect(j * cell, i * cell, Math.max(cell - gap, 0.5), Math.max(cell - gap, 0.5));
    }
  }
  context.globalAlpha = 1;
  if (pair) {
    const index = ([link, piece]: [number, number]): number =>
      answer.places.findIndex(([l, p]) => l === link && (p === piece || !answer.shapes.startsWith("piece")));
    const [i, j] = [index(pair[0]), index(pair[1])];
    if (i >= 0 && j >= 0) {
      context.strokeStyle = style.getPropertyValue("--text");
      context.lineWidth = Math.max(2, ratio * 1.5);
      for (const [a, b] of [
        [i, j],
        [j, i],
      ] as const)
        context.strokeRect(b * cell, a * cell, cell, cell);
    }
  }
}
