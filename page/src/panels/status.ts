/** The line at the bottom. */

import type { App } from "../app";
import { button, fill, h } from "../ui/dom";
import { count, name, number, UNIT_NAMES } from "../ui/format";
import type { Units } from "../ui/format";
import type { State } from "../state";
import { SHAPE_NAMES } from "./proximity";

/** Maximum number of pairs of links that are named. */
const NAMED = 2;

/** The progress of loading, in words. */
export function said({ title = "Loading", what, done, of }: NonNullable<State["loading"]>): string {
  return `${title} ${what}${of > 0 ? `, ${done} of ${of}` : ""}`;
}

/** The progress of a generation, in words. */
export function generating({ done, of }: { done: number; of: number }): string {
  return of > 0 ? `generating: ${done} of ${of}` : "generating";
}

/** Whether the robot collides: a text, a shorter one, and a class. */
export function collision({ robot, proximity, contacts }: Readonly<State>): {
  text: string;
  brief: string;
  kind: string;
  more: string;
} {
  const { answer, error } = proximity;
  const as = (text: string, kind: string, more: string, brief = text): ReturnType<typeof collision> => ({
    text,
    brief,
    kind,
    more,
  });
  if (error !== null || !robot?.moves) return as("collisions unknown", "open", error ?? "the joints cannot be moved");
  if (!answer || !contacts) return as("checking for collisions…", "open", "");
  const named = (links: readonly number[]): string => links.map((link) => name(robot.nameOf(link))).join(" – ");
  const listed = (all: string[]): string =>
    all.slice(0, NAMED).join(", ") + (all.length > NAMED ? ` and ${all.length - NAMED} more` : "");
  const pairs = contacts.pairs.map(({ links }) => named(links));
  if (answer.pairs === 0) return as("no pair to check for collisions", "open", "");
  const skipped = answer.skipped_touching.map(named);
  if (pairs.length === 0 && skipped.length === 0) return as("no self-collision", "good", "");
  if (pairs.length === 0) {
    const are = skipped.length === 1 ? "touches" : "touch";
    const more = `skipped, because they touch at rest: ${listed(skipped)}`;
    const number = count(skipped.length, "skipped pair");
    return as(`no self-collision, but ${number} ${are}`, "open", more, `${number} ${are}`);
  }
  const brief = count(pairs.length, "self-collision");
  return as(`self-collision: ${count(pairs.length, "pair")} of links`, "bad", listed(pairs), brief);
}

export function status(app: App): HTMLElement {
  const verdict = h("span", { class: "verdict-now", role: "status" });
  const left = h("div", { class: "left" });
  const middle = h("div", { class: "note", "aria-live": "polite" });
  const what = h("span", { class: "wide-only" });
  const right = h("div", { class: "right" }, what, ...switches(app));
  app.store.on(["proximity", "contacts", "robot", "loading", "shapes"], (state) => {
    const { proximity, robot, loading, shapes } = state;
    const { text, kind, more } = collision(state);
    verdict.hidden = robot === null;
    const line = `● ${text}`;
    // Screen readers announce it when it changes, not with every move.
    if (verdict.textContent !== line) verdict.textContent = line;
    verdict.className = `verdict-now ${kind}`;
    verdict.title = more;
    const { answer } = proximity;
    if (loading) fill(left, h("span", {}, said(loading)));
    else if (robot && answer) {
      const skipped = answer.of === null ? null : answer.of - answer.pairs;
      fill(
        left,
        more !== "" && h("span", { class: kind === "bad" ? "bad" : "" }, more),
        h("span", { class: "wide-only" }, `${count(answer.pairs, "pair")} of ${SHAPE_NAMES[shapes]} checked`),
        skipped !== null && h("span", { class: "wide-only" }, `${skipped.toLocaleString("en")} skipped`),
        h("span", { class: "wide-only" }, `${number(answer.ms, 2)} ms`),
      );
    } else fill(left, h("span", {}, robot ? name(more) : ""));
  });
  app.store.on(["note"], ({ note }) => fill(middle, note));
  app.store.on(["robot", "q", "sample"], ({ robot, q, sample }) => {
    const is = (key: "zero" | "middle"): boolean =>
      robot?.about[key]?.every((value, dof) => Math.abs(value - (q[dof] ?? 0)) < 1e-9) ?? false;
    const text = sample ? `sample ${sample.at + 1}` : is("zero") ? "q = zero" : is("middle") ? "q = middle" : "";
    what.textContent = robot?.moves ? text : "";
  });
  return h("footer", { class: "status" }, verdict, left, middle, h("span", { class: "spring" }), right);
}

/** The units of all numbers; a click changes them. */
function switches(app: App): HTMLElement[] {
  const make = <K extends keyof Units>(key: K, both: readonly [Units[K], Units[K]]): HTMLElement => {
    const made = button("", { class: "tiny unit" }, () => {
      const { units } = app.store.now;
      app.setUnits({ ...units, [key]: units[key] === both[0] ? both[1] : both[0] });
    });
    app.store.on(["units"], ({ units }) => {
      const [now, other] = units[key] === both[0] ? both : [both[1], both[0]];
      made.textContent = now;
      made.title = `In ${UNIT_NAMES[now]}. Click for ${UNIT_NAMES[other]}`;
      made.setAttribute("aria-label", `${now}: ${key === "length" ? "lengths" : "angles"} in ${UNIT_NAMES[now]}`);
    });
    return made;
  };
  return [make("length", ["mm", "m"]), make("angle", ["°", "rad"])];
}
