/** The nearest pairs, as they are now and relative to the mean, and whether the robot collides. */

import type { App } from "../app";
import { SHAPE_KINDS } from "../engine/protocol";
import type { PairDistance, ProximityAnswer, ShapeKind, SkipEdit, Statistics } from "../engine/protocol";
import { decide, nearer } from "../skips";
import { cut, fill, h } from "../ui/dom";
import { length, name, percent } from "../ui/format";
import type { Pair } from "../state";
import { learnedLine } from "./learned";

export const SHAPE_NAMES: Record<ShapeKind, string> = {
  hulls: "hulls",
  pieces: "pieces",
  boxes: "boxes",
  spheres: "spheres",
  "piece-boxes": "boxes of pieces",
  "piece-spheres": "spheres of pieces",
};

interface Row {
  element: HTMLButtonElement;
  show: (pair: PairDistance, widest: number, chosen: boolean) => void;
}

export function proximity(app: App): HTMLElement {
  const kind = h(
    "select",
    { "aria-label": "Shapes that distances are between" },
    ...SHAPE_KINDS.map((shapes) => h("option", { value: shapes }, SHAPE_NAMES[shapes])),
  );
  kind.addEventListener("change", () => {
    app.useShapes(kind.value as ShapeKind);
  });
  const order = h(
    "select",
    { "aria-label": "Order" },
    h("option", { value: "distance" }, "by distance"),
    h("option", { value: "relative" }, "by share of mean"),
  );
  order.addEventListener("change", () => {
    render();
  });
  const state = h("p", { class: "collision", "aria-live": "polite" });
  const learned = learnedLine();
  const list = h("div", { class: "pairs" });
  const detail = h("div", { class: "detail" });
  const empty = h("p", { class: "empty" });
  const panel = h(
    "div",
    { class: "panel" },
    h("div", { class: "headline choices" }, kind, order),
    h(
      "div",
      { class: "headline" },
      state,
      h("span", { class: "spring" }),
      h("span", { class: "hint" }, "distance · of mean"),
    ),
    learned.element,
    empty,
    list,
    detail,
  );
  const rows: Row[] = [];
  const render = (): void => {
    const { robot, proximity, pair, shapes } = app.store.now;
    const { answer, error } = proximity;
    const found = answer?.nearest.slice() ?? [];
    if (order.value === "relative") found.sort((a, b) => (a.relative ?? Infinity) - (b.relative ?? Infinity));
    const widest = Math.max(...found.map((pair) => pair.statistics?.max ?? pair.distance), 1e-9);
    while (rows.length < found.length) {
      const made = row(app);
      rows.push(made);
      list.append(made.element);
    }
    rows.forEach(({ element, show }, k) => {
      const at = found[k];
      element.hidden = !at;
      if (at) show(at, widest, same(pair, pairOf(at)));
    });
    if (kind.value !== shapes) kind.value = shapes;
    state.textContent = answer ? (answer.in_collision ? "In collision with itself" : "No self-collision") : "";
    state.className = `collision ${answer ? (answer.in_collision ? "bad" : "good") : ""}`;
    learned.show(answer);
    empty.hidden = found.length > 0;
    empty.textContent = said(error, answer, robot !== null);
    selected(app, detail, found.find((at) => same(pair, pairOf(at))) ?? null, answer);
  };
  app.store.on(["robot", "proximity", "pair", "shapes", "skips"], render);
  app.store.on(["tab"], ({ tab, proximity: { answer } }) => {
    if (tab === "Proximity" && !answer) app.measure(true);
  });
  return panel;
}

function said(error: string | null, answer: ProximityAnswer | null, open: boolean): string {
  if (error) return `Distances cannot be computed: ${error}`;
  if (answer) return answer.pairs === 0 ? "Every pair of shapes is skipped: there is nothing to measure." : "";
  return open ? "Reading shapes…" : "";
}

export function pairOf(pair: PairDistance): Pair {
  return [
    [pair.link_idxs[0], pair.pieces[0]],
    [pair.link_idxs[1], pair.pieces[1]],
  ];
}

export function same(a: Pair | null, b: Pair | null): boolean {
  return a !== null && b !== null && a.flat().every((x, k) => x === b.flat()[k]);
}

/** A row that is used again for another pair. */
function row(app: App): Row {
  const sides = [h("span", { class: "name cut" }), h("span", { class: "name cut" })] as const;
  const distance = h("span", { class: "distance" });
  const relative = h("span", { class: "relative" });
  const said = h("span", { class: "said-of" });
  const range = h("span", { class: "range" });
  const mark = h("span", { class: "mark" });
  const bar = h("span", { class: "gauge" }, range, mark);
  const element = h("button", { type: "button", class: "pair" }, sides[0], distance, relative, sides[1], said, bar);
  let current: PairDistance | null = null;
  element.addEventListener("click", () => {
    if (!current) return;
    const pair = pairOf(current);
    app.store.set({ pair: same(app.store.now.pair, pair) ? null : pair });
  });
  return {
    element,
    show(pair, widest, chosen) {
      current = pair;
      const ofPieces = app.store.now.shapes.startsWith("piece");
      sides.forEach((side, k) => {
        const link = name(pair.links[k] ?? "");
        const text = ofPieces ? `${link} · ${pair.pieces[k] ?? 0}` : link;
        if (side.textContent !== text) {
          fill(side, ...cut(text));
          side.title = ofPieces ? `piece ${pair.pieces[k] ?? 0} of ${link}` : link;
        }
      });
      distance.textContent = pair.distance <= 0 ? "0 mm" : length(pair.distance);
      relative.textContent = pair.relative === null ? "–" : percent(pair.relative);
      said.textContent = [
        pair.distance <= 0 ? "contact" : "",
        isDecided(app.store.now.skips.answer?.edits, pair.links) ? "to be skipped" : "",
      ]
        .filter(Boolean)
        .join(" · ");
      element.classList.toggle("contact", pair.distance <= 0);
      element.setAttribute("aria-pressed", String(chosen));
      gauge(bar, range, mark, pair.distance, pair.statistics, widest);
    },
  };
}

function gauge(
  bar: HTMLElement,
  range: HTMLElement,
  mark: HTMLElement,
  now: number,
  statistics: Statistics | null,
  widest: number,
): void {
  bar.hidden = !statistics;
  if (!statistics) return;
  const share = (value: number): number => Math.max(0, Math.min(100, (100 * value) / widest));
  range.style.left = `${share(statistics.min)}%`;
  range.style.width = `${Math.max(0.5, share(statistics.max) - share(statistics.min))}%`;
  mark.style.left = `${share(now)}%`;
}

function act(text: string, title: string, does: () => Promise<void>): Node {
  return h("button", { type: "button", title, click: () => void does() }, text);
}

/** Whether a decision that is not saved yet skips these links. */
function isDecided(edits: readonly SkipEdit[] | null | undefined, [a, b]: [string, string]): boolean {
  const [last] = (edits ?? [])
    .filter((edit) => (edit.link_a === a && edit.link_b === b) || (edit.link_a === b && edit.link_b === a))
    .slice(-1);
  return last?.skip ?? false;
}

function selected(app: App, detail: HTMLElement, pair: PairDistance | null, answer: ProximityAnswer | null): void {
  const statistics = pair?.statistics;
  if (!pair) {
    fill(detail);
    return;
  }
  const samples = answer?.num_samples;
  fill(
    detail,
    h("h2", {}, `${pair.links.map(name).join(" · ")}${samples ? `, ${samples.toLocaleString("en")} samples` : ""}`),
    statistics
      ? h(
          "dl",
          {},
          h("dt", {}, "min · mean · max"),
          h("dd", {}, [statistics.min, statistics.mean, statistics.max].map((x) => length(x)).join(" · ")),
        )
      : h("p", { class: "hint" }, "The URDD records no statistics of this pair."),
    h(
      "div",
      { class: "actions" },
      act("Skip this pair", "Collision checks leave these two links out, once it is saved in Skips", () =>
        decide(app, [{ link_a: pair.links[0], link_b: pair.links[1], skip: true, reason: "" }]),
      ),
      act("Skip all nearer", "Every pair of links that is nearer than this one now", () =>
        nearer(app, pair.link_idxs, "distance", ""),
      ),
      act("Skip all relatively nearer", "Every pair of links whose distance is a smaller share of its mean", () =>
        nearer(app, pair.link_idxs, "relative", ""),
      ),
      h(
        "button",
        {
          type: "button",
          click: () => {
            app.store.set({ tab: "Skips" });
          },
        },
        "See its skip",
      ),
      h(
        "button",
        {
          type: "button",
          click: () => {
            const keep = new Set(pair.link_idxs);
            app.hide(app.store.now.robot?.links.keys() ?? [], true);
            app.hide(keep, false);
          },
        },
        "Show only these",
      ),
      h(
        "button",
        {
          type: "button",
          click: () => {
            app.store.set({ pair: null });
            app.hide(app.store.now.robot?.links.keys() ?? [], false);
          },
        },
        "Show all",
      ),
    ),
  );
}
