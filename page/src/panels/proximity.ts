/** The nearest pairs, with distances and distances relative to the mean, and whether the robot collides. */

import type { App } from "../app";
import { byLinks, isContact } from "../contacts";
import type { LinkPair } from "../contacts";
import { SHAPE_KINDS } from "../engine/protocol";
import type { PairDistance, ProximityAnswer, ShapeKind, SkipEdit, Statistics, Learned, Rate } from "../engine/protocol";
import { decide, isOf, nearer } from "../skips";
import type { Pair } from "../state";
import { button, cut, fill, h } from "../ui/dom";
import { count, length, name, percent } from "../ui/format";
import { keep } from "../ui/opened";

export const SHAPE_NAMES: Record<ShapeKind, string> = {
  hulls: "hulls",
  pieces: "pieces",
  boxes: "boxes",
  spheres: "spheres",
  "piece-boxes": "boxes of pieces",
  "piece-spheres": "spheres of pieces",
};

/** The list is of links; their pieces are one level down. */
interface LinkRow {
  element: HTMLElement;
  show: (pair: LinkPair, widest: number, chosen: Pair | null, open: boolean) => void;
}

export function proximity(app: App): HTMLElement {
  const kind = h(
    "select",
    { "aria-label": "Kind of shapes" },
    ...SHAPE_KINDS.map((shapes) => h("option", { value: shapes }, SHAPE_NAMES[shapes])),
  );
  kind.addEventListener("change", () => app.useShapes(kind.value as ShapeKind));
  const order = h(
    "select",
    { "aria-label": "Order" },
    h("option", { value: "distance" }, "by distance"),
    h("option", { value: "relative" }, "relative to mean"),
  );
  order.addEventListener("change", () => render());
  const state = h("p", { class: "collision", "aria-live": "polite" });
  const learned = learnedLine();
  const list = h("div", { class: "pairs" });
  const detail = h("div", { class: "detail" });
  const empty = h("p", { class: "empty" });
  const hint = h(
    "p",
    { class: "hint" },
    "Each row is a pair of links. Distances are 0 in contact (SPEC 8.5): penetration depths are not computed.",
  );
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
    hint,
    detail,
  );
  const rows: LinkRow[] = [];
  const render = (): void => {
    const { robot, proximity, pair, shapes, tab, opened } = app.store.now;
    if (tab !== "Proximity") return;
    const { answer, error } = proximity;
    const nearest = answer?.nearest.slice() ?? [];
    if (order.value === "relative") nearest.sort((a, b) => (a.relative ?? Infinity) - (b.relative ?? Infinity));
    const found = byLinks(nearest);
    const widest = Math.max(...nearest.map((pair) => pair.statistics?.max ?? pair.distance), 1e-9);
    while (rows.length < found.length) {
      const made = linkRow(app, (key) => {
        const { opened } = app.store.now;
        keep(opened, key, !opened.has(key));
        render();
      });
      rows.push(made);
      list.append(made.element);
    }
    rows.forEach(({ element, show }, k) => {
      const at = found[k];
      element.hidden = !at;
      if (at) show(at, widest, pair, opened.has(keyOf(at)));
    });
    if (kind.value !== shapes) kind.value = shapes;
    state.textContent = answer?.pairs ? verdict(app) : "";
    const free = answer?.skipped_touching.length ? "" : "good";
    state.className = `collision ${answer?.pairs ? (answer.in_collision ? "bad" : free) : ""}`;
    learned.show(answer);
    empty.hidden = nearest.length > 0;
    hint.hidden = nearest.length === 0;
    empty.textContent = said(error, answer, robot !== null);
    selected(app, detail, nearest.find((at) => same(pair, pairOf(at))) ?? null, answer);
  };
  app.store.on(["robot", "proximity", "pair", "shapes", "skips", "tab", "units"], render);
  return panel;
}

/** The key of whether the pieces of two links are listed. */
function keyOf({ shapes }: LinkPair): string {
  return ["pieces", ...(shapes[0]?.links ?? [])].join("\n");
}

/** Whether the robot collides, by links. */
function verdict(app: App): string {
  const n = app.store.now.contacts?.pairs.length ?? 0;
  if (n > 0) return `Self-collision: ${count(n, "pair")} of links`;
  const skipped = app.store.now.proximity.answer?.skipped_touching.length ?? 0;
  if (skipped === 0) return "No self-collision";
  return `No self-collision among the pairs that are checked; ${count(skipped, "pair")} of links ${skipped === 1 ? "touches and is" : "touch and are"} skipped`;
}

function said(error: string | null, answer: ProximityAnswer | null, open: boolean): string {
  if (error) return `Distances cannot be computed: ${error}`;
  if (answer?.of === 0) return "There is no pair of shapes: there is nothing to measure.";
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

/** A row for two links, with rows for their pieces. Reused for other links. */
function linkRow(app: App, toggle: (key: string) => void): LinkRow {
  const main = row(app);
  const more = button("", { class: "tiny expand" }, () => toggle(key));
  const pieces = h("div", { class: "pieces", hidden: true });
  const element = h("div", { class: "link-pair" }, main.element, more, pieces);
  const below: ReturnType<typeof row>[] = [];
  let key = "";
  return {
    element,
    show(pair, widest, chosen, open) {
      key = keyOf(pair);
      const { shapes } = pair;
      const ofPieces = app.store.now.shapes.startsWith("piece");
      const [first] = shapes;
      const touching = shapes.filter(isContact).length;
      const names = first?.links.map(name).join(" · ") ?? "";
      if (first) {
        const is = shapes.some((at) => same(chosen, pairOf(at)));
        main.show(first, widest, is, { names: first.links, said: touching > 1 ? `${touching} pairs of pieces` : "" });
      }
      more.hidden = !ofPieces;
      more.textContent = `${open ? "▾" : "▸"} ${count(shapes.length, "pair")} of pieces`;
      more.setAttribute("aria-expanded", String(open));
      more.setAttribute("aria-label", `${more.textContent} of ${names}`);
      pieces.hidden = !ofPieces || !open;
      if (pieces.hidden) return;
      while (below.length < shapes.length) {
        const made = row(app);
        below.push(made);
        pieces.append(made.element);
      }
      below.forEach((one, k) => {
        const at = shapes[k];
        one.element.hidden = !at;
        if (at) one.show(at, widest, same(chosen, pairOf(at)), { names: pieceNames(at), said: "" });
      });
    },
  };
}

function pieceNames({ links, pieces }: PairDistance): [string, string] {
  const text = (k: 0 | 1): string => `${links[k]} · piece ${pieces[k]}`;
  return [text(0), text(1)];
}

/** A row for a pair. Reused for other pairs. */
function row(app: App): {
  element: HTMLButtonElement;
  show: (pair: PairDistance, widest: number, chosen: boolean, texts: { names: [string, string]; said: string }) => void;
} {
  const sides = [h("span", { class: "name cut" }), h("span", { class: "name cut" })] as const;
  const distance = h("span", { class: "distance" });
  const relative = h("span", { class: "relative" });
  const said = h("span", { class: "said-of" });
  const range = h("span", { class: "range" });
  const mark = h("span", { class: "mark" });
  const bar = h("span", { class: "gauge" }, range, mark);
  let current: PairDistance | null = null;
  let isChosen = false;
  const element = button([sides[0], distance, relative, sides[1], said, bar], { class: "pair" }, () => {
    if (current) app.store.set({ pair: isChosen ? null : pairOf(current) });
  });
  return {
    element,
    show(pair, widest, chosen, texts) {
      current = pair;
      isChosen = chosen;
      sides.forEach((side, k) => {
        const text = name(texts.names[k] ?? "");
        if (side.textContent !== text) {
          fill(side, ...cut(text));
          side.title = text;
        }
      });
      const touches = isContact(pair);
      distance.textContent = touches ? "in contact" : length(pair.distance);
      relative.textContent = touches || pair.relative === null ? "–" : percent(pair.relative);
      said.textContent = [texts.said, isDecided(app.store.now.skips.answer?.edits, pair.links) ? "to be skipped" : ""]
        .filter(Boolean)
        .join(" · ");
      element.classList.toggle("contact", touches);
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

/** Whether an unsaved edit skips these links. */
function isDecided(edits: readonly SkipEdit[] | null | undefined, links: [string, string]): boolean {
  return edits?.filter((edit) => isOf(edit, links)).at(-1)?.skip ?? false;
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
      : h("p", { class: "hint" }, "The URDD has no statistics for this pair."),
    h(
      "div",
      { class: "actions" },
      button(
        "Skip this pair",
        "Collision checks skip these two links once the edit is saved in Skips",
        () => void decide(app, [{ link_a: pair.links[0], link_b: pair.links[1], skip: true, reason: "" }]),
      ),
      ...skipNearer(app, pair.link_idxs, () => ""),
      button("Show in Skips", {}, () => app.store.set({ tab: "Skips" })),
      button("Show only these", {}, () => {
        const keep = new Set(pair.link_idxs);
        app.hide(app.store.now.robot?.links.keys() ?? [], true);
        app.hide(keep, false);
      }),
      button("Show all", {}, () => {
        app.store.set({ pair: null });
        app.hide(app.store.now.robot?.links.keys() ?? [], false);
      }),
    ),
  );
}

/** Buttons that skip the pairs of links that are nearer than these. */
export function skipNearer(app: App, links: [number, number], reason: () => string): HTMLElement[] {
  return [
    button(
      "Skip all nearer",
      "Every pair of links that is nearer than this one in this configuration",
      () => void nearer(app, links, "distance", reason()),
    ),
    button(
      "Skip all relatively nearer",
      "Every pair of links whose distance is a smaller fraction of its mean",
      () => void nearer(app, links, "relative", reason()),
    ),
  ];
}

/** The learned model's estimate beside the exact result: an element, and a function that shows an answer in it. */
function learnedLine(): { element: HTMLElement; show: (answer: ProximityAnswer | null) => void } {
  // Screen readers announce only the verdict: the clearance changes with every move.
  const verdict = h("span", { "aria-live": "polite" });
  const least = h("span", { class: "least" });
  const rates = h("span", { class: "hint" });
  const element = h("p", { class: "learned", hidden: true }, verdict, least, rates);
  return {
    element,
    show(answer) {
      const model = answer?.model ?? null;
      element.hidden = !model;
      if (!answer || !model) {
        fill(verdict);
        return;
      }
      const [text, kind] = "error" in model ? [`cannot be used: ${name(model.error)}`, "bad"] : judged(model, answer);
      const line = `Model: ${text}`;
      if (verdict.textContent !== line) verdict.textContent = line;
      verdict.className = kind;
      if ("error" in model) {
        fill(least);
        fill(rates);
        return;
      }
      least.textContent = model.min_clearance
        ? ` (minimum clearance ${length(model.min_clearance.clearance)}, ${model.min_clearance.links.map(name).join(" – ")})`
        : "";
      least.title = `An estimate. Training clipped distances at ${length(model.clip_distance)}`;
      rates.textContent = counted(model);
      rates.title = counts(model);
    },
  };
}

/** The verdict, and its colour. */
function judged(model: Learned, exact: ProximityAnswer): [string, "" | "bad" | "doubt"] {
  if (model.may_collide)
    return exact.in_collision ? ["may be in contact", ""] : ["predicted in contact, but is free", "doubt"];
  return exact.in_collision ? ["predicted clear, but is in collision: missed", "bad"] : ["clear", ""];
}

function counted({ rates }: Learned): string {
  return `misses ${interval(rates.miss)} of collisions, ${interval(rates.near_contact_miss)} near contact`;
}

function counts({ rates: { miss, near_contact_miss: near, clear } }: Learned): string {
  return (
    `Measured on 50,000 sampled configurations, with 95 % intervals: misses ${n(miss.count)} of ${n(miss.of)} collisions, ` +
    `and ${n(near.count)} of ${n(near.of)} collisions within a step of 0.05 rad or m of being free; ` +
    `clears ${interval(clear)} of ${n(clear.of)} free configurations. An estimate, not a guarantee.`
  );
}

/** A rate and its 95 % interval: `0.69 % (0.50 to 0.96 %)`. */
function interval({ count, of, lower, upper }: Rate): string {
  const [share, low, high] = [of === 0 ? Number.NaN : count / of, lower, upper].map((x) => (100 * x).toFixed(2));
  return of === 0 ? "an unknown fraction" : `${String(share)} % (${String(low)} to ${String(high)} %)`;
}

function n(count: number): string {
  return count.toLocaleString("en");
}
