/** What is open in a panel that is made anew with each report of the same robot. */

import { h } from "./dom";
import type { Child } from "./dom";

/** By key, how much of it is shown. Another robot's is another map. */
export type Opened = Map<string, number>;

/** A `<details>` that is open as it was left. */
export function folded(
  opened: Opened,
  key: string,
  attributes: { class: string },
  summary: Child,
  ...children: Child[]
): HTMLDetailsElement {
  const made = h("details", { ...attributes, open: opened.has(key) }, h("summary", {}, summary), ...children);
  made.addEventListener("toggle", () => keep(opened, key, made.open));
  return made;
}

export function keep(opened: Opened, key: string, isOpen: boolean): void {
  if (isOpen) opened.set(key, 1);
  else opened.delete(key);
}

/** Things of a list with keys that differ: those that are alike are counted. */
export function keyed<T>(all: readonly T[], keyOf: (one: T) => string): [key: string, one: T][] {
  const counts = new Map<string, number>();
  return all.map((one) => {
    const key = keyOf(one);
    const n = (counts.get(key) ?? 0) + 1;
    counts.set(key, n);
    return [`${key}\n${n}`, one];
  });
}
