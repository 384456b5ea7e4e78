/** The text that the robot is made of: an editor with findings and fixes, which is loaded when it is first opened. */

import type { App } from "../app";
import type { Editor } from "../editor/editor";
import type { Mark, Found } from "../editor/marks";
import type { Deed, Report } from "../engine/protocol";
import { places } from "../findings";
import { fileName, hasFixes, isDraft, fixesOf } from "../fixes";
import { named } from "../site";
import { ofText } from "../state";
import type { TextDraft, Draft } from "../state";
import { button, fill, h, prose } from "../ui/dom";
import { offer } from "../ui/files";
import { message, count, name } from "../ui/format";
import { fixButton } from "./places";
import { DEEDS } from "./programs";

/** Numbers of characters from which a text is without colours, and from which it is only shown. */
const PLAIN = 2e6;
const SHOWN_ONLY = 10e6;
/** Number of findings below the text. */
const LISTED = 20;

export function text(app: App): HTMLElement {
  const file = h("strong", { class: "name" });
  const changed = h("span", { class: "chip warning" }, "changed");
  const all = button("", { title: "Make every fix that has one right answer, as `urdd lint --fix` does" }, () =>
    editor?.fixAll(),
  );
  const steps = [
    button("↶", { "aria-label": "Undo", title: "Undo (Ctrl-Z)" }, () => editor?.undo()),
    button("↷", { "aria-label": "Redo", title: "Redo (Ctrl-Shift-Z)" }, () => editor?.redo()),
    button("Find", "Find and replace (Ctrl-F)", () => editor?.find()),
  ];
  const save = (): void => saveDraft(app);
  const saving = button("Save", { class: "main", title: "Download the text as a file (Ctrl-S)" }, save);
  const hint = h("p", { class: "hint" });
  const host = h("div", { class: "editor" });
  const below = h("div", { class: "here", "aria-live": "polite" });
  const wait = h("p", { class: "hint", role: "status" });
  const panel = h(
    "div",
    { class: "panel text" },
    h("div", { class: "actions" }, file, changed, all, ...steps, saving),
    hint,
    wait,
    host,
    below,
  );
  let editor: Editor | null = null;
  let loading = false;
  /** The draft in the editor. */
  let shown: { path: string; text: string } | null = null;
  let marked: object | null = null;
  /** What is listed below the text: a button that has the focus stays. */
  let listed: readonly unknown[] = [];

  // Keys in the text are not those of the page.
  host.addEventListener("keydown", (event) => event.stopPropagation());
  addEventListener("beforeunload", (event) => {
    if (app.store.now.draft?.isChanged) event.preventDefault();
  });

  async function load(): Promise<void> {
    loading = true;
    fill(wait, "Loading the editor");
    try {
      const address = new URL(named("editor.js"), document.baseURI).href;
      const bundle = (await import(address)) as typeof import("../editor/editor");
      editor = new bundle.Editor(host.shadowRoot ?? host.attachShadow({ mode: "open" }), {
        changed: (text) => {
          if (shown) shown.text = text;
          if (text !== app.store.now.draft?.text) app.site.here?.edit(text);
        },
        moved: list,
        save,
        note: (text) => app.note(text),
      });
      fill(wait);
      follow();
    } catch (error) {
      fill(
        wait,
        `The editor cannot be loaded: ${message(error)} `,
        button("Try again", {}, () => void load()),
      );
    } finally {
      loading = false;
    }
  }

  /** Puts the draft and its findings into the editor. */
  function follow(): void {
    const { tab } = app.store.now;
    const draft = ofText(app.store.now.draft);
    if (!draft) shown = null;
    if (!draft || tab !== "Text") return;
    if (!editor) {
      if (!loading) void load();
      return;
    }
    const isOpen = shown?.path === draft.path;
    if (!isOpen || (shown?.text !== draft.text && !editor.replace(draft.text))) open(editor, draft);
    else shown = { path: draft.path, text: draft.text };
    mark(editor, draft);
    const { textAt } = app.store.now;
    if (textAt) {
      app.store.set({ textAt: null });
      requestAnimationFrame(() => editor?.go(textAt.line, textAt.column));
    }
    tell(draft);
  }

  function open(editor: Editor, { path, text }: TextDraft): void {
    shown = { path, text };
    marked = null;
    editor.open({
      text,
      label: `Text of ${name(path)}`,
      isReadOnly: text.length > SHOWN_ONLY,
      isHighlighted: text.length <= PLAIN,
    });
  }

  /** Marks the findings of a report, if it is of the present text. */
  function mark(editor: Editor, draft: TextDraft): void {
    const { report } = app.store.now.report;
    if (!report || report === marked) return;
    const isNow = report.text === draft.text || (report.text === null && !draft.isChanged);
    if (!isNow) return;
    marked = report;
    editor.mark(foundIn(report, draft), (file) => isDraft(draft, file) && hasFixes(draft));
  }

  function tell(draft: TextDraft): void {
    fill(file, name(fileName(draft)));
    file.title = name(draft.path);
    saving.textContent = `Save ${draft.format.toUpperCase()}`;
    changed.hidden = !draft.isChanged;
    const n = editor?.safeCount ?? 0;
    all.hidden = n === 0;
    fill(all, `Fix all that is safe (${n.toLocaleString("en")})`);
    const isReadOnly = editor?.isReadOnly ?? false;
    for (const step of steps.slice(0, 2)) step.hidden = isReadOnly;
    const { busy } = app.store.now.report;
    const hints = [
      isReadOnly && `This text is too large to change here (${count(draft.text.length, "character")}).`,
      !hasFixes(draft) &&
        "Fixes are for the URDF that the import makes, so none is offered here: `urdd import` writes that URDF.",
      busy !== null && `${busy}…`,
    ];
    fill(hint, ...hints.filter((hint) => hint !== false).flatMap((hint, k) => [k > 0 && " ", ...prose(hint)]));
    hint.hidden = hint.childElementCount === 0 && hint.textContent === "";
  }

  /** Lists what was found in the line with the cursor. */
  function list(): void {
    if (!editor) return;
    const { line, marks } = editor.here();
    const draft = ofText(app.store.now.draft);
    if (draft) tell(draft);
    const { all, marked } = editor.counts;
    const where =
      marks.length > 0
        ? `Line ${line}: ${count(marks.length, "finding")}`
        : `${count(all, "finding")} in this text${marked < all ? `, of which the worst ${marked.toLocaleString("en")} are marked` : ""}`;
    below.hidden = marked === 0;
    const now = [where, ...marks];
    if (now.length === listed.length && now.every((each, k) => each === listed[k])) return;
    listed = now;
    fill(
      below,
      h(
        "div",
        { class: "headline" },
        h("h2", {}, where),
        h("span", { class: "spring" }),
        button("Next", { class: "tiny", title: "Go to the next finding (F8)" }, () => editor?.next()),
      ),
      ...marks.slice(0, LISTED).map((mark) => card(mark)),
      marks.length > LISTED && h("p", { class: "hint" }, `${marks.length - LISTED} more`),
    );
  }

  function card({ found, remedies }: Mark): HTMLElement {
    const fixes = remedies.map((remedy) => fixButton(remedy, () => editor?.mend(remedy)));
    return h(
      "article",
      { class: `finding ${found.severity}` },
      h("p", {}, h("strong", {}, `${found.code} `), ...prose(name(found.message))),
      found.programs !== "" && h("p", { class: "hint" }, found.programs),
      fixes.length > 0 && h("div", { class: "actions" }, ...fixes),
    );
  }

  app.store.on(["draft", "tab", "report", "textAt"], follow);
  return panel;
}

/** Downloads the text as it is now. */
export function saveDraft(app: App): void {
  const draft = ofText(app.store.now.draft);
  if (!draft) return;
  offer(new Blob([draft.text], { type: "application/xml" }), fileName(draft));
  app.site.here?.saved();
}

/** The findings of a report that have a line of the draft. */
function foundIn(report: Report, draft: Draft): Found[] {
  const urdd = report.urdds[0];
  if (!urdd) return [];
  const names = new Map(urdd.programs.map(({ program, name }) => [program, name]));
  return urdd.findings.flatMap((finding) => {
    const { code, severity, message } = finding;
    const deeds = new Map<Deed, string[]>();
    for (const { program, does } of finding.programs)
      deeds.set(does, [...(deeds.get(does) ?? []), names.get(program) ?? program]);
    const programs = [...deeds].map(([deed, names]) => `${DEEDS[deed]}: ${names.join(", ")}`).join(" · ");
    return places(finding).flatMap((place) => {
      if (place.line === null || !isDraft(draft, place.file)) return [];
      const { line, column, message: here } = place;
      return [{ code, severity, message: here ?? message, programs, line, column, fixes: fixesOf(draft, place) }];
    });
  });
}
