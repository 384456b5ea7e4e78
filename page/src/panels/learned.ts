/** The learned self-collision model's estimate, beside the exact result. */

import type { Learned, ProximityAnswer, Rate } from "../engine/protocol";
import { fill, h } from "../ui/dom";
import { length, name } from "../ui/format";

/** An element, and a function that shows an answer in it. */
export function learnedLine(): { element: HTMLElement; show: (answer: ProximityAnswer | null) => void } {
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
      const [text, kind] = "error" in model ? [`cannot be used: ${name(model.error)}`, "bad"] : said(model, answer);
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
function said(model: Learned, exact: ProximityAnswer): [string, "" | "bad" | "doubt"] {
  if (model.may_collide)
    return exact.in_collision ? ["may be in contact", ""] : ["predicted in contact, but is free", "doubt"];
  return exact.in_collision ? ["predicted clear, but is in collision: missed", "bad"] : ["clear", ""];
}

function counted({ rates }: Learned): string {
  return `misses ${percent(rates.miss)} of collisions, ${percent(rates.near_contact_miss)} near contact`;
}

function counts({ rates: { miss, near_contact_miss: near, clear } }: Learned): string {
  return (
    `Measured on 50,000 sampled configurations, with 95 % intervals: misses ${n(miss.count)} of ${n(miss.of)} collisions, ` +
    `and ${n(near.count)} of ${n(near.of)} collisions within a step of 0.05 rad or m of being free; ` +
    `clears ${percent(clear)} of ${n(clear.of)} free configurations. An estimate, not a guarantee.`
  );
}

/** A rate and its 95 % interval: `0.69 % (0.50 to 0.96 %)`. */
function percent({ count, of, lower, upper }: Rate): string {
  const [share, low, high] = [of === 0 ? Number.NaN : count / of, lower, upper].map((x) => (100 * x).toFixed(2));
  return of === 0 ? "an unknown fraction" : `${String(share)} % (${String(low)} to ${String(high)} %)`;
}

function n(count: number): string {
  return count.toLocaleString("en");
}
