/** The heat map: rows and columns are shapes; the colour is the reason, pale where a pair is checked. */

import type { SkipsAnswer } from "../engine/protocol";
import { isSkipped, letterAt } from "../skips";
import type { Pair } from "../state";

/** Letters of `wasm/src/pairs.rs`, in the order of the specification. */
export const REASONS = new Map([
  ["s", "same link"],
  ["a", "always in contact"],
  ["j", "adjacent"],
  ["d", "in contact at rest"],
  ["n", "never in contact"],
  ["-", "sometimes in contact"],
  ["?", "no reason given"],
]);

export function reasonClass(letter: string): string {
  return letter === "-" ? "none" : letter === "?" ? "open" : letter;
}

/** Side of the matrix, CSS pixels. */
const SIDE = 340;

/** The shapes of the rows and columns: all, or those of two links. */
interface Region {
  rows: number[];
  columns: number[];
}

export function region(answer: SkipsAnswer, links: [number, number] | null): Region {
  const of = (link: number | undefined): number[] =>
    answer.places.flatMap(([other], shape) => (link === undefined || other === link ? [shape] : []));
  return { rows: of(links?.[0]), columns: of(links?.[1]) };
}

/** The pair of shapes at a position, from 0 to 1 along each side. */
export function at({ rows, columns }: Region, x: number, y: number): [number, number] | null {
  const row = rows[Math.floor(y * rows.length)];
  const column = columns[Math.floor(x * columns.length)];
  return row === undefined || column === undefined || x < 0 || y < 0 ? null : [row, column];
}

/** Whether a shape is one of a pair: of this link, or of this piece of it. */
export function isAt(answer: SkipsAnswer, shape: number, [link, piece]: Pair[0]): boolean {
  const place = answer.places[shape];
  return place?.[0] === link && (!answer.kind.startsWith("piece") || place[1] === piece);
}

export function draw(
  canvas: HTMLCanvasElement,
  answer: SkipsAnswer,
  { rows, columns }: Region,
  pair: Pair | null,
): void {
  const ratio = Math.min(window.devicePixelRatio, 2);
  const side = Math.round(SIDE * ratio);
  canvas.width = side;
  canvas.height = side;
  const context = canvas.getContext("2d");
  if (!context) return;
  const style = getComputedStyle(canvas);
  const colors = new Map(
    [...REASONS.keys()].map((letter) => [letter, style.getPropertyValue(`--reason-${reasonClass(letter)}`)]),
  );
  const [width, height] = [side / columns.length, side / rows.length];
  const gap = Math.min(width, height) > 6 ? 1 : 0;
  rows.forEach((i, row) => {
    columns.forEach((j, column) => {
      context.globalAlpha = isSkipped(answer, i, j) ? 1 : 0.4;
      context.fillStyle = colors.get(letterAt(answer, i, j)) ?? "#888";
      context.fillRect(column * width, row * height, Math.max(width - gap, 0.5), Math.max(height - gap, 0.5));
    });
  });
  context.globalAlpha = 1;
  if (!pair) return;
  const is = (shape: number, one: Pair[0]): boolean => isAt(answer, shape, one);
  context.strokeStyle = style.getPropertyValue("--text");
  context.lineWidth = Math.max(2, ratio * 1.5);
  rows.forEach((i, row) => {
    columns.forEach((j, column) => {
      if ((is(i, pair[0]) && is(j, pair[1])) || (is(i, pair[1]) && is(j, pair[0]))) {
        context.strokeRect(column * width, row * height, width, height);
      }
    });
  });
}
