/** The tree of links and joints, with the position of each joint. */

import type { App } from "../app";
import { cut, fill, h } from "../ui/dom";
import { dofValue, name } from "../ui/format";
import { same } from "../model";
import type { RobotModel } from "../model";
import { worstOfLinks } from "../findings";

interface Row {
  link: number;
  element: HTMLElement;
  value: HTMLElement;
  dot: HTMLElement;
}

/** Maximum width of indents, pixels. */
const WIDEST = 72;

const TURNS = new Set(["Revolute", "Continuous"]);

export function tree(app: App): HTMLElement {
  const search = h("input", {
    type: "search",
    placeholder: "Find a link or joint  /",
    "aria-label": "Find a link or joint",
    id: "find",
  });
  const list = h("div", { class: "rows", role: "tree", "aria-label": "Links", tabindex: "0" });
  const empty = h("p", { class: "empty" });
  const panel = h(
    "nav",
    { class: "tree", id: "links", "aria-label": "Links and joints" },
    h("div", { class: "search" }, search),
    list,
    empty,
  );
  let rows: Row[] = [];

  const make = (robot: RobotModel, link: number, depth: number, step: number): Row => {
    const value = h("span", { class: "value" });
    const dot = h("span", { class: "dot" });
    const indent = h("span", { class: "indent" });
    indent.style.width = `${Math.round(depth * step)}px`;
    const label = name(robot.nameOf(link));
    const joint = robot.links[link]?.parent_joint ?? null;
    const title =
      joint === null ? label : `${label}\n${name(robot.joints[joint]?.name ?? "")}: ${robot.joints[joint]?.type ?? ""}`;
    const element = h(
      "div",
      { class: "row", role: "treeitem", "aria-level": depth + 1, "aria-selected": "false", title, id: `row-${link}` },
      indent,
      dot,
      h("span", { class: "name cut" }, ...cut(label)),
      value,
    );
    element.addEventListener("click", (event) => {
      if (event.altKey) app.hide([link], !app.store.now.hidden.has(link));
      else app.select({ kind: "link", index: link });
      // If the tree covers the picture, folding it shows the link.
      if (app.store.now.unfolded === "links") app.store.set({ unfolded: null });
    });
    element.addEventListener("dblclick", () => app.store.set({ tab: "Joints" }));
    element.addEventListener("pointerenter", () => app.hover({ kind: "link", index: link }));
    element.addEventListener("pointerleave", () => app.hover(null));
    return { link, element, value, dot };
  };

  const filter = (): void => {
    const words = search.value.trim().toLowerCase();
    const robot = app.store.now.robot;
    let shown = 0;
    for (const row of rows) {
      const link = robot?.links[row.link];
      const joint = link?.parent_joint === null || link === undefined ? undefined : robot?.joints[link.parent_joint];
      const found = words === "" || [link?.name, joint?.name].some((text) => text?.toLowerCase().includes(words));
      row.element.hidden = !found;
      if (found) shown++;
    }
    empty.hidden = shown > 0 || !robot;
    empty.textContent = robot ? "No link or joint of this name." : "";
  };
  app.store.on(["robot"], ({ robot }) => {
    const found = robot ? order(robot) : [];
    const deepest = Math.max(1, ...found.map(({ depth }) => depth));
    // Deep trees have smaller indents, so that names fit.
    const step = Math.min(12, WIDEST / deepest);
    rows = robot ? found.map(({ link, depth }) => make(robot, link, depth, step)) : [];
    fill(list, ...rows.map((row) => row.element));
    filter();
  });

  search.addEventListener("input", filter);
  search.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      const first = rows.find((row) => !row.element.hidden);
      if (first) app.select({ kind: "link", index: first.link });
    } else if (event.key === "Escape") {
      search.value = "";
      filter();
      search.blur();
    }
  });
  list.addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1, Home: -Infinity, End: Infinity }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const visible = rows.filter((row) => !row.element.hidden);
    const { selected } = app.store.now;
    const at = visible.findIndex((row) => selected?.kind === "link" && row.link === selected.index);
    const next = visible[Math.max(0, Math.min(visible.length - 1, at + step))];
    if (next) app.select({ kind: "link", index: next.link });
  });

  app.store.on(["robot", "q", "units"], ({ robot, q }) => {
    if (!robot) return;
    for (const row of rows) {
      const joint = robot.links[row.link]?.parent_joint ?? null;
      const text = joint === null ? "" : standing(robot, joint, q);
      if (row.value.textContent !== text) row.value.textContent = text;
    }
  });
  app.store.on(["robot", "selected", "hovered", "hidden", "pair"], ({ robot, selected, hovered, hidden, pair }) => {
    const [chosen, under] = [robot?.linkOf(selected), robot?.linkOf(hovered)];
    for (const row of rows) {
      const is = row.link === chosen || (pair?.some(([link]) => link === row.link) ?? false);
      row.element.setAttribute("aria-selected", String(is));
      row.element.classList.toggle("hovered", row.link === under);
      row.element.classList.toggle("gone", hidden.has(row.link));
      if (row.link === chosen && !same(selected, null)) list.setAttribute("aria-activedescendant", row.element.id);
    }
  });
  let last: number | null = null;
  app.store.on(["selected"], ({ selected, robot }) => {
    const link = robot?.linkOf(selected) ?? null;
    if (link !== null && link !== last)
      rows.find((row) => row.link === link)?.element.scrollIntoView({ block: "nearest" });
    last = link;
  });
  app.store.on(["robot", "report"], ({ robot, report }) => {
    const worst = robot ? worstOfLinks(robot, report.report) : null;
    for (const row of rows) row.dot.className = `dot ${worst?.get(row.link) ?? (report.report ? "good" : "open")}`;
  });
  return panel;
}

/** Links below the link that carries them. */
function order(robot: RobotModel): { link: number; depth: number }[] {
  const found: { link: number; depth: number }[] = [];
  const seen = new Set<number>();
  const waiting = robot.roots.map((link) => ({ link, depth: 0 })).reverse();
  for (let next = waiting.pop(); next; next = waiting.pop()) {
    if (seen.has(next.link)) continue;
    seen.add(next.link);
    found.push(next);
    const depth = next.depth + 1;
    for (const joint of (robot.below[next.link] ?? []).slice().reverse()) {
      const child = robot.joints[joint]?.child ?? null;
      if (child !== null) waiting.push({ link: child, depth });
    }
  }
  // Links outside the tree are shown too.
  robot.links.forEach((_, link) => {
    if (!seen.has(link)) found.push({ link, depth: 0 });
  });
  return found;
}

function standing(robot: RobotModel, joint: number, q: readonly number[]): string {
  const found = robot.joints[joint];
  if (!found) return "";
  if (found.type === "Fixed") return "fixed";
  const position = robot.position(joint, q);
  if (position === null) return found.dofs && found.dofs.length > 1 ? found.type.toLowerCase() : "";
  const turns = TURNS.has(found.type);
  const sign = found.mimic ? "⇄" : turns ? "⟳" : "↕";
  return `${sign} ${dofValue(position, turns ? "rad" : "m")}`;
}
