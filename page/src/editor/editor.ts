/** The editor of the Text panel: a bundle of its own, loaded when the panel is first opened. */

import { defaultKeymap, history, historyKeymap, indentWithTab, redo, undo } from "@codemirror/commands";
import { xmlLanguage } from "@codemirror/lang-xml";
import { bracketMatching, indentUnit } from "@codemirror/language";
import {
  diagnosticCount,
  forEachDiagnostic,
  lintGutter,
  lintKeymap,
  linter,
  nextDiagnostic,
  setDiagnostics,
} from "@codemirror/lint";
import { highlightSelectionMatches, openSearchPanel, search, searchKeymap } from "@codemirror/search";
import { ChangeSet, EditorSelection, EditorState, StateEffect, StateField, Transaction } from "@codemirror/state";
import type { ChangeDesc, Extension } from "@codemirror/state";
import {
  EditorView,
  drawSelection,
  highlightActiveLine,
  highlightActiveLineGutter,
  highlightSpecialChars,
  keymap,
  lineNumbers,
  tooltips,
} from "@codemirror/view";
import type { ViewUpdate } from "@codemirror/view";
import { Lines, outer, safeChanges } from "../edits";
import type { Change } from "../edits";
import { look } from "./look";
import { marksOf } from "./marks";
import type { Found, Mark, Remedy } from "./marks";

/** How often `Fix all` goes on with what a new report finds, as `urdd lint --fix` does. */
const ROUNDS = 10;

/** What the page does when a person works in the text. */
export interface Owner {
  changed(text: string): void;
  /** The cursor moved, or the marks changed. */
  moved(): void;
  save(): void;
  note(text: string): void;
}

export interface Opened {
  text: string;
  /** For screen readers. */
  label: string;
  isReadOnly: boolean;
  isHighlighted: boolean;
}

/** The text was examined as it is: marks are for it from now on. */
const examined = StateEffect.define();

/** The changes since the report. */
const since = StateField.define<ChangeDesc>({
  create: ({ doc }) => ChangeSet.empty(doc.length).desc,
  update: (value, { effects, changes, newDoc }) =>
    effects.some((effect) => effect.is(examined))
      ? ChangeSet.empty(newDoc.length).desc
      : changes.empty
        ? value
        : value.composeDesc(changes.desc),
});

export class Editor {
  private readonly view: EditorView;
  private ends = new LineEnds("");
  private safe: Change[][] = [];
  private rounds = 0;
  /** The number of findings without a mark. */
  private unmarked = 0;

  constructor(
    root: ShadowRoot,
    private readonly owner: Owner,
  ) {
    this.view = new EditorView({ parent: root, root });
  }

  /** Opens a text, without what was done to the last one. */
  open({ text, label, isReadOnly, isHighlighted }: Opened): void {
    this.ends = new LineEnds(text);
    this.safe = [];
    this.rounds = 0;
    this.unmarked = 0;
    const extensions: Extension[] = [
      this.ends.extension,
      lineNumbers(),
      lintGutter(),
      linter(null),
      // A tooltip does not cover the buttons above the text.
      tooltips({ tooltipSpace: ({ dom }) => dom.getBoundingClientRect() }),
      since,
      highlightSpecialChars({ addSpecialChars: /\u200c|\u200d|[\u202a-\u202c\u2060-\u206f]/gu }),
      history(),
      drawSelection(),
      highlightActiveLine(),
      highlightActiveLineGutter(),
      highlightSelectionMatches(),
      search({ top: true }),
      indentUnit.of("  "),
      isHighlighted ? [xmlLanguage, bracketMatching()] : [],
      isReadOnly ? EditorState.readOnly.of(true) : [],
      keymap.of([{ key: "Mod-s", run: () => (this.owner.save(), true) }]),
      keymap.of([...defaultKeymap, ...searchKeymap, ...historyKeymap, ...lintKeymap, indentWithTab]),
      EditorView.contentAttributes.of({
        "aria-label": label,
        tabindex: "0",
        "aria-description": "Escape, then Tab leaves the text. F8 goes to the next finding.",
      }),
      EditorView.updateListener.of((update) => this.updated(update)),
      look,
    ];
    this.view.setState(EditorState.create({ doc: text, extensions }));
    this.owner.moved();
  }

  /** The text as a file has it. */
  get text(): string {
    return this.ends.of(this.view.state);
  }

  get isReadOnly(): boolean {
    return this.view.state.readOnly;
  }

  /** Takes a text that changed elsewhere: the part that differs is one step of the history. */
  replace(text: string): boolean {
    if (!this.ends.fits(text)) return false;
    const now = this.view.state.doc.toString();
    const next = this.ends.inEditor(text);
    const most = Math.min(now.length, next.length);
    let from = 0;
    while (from < most && now.charCodeAt(from) === next.charCodeAt(from)) from++;
    let same = 0;
    while (same < most - from && now.charCodeAt(now.length - 1 - same) === next.charCodeAt(next.length - 1 - same))
      same++;
    this.view.dispatch({ changes: { from, to: now.length - same, insert: next.slice(from, next.length - same) } });
    return true;
  }

  /** Marks what was found in this text. */
  mark(found: readonly Found[], isFile: (file: string) => boolean): void {
    const { state } = this.view;
    const lines = new Lines(state.doc.toString());
    this.safe = this.isReadOnly ? [] : safeChanges(found, lines, isFile);
    const marks = marksOf(
      found,
      lines,
      (file) => !this.isReadOnly && isFile(file),
      (remedy) => this.mend(remedy),
    );
    this.unmarked = found.length - marks.length;
    this.view.dispatch({ effects: examined.of(null) }, setDiagnostics(state, marks));
    if (this.rounds > 0 && this.safe.length > 0) this.mendSafe();
    else this.rounds = 0;
  }

  /** The number of findings in the text, and of those that are marked. */
  get counts(): { all: number; marked: number } {
    const marked = diagnosticCount(this.view.state);
    return { all: this.unmarked + marked, marked };
  }

  /** Goes to the next mark. */
  next(): void {
    nextDiagnostic(this.view);
    this.view.focus();
  }

  /** The number of safe fixes. */
  get safeCount(): number {
    return this.safe.length;
  }

  /** The marks of the line with the cursor. */
  here(): { line: number; marks: Mark[] } {
    const { state } = this.view;
    const line = state.doc.lineAt(state.selection.main.head);
    const marks: Mark[] = [];
    forEachDiagnostic(state, (mark, from) => {
      if (from >= line.from && from <= line.to) marks.push(mark as Mark);
    });
    return { line: line.number, marks };
  }

  mend(remedy: Remedy): void {
    if (!this.change([remedy.changes], "fix")) {
      this.owner.note("This part of the text has changed: wait for its findings.");
    }
    this.view.focus();
  }

  /** Makes all safe fixes, and those that the next reports offer for what is then there. */
  fixAll(): void {
    this.rounds = ROUNDS;
    this.mendSafe();
    this.view.focus();
  }

  private mendSafe(): void {
    const safe = this.safe;
    this.safe = [];
    this.rounds--;
    this.change(safe, "fix.all");
  }

  undo(): void {
    undo(this.view);
    this.view.focus();
  }

  redo(): void {
    redo(this.view);
    this.view.focus();
  }

  find(): void {
    openSearchPanel(this.view);
  }

  /** Puts the cursor at a place of the report, and shows it. */
  go(line: number, column: number | null): void {
    const { state } = this.view;
    // A mark has moved with the text.
    let offset: number | null = null;
    forEachDiagnostic(state, (mark, from) => {
      const { found } = mark as Mark;
      if (found.line === line && found.column === column) offset = from;
    });
    offset ??= new Lines(state.doc.toString()).offset(line, column ?? 1) ?? state.doc.length;
    this.view.dispatch({
      selection: EditorSelection.cursor(offset),
      effects: EditorView.scrollIntoView(offset, { y: "center", x: "nearest", xMargin: 60 }),
    });
    this.view.focus();
  }

  /** Makes changes of the report's text in the present one, except where a person changed it since. */
  private change(fixes: readonly Change[][], how: string): boolean {
    const { state } = this.view;
    const done = state.field(since);
    const isThere = ({ from, to }: Change): boolean => done.touchesRange(from, to) === false;
    const changes = outer(fixes.filter((fix) => fix.every(isThere)).flat());
    if (changes.length === 0) return false;
    this.view.dispatch({
      changes: changes.map(({ from, to, insert }) => ({ from: done.mapPos(from), to: done.mapPos(to), insert })),
      annotations: Transaction.userEvent.of(how),
    });
    this.dropMended();
    return true;
  }

  /** Removes the marks that a fix was just made for. */
  private dropMended(): void {
    const { state } = this.view;
    const done = state.field(since);
    const left: Mark[] = [];
    const isDone = ({ changes }: Remedy): boolean =>
      changes.some(({ from, to }) => done.touchesRange(from, to) !== false);
    forEachDiagnostic(state, (mark, from, to) => {
      if (!(mark as Mark).remedies.some(isDone)) left.push({ ...(mark as Mark), from, to });
    });
    this.view.dispatch(setDiagnostics(state, left));
  }

  private updated({ docChanged, transactions, selectionSet }: ViewUpdate): void {
    if (docChanged) {
      if (!transactions.some((transaction) => transaction.isUserEvent("fix.all"))) this.rounds = 0;
      this.owner.changed(this.text);
    }
    if (docChanged || selectionSet || transactions.some(({ effects }) => effects.length > 0)) this.owner.moved();
  }
}

type Kind = "LF" | "CRLF" | "mixed";

/** Line ends of a file: the editor's text has LF, where all are alike. */
class LineEnds {
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
