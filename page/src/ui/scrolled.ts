/** Where panels are scrolled, which they lose when they are made anew. */

import type { StateStore } from "../state";
import type { Opened } from "./opened";

/** Keeps elements where they are scrolled while the files of a robot are read again. Made before what empties them. */
export class Scrolled {
  private readonly tops = new Map<Element, number>();
  private of: Opened | null = null;

  constructor(private readonly store: StateStore) {
    store.on(["robot"], ({ robot, opened }) => {
      if (robot) return;
      for (const element of this.tops.keys()) this.tops.set(element, element.scrollTop);
      this.of = opened;
    });
  }

  /** Called when what fills these is made. */
  keep(elements: Iterable<Element>): void {
    for (const element of elements) this.tops.set(element, 0);
    this.store.on(["robot"], ({ robot, opened }) => {
      if (robot && opened === this.of) for (const [element, top] of this.tops) element.scrollTop = top;
    });
  }
}
