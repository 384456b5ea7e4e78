/** The look of the editor, in the colours of the page: their variables are inherited. */

import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { EditorView } from "@codemirror/view";
import { tags } from "@lezer/highlight";

const theme = EditorView.theme({
  "&": { height: "100%", color: "var(--text)", backgroundColor: "var(--back)", fontSize: "12.5px" },
  "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "-2px" },
  ".cm-scroller": { fontFamily: 'ui-monospace, "DejaVu Sans Mono", monospace', lineHeight: "1.5" },
  ".cm-content": { caretColor: "var(--text)" },
  "&.cm-focused > .cm-scroller > .cm-cursorLayer .cm-cursor": { borderLeftColor: "var(--text)" },
  "& > .cm-scroller > .cm-selectionLayer .cm-selectionBackground": { background: "var(--line)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground": { background: "var(--accent-back)" },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--dim)", borderRight: "1px solid var(--line)" },
  ".cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--raised) 60%, transparent)" },
  ".cm-activeLineGutter": { backgroundColor: "var(--raised)", color: "var(--text)" },
  "&.cm-focused .cm-matchingBracket": { backgroundColor: "var(--accent-back)" },
  ".cm-specialChar": { color: "var(--error)" },
  ".cm-selectionMatch": { backgroundColor: "var(--raised)" },
  ".cm-searchMatch": { backgroundColor: "color-mix(in srgb, var(--mark) 35%, transparent)" },
  ".cm-searchMatch-selected": { backgroundColor: "color-mix(in srgb, var(--mark) 70%, transparent)" },
  ".cm-panels": { backgroundColor: "var(--panel)", color: "var(--text)" },
  ".cm-panels.cm-panels-top": { borderBottom: "1px solid var(--line)" },
  ".cm-panels.cm-panels-bottom": { borderTop: "1px solid var(--line)" },
  ".cm-textfield": {
    backgroundColor: "var(--raised)",
    color: "var(--text)",
    border: "1px solid var(--line)",
    borderRadius: "6px",
  },
  ".cm-button": {
    backgroundImage: "none",
    backgroundColor: "var(--raised)",
    color: "var(--text)",
    border: "1px solid var(--line)",
    borderRadius: "6px",
  },
  ".cm-panel.cm-search": { font: "12.5px system-ui, 'DejaVu Sans', sans-serif" },
  ".cm-panel.cm-search :is(input, button, label)": { fontSize: "inherit" },
  ":focus-visible": { outline: "2px solid var(--accent)", outlineOffset: "1px" },
  ".cm-panel.cm-search [name=close]": { color: "var(--text)" },
  ".cm-tooltip": {
    maxWidth: "min(420px, 90vw)",
    backgroundColor: "var(--panel)",
    color: "var(--text)",
    border: "1px solid var(--line)",
    borderRadius: "7px",
    boxShadow: "0 8px 24px rgb(0 0 0 / 35%)",
  },
  ".cm-diagnostic": { whiteSpace: "pre-wrap", overflowWrap: "anywhere", borderLeftWidth: "3px" },
  ".cm-diagnostic-error": { borderLeftColor: "var(--error)" },
  ".cm-diagnostic-warning": { borderLeftColor: "var(--warning)" },
  ".cm-diagnostic-info": { borderLeftColor: "var(--info)" },
  ".cm-diagnostic .programs": { color: "var(--dim)" },
  ".cm-diagnostic code": { fontFamily: 'ui-monospace, "DejaVu Sans Mono", monospace', fontSize: "0.94em" },
  ".cm-diagnosticAction": {
    margin: "4px 4px 0 0",
    padding: "2px 8px",
    backgroundColor: "var(--accent)",
    color: "var(--on-accent)",
    borderRadius: "6px",
  },
  ".cm-lintRange": { backgroundImage: "none", textDecoration: "underline wavy 1.2px", textUnderlineOffset: "3px" },
  ".cm-lintRange-error": { textDecorationColor: "var(--error)" },
  ".cm-lintRange-warning": { textDecorationColor: "var(--warning)" },
  ".cm-lintRange-info": { textDecorationColor: "var(--info)" },
  ".cm-lintPoint:after": { display: "none" },
  ".cm-lint-marker": { content: "none", width: "9px", height: "9px", margin: "5px auto 0" },
  ".cm-lint-marker-error": { backgroundColor: "var(--error)", borderRadius: "50%" },
  ".cm-lint-marker-warning": { backgroundColor: "var(--warning)", clipPath: "polygon(50% 0, 100% 100%, 0 100%)" },
  ".cm-lint-marker-info": { backgroundColor: "var(--info)" },
});

const colours = HighlightStyle.define([
  { tag: tags.tagName, color: "var(--accent)" },
  { tag: [tags.angleBracket, tags.definitionOperator], color: "var(--dim)" },
  { tag: tags.attributeName, color: "var(--info)" },
  { tag: tags.attributeValue, color: "var(--good)" },
  { tag: [tags.comment, tags.blockComment, tags.processingInstruction], color: "var(--dim)", fontStyle: "italic" },
  { tag: tags.invalid, color: "var(--error)" },
]);

export const look = [theme, syntaxHighlighting(colours)];
