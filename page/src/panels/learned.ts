/** What the learned self-collision model says of a configuration, beside the exact answer. */

import type { Learned, ProximityAnswer } from "../engine/protocol";
import { fill, h } from "../ui/dom";
import { length, name } from "../ui/format";

/** The line: one element, and how to show an answer in it. */
export function learnedLine(): { element: HTMLElement; show: (answer: ProximityAnswer | null) => void } {
  // The verdict alone is read out when it changes: the clearance changes with every move.
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
      least.textContent = model.least
        ? ` (least clearance ${length(model.least.clearance)}, ${model.least.links.map(name).join(" – ")})`
        : "";
      least.title = `An estimate: distances of ${length(model.clip_distance)} and more were all the same to it`;
      rates.textContent = counted(model);
      rates.title = counts(model);
    },
  };
}

/** What it says, and how that is coloured. */
function said(model: Learned, exact: ProximityAnswer): [string, "" | "bad" | "doubt"] {
  if (model.may_collide)
    return exact.in_collision ? ["may be in contact", ""] : ["held to be in contact, and is free", "doubt"];
  return exact.in_collision ? ["held to be clear, and is in collision: missed", "bad"] : ["clear", ""];
}

function counted({ held_out: { num_colliding, num_missed } }: Learned): string {
  return `missed ${n(num_missed)} of ${n(num_colliding)} collisions when it was counted`;
}

function counts({ held_out }: Learned): string {
  const { first_sample_idx: first, num_configurations: all, num_colliding, num_cleared } = held_out;
  return (
    `Counted on the sampled configurations ${String(first)} to ${String(first + all - 1)}, which had no part in making it. ` +
    `Of ${n(all - num_colliding)} free ones it cleared ${n(num_cleared)}. It guarantees nothing.`
  );
}

function n(count: number): string {
  return count.toLocaleString("en");
}
