/** Findings of a report as marks in a text, with their fixes as changes of it. */

import type { Diagnostic } from "@codemirror/lint";
import { changesOf } from "../edits";
import type { Change, Fix, Lines } from "../edits";
import { h, prose } from "../ui/dom";
import { name } from "../ui/format";

/** More marks than anybody reads; the worst come first. */
const MAX_MARKS = 1000;

const RANK = { error: 0, warning: 1, info: 2 } as const;
type Severity = keyof typeof RANK;

/** A finding at a place of the text. */
export interface Found {
  code: string;
  severity: Severity;
  message: string;
  /** What programs do because of it; empty where it is not known. */
  programs: string;
  line: number;
  column: number | null;
  fixes: readonly Fix[];
}

export interface Mark extends Diagnostic {
  found: Found;
  remedies: Remedy[];
}

/** A fix, as changes of the text of the report. */
export interface Remedy {
  message: string;
  is_safe: boolean;
  changes: Change[];
}

/** Marks of what was found, the worst first, and at most `MAX_MARKS`. */
export function marksOf(
  all: readonly Found[],
  lines: Lines,
  isFile: (file: string) => boolean,
  mend: (remedy: Remedy) => void,
): Mark[] {
  const worst = [...all].sort((a, b) => RANK[a.severity] - RANK[b.severity]).slice(0, MAX_MARKS);
  return worst.flatMap((found) => {
    const from = lines.offset(found.line, found.column ?? 1);
    if (from === null) return [];
    const to = from + width(lines.text, from);
    const remedies = found.fixes.flatMap(({ message, is_safe, ...fix }) => {
      const changes = changesOf({ message, is_safe, ...fix }, lines, isFile);
      return changes ? [{ message, is_safe, changes }] : [];
    });
    const { severity, code } = found;
    const actions = remedies.map((remedy) => ({
      name: `${remedy.is_safe ? "Fix" : "Possible fix"}: ${name(remedy.message).replaceAll("`", "")}`,
      apply: () => mend(remedy),
    }));
    const message = `${code} ${name(found.message)}`;
    return [{ from, to, severity, message, renderMessage: () => described(found), actions, found, remedies }];
  });
}

function described({ code, message, programs }: Found): Node {
  return h(
    "div",
    {},
    h("strong", {}, `${code} `),
    ...prose(name(message)),
    programs !== "" && h("div", { class: "programs" }, programs),
  );
}

/** Number of characters of the word or tag at a place, to underline. */
function width(text: string, from: number): number {
  return /^(?:<[/?!]?)?[^\s<>="'/]+|^[^\r\n]?/u.exec(text.slice(from, from + 200))?.[0].length ?? 0;
}
