/** A few lines around a position in a text. */

/** Number of lines before and after, and maximum number of characters of a line. */
const AROUND = 2;
const WIDTH = 160;

export interface Excerpt {
  lines: { number: number; text: string; isPlace: boolean }[];
}

/** `line` and `column` count from 1, columns in characters. Null if the text has no such line. */
export function excerpt(text: string, line: number, column: number | null): Excerpt | null {
  const all = text.split(/\r\n|\n|\r/);
  if (line < 1 || line > all.length) return null;
  const first = Math.max(1, line - AROUND);
  const lines = all.slice(first - 1, line + AROUND).map((text, k) => {
    const isPlace = first + k === line;
    return { number: first + k, text: cut(text, isPlace ? (column ?? 1) : 1), isPlace };
  });
  while (lines.at(-1)?.text === "" && lines.at(-1)?.isPlace === false) lines.pop();
  return { lines };
}

/** The part of a long line around a column: a document can be a single line. */
function cut(text: string, column: number): string {
  const chars = Array.from(text);
  if (chars.length <= WIDTH) return text;
  const start = Math.max(0, Math.min(column - 1 - WIDTH / 4, chars.length - WIDTH));
  const end = start + WIDTH;
  return (start > 0 ? "…" : "") + chars.slice(start, end).join("") + (end < chars.length ? "…" : "");
}
