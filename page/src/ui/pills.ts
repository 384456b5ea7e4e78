/** Pills in a row, the most important first. Those without room are behind a button that counts them. */

import type { App } from "../app";
import { button, fill, h } from "./dom";
import type { Child } from "./dom";

export class Pills {
  readonly element = h("div", { class: "chips" });
  /** What the button unfolds, below the bar. */
  readonly rest = h("div", { class: "rest", id: "more-chips", role: "group", "aria-label": "More about this robot" });
  private readonly more: HTMLButtonElement;
  private pills: HTMLElement[] = [];

  constructor(app: App) {
    this.more = button("", { class: "chip more", "aria-controls": this.rest.id, "aria-expanded": "false" }, () =>
      app.store.set({ unfolded: app.store.now.unfolded === "pills" ? null : "pills" }),
    );
    app.store.on(["unfolded"], ({ unfolded }) => this.more.setAttribute("aria-expanded", String(unfolded === "pills")));
    let width = 0;
    new ResizeObserver(() => {
      if (this.element.clientWidth === width) return;
      width = this.element.clientWidth;
      this.fit();
    }).observe(this.element);
  }

  fill(...pills: Child[]): void {
    this.pills = pills.filter((pill) => pill instanceof HTMLElement);
    this.fit();
  }

  /** Folds what has no room. Call it when a pill has changed. */
  fit(): void {
    const { element, more, rest } = this;
    const shown = this.pills.filter((pill) => !pill.hidden);
    const { activeElement: focused } = document;
    const isNarrow = (): boolean => element.scrollWidth > element.clientWidth;
    fill(element, ...shown);
    const folded: HTMLElement[] = [];
    if (isNarrow()) element.append(more);
    while (isNarrow() && shown.length > folded.length) {
      const [last] = shown.slice(-1 - folded.length);
      if (!last) break;
      last.remove();
      folded.unshift(last);
      more.textContent = `+${folded.length}`;
      more.title = `${folded.length} more`;
    }
    fill(rest, ...folded);
    if (focused instanceof HTMLElement && focused !== document.activeElement) focused.focus();
  }
}
