/** Fixes of a report, as changes of a text. Pure: what `urdd lint --fix` makes of the same text and report. */

/** `line` and `column` count from 1, columns in code points; `end_line` and `end_column` are of the first that stays. */
interface TextEdit {
  file: string;
  line: number;
  column: number;
  end_line: number;
  end_column: number;
  text: string;
}

export interface Fix {
  message: string;
  is_safe: boolean;
  edits: TextEdit[];
}

/** A part of a text, in UTF-16 units, and what replaces it. */
export interface Change {
  from: number;
  to: number;
  insert: string;
}

/** The lines of a text, which end with LF, CRLF or CR. */
export class Lines {
  private readonly starts = [0];
  /** Offsets of the characters that take two units. */
  private readonly wide: number[] = [];

  constructor(readonly text: string) {
    for (let at = 0; at < text.length; at++) {
      const unit = text.charCodeAt(at);
      if (unit === 10 || (unit === 13 && text.charCodeAt(at + 1) !== 10)) this.starts.push(at + 1);
      else if (unit >= 0xd800 && unit < 0xdc00) this.wide.push(at);
    }
  }

  /** The offset of a place; null if the text has none such. */
  offset(line: number, column: number): number | null {
    const start = this.starts[line - 1];
    if (start === undefined || !(column >= 1)) return null;
    const first = below(this.wide.length, (k) => (this.wide[k] ?? 0) < start);
    // The wide characters before the column: each takes one unit more.
    const before = below(this.wide.length - first, (k) => (this.wide[first + k] ?? 0) - start - k < column - 1);
    const offset = start + column - 1 + before;
    return offset <= this.text.length ? offset : null;
  }
}

/** The number of values of `k` from 0 on for which this is true, which come first; at most `n`. */
function below(n: number, isTrue: (k: number) => boolean): number {
  let [low, high] = [0, n];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (isTrue(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The changes of a fix; null if it is also for another file, or not for this text. */
export function changesOf(fix: Fix, lines: Lines, isFile: (file: string) => boolean): Change[] | null {
  const changes: Change[] = [];
  for (const edit of fix.edits) {
    const from = lines.offset(edit.line, edit.column);
    const to = lines.offset(edit.end_line, edit.end_column);
    if (!isFile(edit.file) || from === null || to === null || from > to) return null;
    changes.push({ from, to, insert: edit.text });
  }
  return changes;
}

/** The changes of the first safe fix of each place. Of two that touch, the first wins. */
export function safeChanges(
  places: Iterable<{ fixes?: readonly Fix[] }>,
  lines: Lines,
  isFile: (file: string) => boolean,
): Change[][] {
  const all: Change[][] = [];
  const taken = new Taken();
  for (const { fixes = [] } of places) {
    const fix = fixes.find(({ is_safe, edits }) => is_safe && edits.every(({ file }) => isFile(file)));
    const changes = fix && changesOf(fix, lines, isFile);
    if (!changes || changes.some((change) => taken.touches(change))) continue;
    for (const change of changes) taken.add(change);
    all.push(changes);
  }
  return all;
}

/** Parts of a text that do not overlap, by where they begin. */
class Taken {
  private readonly parts: Change[] = [];

  touches({ from, to }: Change): boolean {
    const next = this.after(from);
    return (this.parts[next]?.from ?? Infinity) <= to || (this.parts[next - 1]?.to ?? -1) >= from;
  }

  add(change: Change): void {
    this.parts.splice(this.after(change.from), 0, change);
  }

  private after(from: number): number {
    return below(this.parts.length, (k) => (this.parts[k]?.from ?? 0) < from);
  }
}

/** The text with these changes. Of one inside another, only the outer one counts. */
export function apply(text: string, changes: readonly Change[]): string {
  let made = "";
  let done = 0;
  for (const { from, to, insert } of outer(changes)) {
    made += text.slice(done, from) + insert;
    done = to;
  }
  return made + text.slice(done);
}

/** Changes in the order of the text, without those that begin inside another. */
export function outer(changes: readonly Change[]): Change[] {
  let done = 0;
  return [...changes]
    .sort((a, b) => a.from - b.from || b.to - a.to)
    .filter(({ from, to }) => {
      if (from < done) return false;
      done = to;
      return true;
    });
}
