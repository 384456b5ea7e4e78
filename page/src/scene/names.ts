/** Names beside the frames of links, as text over the picture. Omits names that would overlap. */

import { Vector3 } from "three";
import { fill, h } from "../ui/dom";
import { name } from "../ui/format";
import type { View } from "./view";

/** Maximum number of names. */
const MAX_NAMES = 400;
/** Size of a name in pixels: offset from its point, width of a character, height. */
const BESIDE = 6;
const WIDE = 6.4;
const HIGH = 15;

export class Names {
  readonly element = h("div", { class: "names", "aria-hidden": "true", hidden: true });
  private labels: { link: number; width: number; element: HTMLElement }[] = [];
  private poses: Float64Array | null = null;

  constructor(private readonly view: View) {
    view.before.push(() => this.follow());
  }

  /** Shows these links' names, by priority. */
  show(links: readonly { index: number; name: string }[]): void {
    this.labels = links.slice(0, MAX_NAMES).map(({ index, name: text }) => {
      const shown = name(text);
      return { link: index, width: BESIDE + WIDE * shown.length, element: h("span", {}, shown) };
    });
    this.element.hidden = this.labels.length === 0;
    fill(this.element, ...this.labels.map(({ element }) => element));
    this.view.invalidate();
  }

  pose(poses: Float64Array): void {
    this.poses = poses;
  }

  private follow(): void {
    const { poses } = this;
    if (!poses || this.labels.length === 0) return;
    const placed: { x: number; y: number; width: number }[] = [];
    for (const { link, width, element } of this.labels) {
      const get = (k: number): number => poses[7 * link + k] ?? 0;
      const at = this.view.place(new Vector3(get(0), get(1), get(2)));
      const covers = (x: number, y: number): boolean =>
        placed.some((one) => Math.abs(one.y - y) < HIGH && x < one.x + one.width && one.x < x + width);
      element.hidden = at === null || covers(at.x, at.y);
      if (!at || element.hidden) continue;
      placed.push({ ...at, width });
      element.style.transform = `translate(${Math.round(at.x + BESIDE)}px, ${Math.round(at.y - HIGH / 2)}px)`;
    }
  }
}
