/** Links in contact, from the distances between their shapes. */

import type { PairDistance, ProximityAnswer, ShapeKind } from "./engine/protocol";

/** Two links, and the pairs of their shapes, nearest first. */
export interface LinkPair {
  links: [number, number];
  shapes: PairDistance[];
}

/** The self-collisions of a robot. */
export interface Contacts {
  shapes: ShapeKind;
  /** Pairs of links that touch. */
  pairs: LinkPair[];
  links: ReadonlySet<number>;
  /** Each shape that touches, as `placeKey` writes it. */
  places: ReadonlySet<string>;
}

export function isContact(pair: PairDistance): boolean {
  return pair.distance <= 0;
}

/** A shape of a link, as a key. */
export function placeKey(link: number, piece: number): string {
  return `${link} ${piece}`;
}

/** Groups distances by pairs of links, in the order of their nearest shapes. */
export function byLinks(nearest: readonly PairDistance[]): LinkPair[] {
  const found = new Map<string, LinkPair>();
  for (const pair of nearest) {
    const [a, b] = pair.link_idxs;
    const key = a < b ? placeKey(a, b) : placeKey(b, a);
    const known = found.get(key);
    if (known) known.shapes.push(pair);
    else found.set(key, { links: [a, b], shapes: [pair] });
  }
  return [...found.values()];
}

/** The contacts. If they did not change, the same object, to avoid repainting. */
export function contactsOf(answer: ProximityAnswer, shapes: ShapeKind, before: Contacts | null): Contacts {
  const touching = answer.nearest.filter(isContact);
  const places = new Set(
    touching.flatMap(({ link_idxs, pieces }) => [placeKey(link_idxs[0], pieces[0]), placeKey(link_idxs[1], pieces[1])]),
  );
  const pairs = byLinks(touching);
  const key = (pairs: LinkPair[]): string =>
    pairs
      .map(
        ({ links, shapes }) =>
          `${links.join()} ${shapes
            .map(({ pieces }) => pieces.join())
            .sort()
            .join()}`,
      )
      .sort()
      .join(";");
  if (before?.shapes === shapes && key(before.pairs) === key(pairs)) return before;
  return { shapes, pairs, places, links: new Set(touching.flatMap(({ link_idxs }) => link_idxs)) };
}
