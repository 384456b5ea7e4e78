/** A finding: its message, its places with expected and found values and their text, and the rule's explanation. */

import type { App } from "../app";
import { message } from "../app";
import type { Finding } from "../engine/protocol";
import { CONSEQUENCES, places } from "../findings";
import { button, fill, h, prose } from "../ui/dom";
import { count, name } from "../ui/format";
import { placeList } from "./places";

export function card(app: App, finding: Finding): HTMLElement {
  const explanation = h("div", { class: "explanation" });
  const made = button("Explain", { class: "tiny" }, () => void explain(app, finding.code, explanation));
  const consequence = CONSEQUENCES.get(String(finding["consequence"]));
  return h(
    "article",
    { class: `finding ${finding.severity}` },
    h(
      "div",
      { class: "heading" },
      h("span", { class: `dot ${finding.severity}` }),
      h("strong", {}, finding.code),
      h("span", { class: "name", title: finding.name }, finding.name),
      h("span", { class: "spring" }),
      made,
    ),
    h("p", {}, ...prose(name(finding.message))),
    h("p", { class: "hint" }, [consequence, count(finding.count, "place")].filter(Boolean).join(" · ")),
    placeList(app, places(finding), finding.count),
    explanation,
  );
}

async function explain(app: App, code: string, into: HTMLElement): Promise<void> {
  if (into.childElementCount > 0) {
    fill(into);
    return;
  }
  try {
    const known = app.store.now.report.report?.rules?.find((rule) => rule.code === code);
    const rule = known ?? app.site.explanation(code) ?? (await app.engine.ask("explain", { code }));
    fill(
      into,
      rule.clause !== null && h("p", { class: "hint" }, `SPEC ${rule.clause}`),
      ...rule.explanation.split("\n\n").map(paragraph),
    );
  } catch (error) {
    fill(into, h("p", { class: "hint" }, message(error)));
  }
}

/** A paragraph, or a list of lines that begin with a dash. */
function paragraph(text: string): HTMLElement {
  if (!text.startsWith("- ")) return h("p", {}, ...prose(text));
  const items = text.slice(2).split("\n- ");
  return h("ul", {}, ...items.map((item) => h("li", {}, ...prose(item))));
}
