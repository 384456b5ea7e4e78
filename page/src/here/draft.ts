/** The description that this page makes a robot of, as a text that a person may change. */

import type { Description, Given } from "./protocol";

export interface Draft {
  /** Its path among the dropped files. */
  path: string;
  format: Exclude<Description["format"], "xacro">;
  /** The text as it is now; null of a binary file. */
  text: string | null;
  /** Whether it differs from what was dropped, or saved last. */
  isChanged: boolean;
}

/** A draft that is a text. */
export type TextDraft = Draft & { text: string };

/** The draft, if it is a text. */
export function ofText(draft: Draft | null): TextDraft | null {
  return draft && draft.text !== null ? { ...draft, text: draft.text } : null;
}

/** What the page does with a changed text. */
export interface Drafting {
  /** Takes a text: the findings follow at once, the picture after a pause. */
  edit(text: string): void;
  /** The text was saved as a file. */
  saved(): void;
  /** Takes files that were missing. */
  add(files: Given[]): void;
}
