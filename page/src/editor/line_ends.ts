/** Line ends of a file: the editor's text has LF, where all are alike. */

import { EditorState } from "@codemirror/state";
import type { Extension } from "@codemirror/state";

type Kind = "LF" | "CRLF" | "mixed";

export class LineEnds {
  private readonly kind: Kind;
  readonly extension: Extension;

  constructor(text: string) {
    this.kind = kindOf(text);
    // Where they are mixed, every CR stays, and is shown.
    this.extension = this.kind === "mixed" ? EditorState.lineSeparator.of("\n") : [];
  }

  /** Whether a text has the same kind. */
  fits(text: string): boolean {
    return kindOf(text) === this.kind;
  }

  /** A text of a file as the editor has it. */
  inEditor(text: string): string {
    return this.kind === "CRLF" ? text.replaceAll("\r\n", "\n") : text;
  }

  /** The editor's text as the file has it. */
  of({ doc }: EditorState): string {
    return doc.sliceString(0, doc.length, this.kind === "CRLF" ? "\r\n" : "\n");
  }
}

function kindOf(text: string): Kind {
  if (!text.includes("\r")) return "LF";
  return /\r(?!\n)|(?<!\r)\n/.test(text) ? "mixed" : "CRLF";
}
