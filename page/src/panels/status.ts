/** The line at the bottom. */

import type { App } from "../app";
import { fill, h } from "../ui/dom";
import { number } from "../ui/format";
import type { State } from "../state";
import { SHAPE_NAMES } from "./proximity";

/** What is being loaded, in words. */
export function said({ title = "Loading", what, done, of }: NonNullable<State["loading"]>): string {
  return `${title} ${what}${of > 0 ? `, ${done} of ${of}` : ""}`;
}

export function status(app: App): HTMLElement {
  const left = h("div", { class: "left" });
  const middle = h("div", { class: "note", "aria-live": "polite" });
  const right = h("div", { class: "right" });
  app.store.on(["proximity", "robot", "loading", "shapes"], ({ proximity: { answer }, robot, loading, shapes }) => {
    if (loading) {
      fill(left, h("span", {}, said(loading)));
    } else if (robot && answer) {
      const skipped = answer.of === null ? null : answer.of - answer.pairs;
      fill(
        left,
        h(
          "span",
          { class: answer.in_collision ? "bad" : "good" },
          answer.in_collision ? "● self-collision" : "● no self-collision",
        ),
        h("span", {}, `${answer.pairs.toLocaleString("en")} pairs of ${SHAPE_NAMES[shapes]} checked`),
        skipped !== null && h("span", {}, `${skipped.toLocaleString("en")} skipped`),
        h("span", {}, `${number(answer.ms, 2)} ms`),
      );
    } else
      fill(
        left,
        h("span", {}, robot ? "Drag a joint to move it · shift-drag a link to pull it · space plays the samples" : ""),
      );
  });
  app.store.on(["note"], ({ note }) => {
    fill(middle, note);
  });
  app.store.on(["robot", "q", "sample"], ({ robot, q, sample }) => {
    const is = (key: "zero" | "middle"): boolean =>
      robot?.about[key]?.every((value, dof) => Math.abs(value - (q[dof] ?? 0)) < 1e-9) ?? false;
    const what = sample ? `sample ${sample.at + 1}` : is("zero") ? "q = zero" : is("middle") ? "q = middle" : "q";
    fill(right, robot?.moves ? h("span", {}, what) : null, robot && h("span", {}, "mm · deg"));
  });
  return h("footer", { class: "status" }, left, middle, h("span", { class: "spring" }), right);
}
