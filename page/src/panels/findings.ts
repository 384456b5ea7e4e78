/** The validator's report: grouped and filtered, with what was expected and found, and what each rule means. */

import type { App } from "../app";
import { message } from "../app";
import type { Finding, Severity, UrddReport } from "../engine/protocol";
import { linkOf, places } from "../findings";
import type { Place } from "../findings";
import { fill, h, prose } from "../ui/dom";
import { count, name } from "../ui/format";

const SEVERITIES: readonly Severity[] = ["error", "warning", "info"];
const GROUPS = ["severity", "module", "link"] as const;
type Grouping = (typeof GROUPS)[number];
/** Places of a finding that are shown at first. */
const SHOWN = 5;

export function findings(app: App): HTMLElement {
  const off = new Set<Severity>();
  let grouping: Grouping = "severity";
  const search = h("input", { type: "search", placeholder: "Filter", "aria-label": "Filter findings" });
  const by = h(
    "select",
    { "aria-label": "Group findings by" },
    ...GROUPS.map((group) => h("option", { value: group }, `by ${group}`)),
  );
  const painted = h("input", { type: "checkbox", id: "painted" });
  const toggles = SEVERITIES.map((severity) => {
    const button = h("button", { type: "button", class: `chip ${severity}`, "aria-pressed": "true" }, severity);
    button.addEventListener("click", () => {
      if (off.has(severity)) off.delete(severity);
      else off.add(severity);
      render();
    });
    return [severity, button] as const;
  });
  const verdict = h("p", { class: "verdict", "aria-live": "polite" });
  const list = h("div", { class: "findings" });
  const tools = h(
    "div",
    {},
    h("div", { class: "actions" }, ...toggles.map(([, button]) => button)),
    h("div", { class: "actions" }, search, by),
    h("div", { class: "check" }, painted, h("label", { for: "painted" }, "Paint links by their worst finding")),
  );
  const panel = h("div", { class: "panel" }, verdict, tools, list);
  const validate = h(
    "button",
    {
      type: "button",
      click: () => {
        void app.loadReport();
      },
    },
    "Validate",
  );

  const render = (): void => {
    const { report: state, robot } = app.store.now;
    const urdd = state.report?.urdds[0];
    for (const [severity, button] of toggles) {
      const n = urdd?.findings.filter((f) => f.severity === severity).reduce((sum, f) => sum + f.count, 0) ?? 0;
      button.textContent = count(n, severity === "info" ? "note" : severity);
      button.setAttribute("aria-pressed", String(!off.has(severity)));
      button.hidden = n === 0;
    }
    verdict.className = `verdict ${urdd?.verdict ?? ""}`;
    tools.hidden = !urdd;
    search.hidden = by.hidden = (urdd?.findings.length ?? 0) < 2;
    if (!urdd) {
      fill(
        verdict,
        state.error ? `The robot cannot be validated: ${state.error} ` : (state.busy ?? ""),
        robot && !state.busy && validate,
      );
      fill(list);
      return;
    }
    fill(verdict, words(urdd));
    const wanted = search.value.trim().toLowerCase();
    const shown = urdd.findings
      .filter(
        (finding) =>
          !off.has(finding.severity) && (wanted === "" || JSON.stringify(finding).toLowerCase().includes(wanted)),
      )
      .sort((a, b) => SEVERITIES.indexOf(a.severity) - SEVERITIES.indexOf(b.severity));
    const groups = new Map<string, Finding[]>();
    for (const finding of shown) {
      const key = groupOf(app, finding, grouping);
      groups.set(key, [...(groups.get(key) ?? []), finding]);
    }
    fill(
      list,
      ...[...groups].flatMap(([key, found]) => [
        h("h2", {}, `${key} (${found.length})`),
        ...found.map((finding) => card(app, finding)),
      ]),
      shown.length === 0 && urdd.findings.length > 0 && h("p", { class: "empty" }, "No finding passes the filter."),
      ...notVerified(urdd),
    );
  };
  search.addEventListener("input", render);
  by.addEventListener("change", () => {
    grouping = by.value as Grouping;
    render();
  });
  painted.addEventListener("change", () => {
    app.store.set({ painted: painted.checked });
  });
  app.store.on(["painted"], ({ painted: on }) => {
    painted.checked = on;
  });
  app.store.on(["report", "robot"], render);
  app.store.on(["tab", "robot"], ({ tab, robot }) => {
    if (tab === "Findings" && robot) void app.loadReport();
  });
  return panel;
}

function words(urdd: UrddReport): string {
  switch (urdd.verdict) {
    case "pass":
      return urdd.findings.length === 0 ? "Passes: nothing was found." : "Passes, with what is below.";
    case "fail":
      return "Fails: it has errors.";
    case "incomplete":
      return `Not fully examined: ${urdd.reason ?? "the validator stopped"}`;
    default:
      return `Cannot be read: ${urdd.reason ?? ""}`;
  }
}

function groupOf(app: App, finding: Finding, grouping: Grouping): string {
  if (grouping === "severity") return { error: "Errors", warning: "Warnings", info: "Notes" }[finding.severity];
  if (grouping === "module") return typeof finding["module"] === "string" ? finding["module"] : "The URDD as a whole";
  const { robot } = app.store.now;
  const [place] = places(finding);
  const link = robot && place ? linkOf(robot, place) : null;
  return link === null ? "No link" : name(robot?.links[link]?.name ?? "");
}

function card(app: App, finding: Finding): HTMLElement {
  const all = places(finding);
  const more = h("div", { class: "explanation" });
  const button = h("button", { type: "button", class: "tiny" }, "Explain");
  button.addEventListener("click", () => {
    void explain(app, finding.code, more);
  });
  const list = h("ul", { class: "places" }, ...all.slice(0, SHOWN).map((place) => placeRow(app, place)));
  if (all.length > SHOWN) {
    const rest = h("button", { type: "button", class: "tiny" }, `${all.length - SHOWN} more`);
    rest.addEventListener("click", () => {
      fill(list, ...all.map((place) => placeRow(app, place)));
    });
    list.append(h("li", {}, rest));
  }
  return h(
    "article",
    { class: `finding ${finding.severity}` },
    h(
      "div",
      { class: "heading" },
      h("span", { class: `dot ${finding.severity}` }),
      h("strong", {}, finding.code),
      h("span", { class: "name", title: finding.name }, finding.name),
      finding.count > 1 && h("span", { class: "kind" }, `× ${finding.count}`),
      h("span", { class: "spring" }),
      button,
    ),
    h("p", {}, ...prose(name(finding.message))),
    list,
    more,
  );
}

function placeRow(app: App, place: Place): HTMLElement | null {
  const { robot } = app.store.now;
  const link = robot ? linkOf(robot, place) : null;
  const where = [
    place.subject,
    place.file ? `${place.file}${place.line ? `:${place.line}` : ""}` : null,
    place.pointer,
  ].filter((text): text is string => Boolean(text));
  const [first] = where;
  if (first === undefined && !place.message && place.expected === null && place.actual === null) return null;
  const go = h("button", { type: "button", class: "place", title: where.map(name).join("\n") });
  fill(go, ...prose(name(first ?? "the URDD as a whole")));
  go.addEventListener("click", () => {
    if (link !== null) app.select({ kind: "link", index: link });
  });
  if (link === null) go.disabled = true;
  return h(
    "li",
    {},
    go,
    place.message && h("span", { class: "what" }, ...prose(name(place.message))),
    (place.expected ?? place.actual) !== null &&
      h(
        "dl",
        {},
        place.expected !== null && h("dt", {}, "expected"),
        place.expected !== null && h("dd", {}, name(place.expected)),
        place.actual !== null && h("dt", {}, "found"),
        place.actual !== null && h("dd", {}, name(place.actual)),
      ),
  );
}

async function explain(app: App, code: string, into: HTMLElement): Promise<void> {
  if (into.childElementCount > 0) {
    fill(into);
    return;
  }
  try {
    const rule = await app.engine.ask("explain", { code });
    fill(
      into,
      h("p", { class: "hint" }, `SPEC ${rule.clause}`),
      ...rule.explanation.split("\n\n").map((text) => h("p", {}, ...prose(text))),
    );
  } catch (error) {
    fill(into, h("p", { class: "hint" }, message(error)));
  }
}

/** What nobody can say of this URDD: grey, not green. Rules about modules that are not here come last. */
function notVerified(urdd: UrddReport): Node[] {
  if (urdd.not_checked.length === 0) return [];
  return [
    h("h2", {}, "Not verified"),
    ...urdd.not_checked.map(({ codes, reason }) =>
      h(
        "article",
        { class: "finding unverified" },
        h(
          "div",
          { class: "heading" },
          h("span", { class: "dot unverified" }),
          h("strong", {}, codes.slice(0, 6).join(", ") + (codes.length > 6 ? ` and ${codes.length - 6} more` : "")),
        ),
        h("p", {}, ...prose(name(reason))),
      ),
    ),
  ];
}
