/** The validator's report, grouped and filtered, in the order in which to fix it; and a finding with its places and its rule's explanation. */

import type { App } from "../app";
import type { Finding, Severity, UrddReport } from "../engine/protocol";
import { linkOf, namedLinks, paintNow, paintOf, places, tally, toMend, CONSEQUENCES } from "../findings";
import type { State } from "../state";
import { button, fill, h, prose } from "../ui/dom";
import { message, count, name } from "../ui/format";
import { folded, keep, keyed } from "../ui/opened";
import type { Opened } from "../ui/opened";
import { placeList } from "./places";
import { programs } from "./programs";

const SEVERITIES: readonly Severity[] = ["error", "warning", "info"];
const GROUPS = ["severity", "module", "link"] as const;
type Grouping = (typeof GROUPS)[number];

export function findings(app: App): HTMLElement {
  const off = new Set<Severity>();
  let grouping: Grouping = "severity";
  let listed: Opened | null = null;
  const search = h("input", { type: "search", placeholder: "Filter", "aria-label": "Filter findings" });
  const by = h(
    "select",
    { "aria-label": "Group findings by" },
    ...GROUPS.map((group) => h("option", { value: group }, `by ${group}`)),
  );
  const toggles = SEVERITIES.map((severity) => {
    const made = button(severity, { class: `chip ${severity}`, "aria-pressed": "true" }, () => {
      if (off.has(severity)) off.delete(severity);
      else off.add(severity);
      render();
    });
    return [severity, made] as const;
  });
  const verdict = h("p", { class: "verdict", "aria-live": "polite" });
  const list = h("div", { class: "findings" });
  const tools = h(
    "div",
    {},
    h("div", { class: "actions" }, ...toggles.map(([, toggle]) => toggle)),
    h("div", { class: "actions" }, search, by),
    painting(app),
  );
  const chips = programs(app);
  const panel = h("div", { class: "panel" }, verdict, chips.element, tools, list);
  const validate = button("Validate", {}, () => void app.loadReport());

  const render = (): void => {
    const { report: state, robot, loading, opened } = app.store.now;
    const urdd = state.report?.urdds[0];
    const counts = state.report ? tally(state.report) : null;
    if (!urdd && opened === listed && state.error === null && (robot ?? loading) !== null) {
      // Another version of the robot is read: what was found stays where it is until the next report.
      verdict.className = "verdict";
      fill(verdict, state.busy ?? "The robot has changed.");
      return;
    }
    listed = urdd ? opened : null;
    for (const [severity, button] of toggles) {
      const n = counts?.[severity] ?? 0;
      button.textContent = count(n, severity, severity === "info" ? "info" : undefined);
      button.setAttribute("aria-pressed", String(!off.has(severity)));
      button.hidden = n === 0;
    }
    verdict.className = `verdict ${urdd ? answer(urdd) : ""}`;
    tools.hidden = !urdd;
    search.hidden = by.hidden = (urdd?.findings.length ?? 0) < 2;
    chips.show(urdd);
    if (!urdd || !counts) {
      fill(
        verdict,
        state.error ? `The robot cannot be validated: ${state.error} ` : (state.busy ?? ""),
        robot && !state.busy && validate,
      );
      fill(list);
      return;
    }
    const settings = state.report?.settings;
    fill(verdict, words(urdd, counts));
    if (settings?.file) {
      const said = settings.fault
        ? `Without your settings: ${settings.fault}`
        : `With the settings of ${settings.file}.`;
      verdict.append(h("span", { class: "hint" }, ` ${name(said)}`));
    }
    const wanted = search.value.trim().toLowerCase();
    const shown = toMend(urdd.findings).filter(
      (finding) =>
        !off.has(finding.severity) && (wanted === "" || JSON.stringify(finding).toLowerCase().includes(wanted)),
    );
    const groups = new Map<string, Finding[]>();
    for (const finding of shown) {
      for (const [key, part] of groupsOf(app, finding, grouping)) groups.set(key, [...(groups.get(key) ?? []), part]);
    }
    fill(
      list,
      imported(opened, urdd),
      ...[...groups].flatMap(([key, found]) => [
        h("h2", {}, `${key}: ${sum(found).toLocaleString("en")}, of ${count(found.length, "kind")}`),
        ...keyed(found, ({ code }) => `${key}\n${code}`).map(([key, finding]) => card(app, key, finding)),
      ]),
      shown.length === 0 && urdd.findings.length > 0 && h("p", { class: "empty" }, "No finding matches the filter."),
      ...notVerified(urdd),
    );
  };
  search.addEventListener("input", render);
  by.addEventListener("change", () => {
    grouping = by.value as Grouping;
    render();
  });
  app.store.on(["report", "robot", "failure"], render);
  app.store.on(["tab", "robot"], ({ tab, robot }) => {
    if (tab === "Findings" && robot) void app.loadReport();
  });
  return panel;
}

function sum(findings: readonly Finding[]): number {
  return findings.reduce((sum, { count }) => sum + count, 0);
}

/** The verdict, where a pass of which a part was not examined is none. */
function answer(urdd: UrddReport): string {
  const open = urdd.geometry_not_verified.length > 0 || urdd.model_not_verified !== null;
  return urdd.verdict === "pass" && open ? "part" : urdd.verdict;
}

function words(urdd: UrddReport, counts: ReturnType<typeof tally>): string {
  const found = `${count(counts.all, "finding")}: ${count(counts.error, "error")}, ${count(counts.warning, "warning")}, ${counts.info} info.`;
  switch (urdd.verdict) {
    case "pass": {
      const links = urdd.geometry_not_verified.length;
      if (answer(urdd) === "part") {
        const open = links > 0 ? `the geometry of ${count(links, "link")}` : "the self-collision model";
        return `Passes in part: ${open} was not examined. ${found}`;
      }
      return urdd.findings.length === 0 ? "Passes: no findings." : `Passes. ${found}`;
    }
    case "fail":
      return `Fails. ${found}`;
    case "incomplete":
      return `Not fully examined: ${urdd.reason ?? "the validator stopped"}`;
    default:
      return `Not examined: ${urdd.reason ?? ""}`;
  }
}

/** The groups of a finding. Grouping by links splits its places. */
function groupsOf(app: App, finding: Finding, grouping: Grouping): [string, Finding][] {
  if (grouping === "severity")
    return [[{ error: "Errors", warning: "Warnings", info: "Info" }[finding.severity], finding]];
  if (grouping === "module")
    return [[typeof finding["module"] === "string" ? finding["module"] : "No module", finding]];
  const { robot } = app.store.now;
  const all = places(finding);
  const parts = new Map<string, unknown[]>();
  for (const place of all) {
    const link = robot ? linkOf(robot, place) : null;
    const key = link === null ? NO_LINK : name(robot?.nameOf(link) ?? "");
    parts.set(key, [...(parts.get(key) ?? []), place]);
  }
  const cut = finding.count - all.length;
  if (cut > 0 && !parts.has(NO_LINK)) parts.set(NO_LINK, []);
  return [...parts].map(([key, places]) => [
    key,
    { ...finding, places, count: places.length + (key === NO_LINK ? cut : 0) },
  ]);
}

const NO_LINK = "No link, or unknown";

/** The selection of what links are painted by, with a legend. */
function painting(app: App): HTMLElement {
  const choice = h("select", { id: "painted" });
  const legend = h("p", { class: "legend" });
  choice.addEventListener("change", () => {
    const { value } = choice;
    app.store.set({ painted: value === "" ? null : value === "worst" ? "worst" : { code: value } });
  });
  app.store.on(["robot", "report"], ({ robot, report: { report } }) => {
    const named = robot ? namedLinks(robot, report) : [];
    fill(
      choice,
      h("option", { value: "" }, "no links"),
      h("option", { value: "worst" }, "by their worst finding"),
      ...named.map(({ code, links }) => h("option", { value: code }, `${code}: ${count(links.size, "link")}`)),
    );
  });
  app.store.on(["robot", "report", "painted", "tab"], (state) => {
    const by = paintNow(state);
    choice.value = by === null ? "" : by === "worst" ? "worst" : by.code;
    // A new report may no longer have the rule.
    if (choice.selectedIndex < 0) choice.value = "";
    fill(legend, ...keys(state));
  });
  return h("div", {}, h("div", { class: "check" }, h("label", { for: "painted" }, "Paint"), choice), legend);
}

function keys(state: Readonly<State>): Node[] {
  const { robot } = state;
  const { report } = state.report;
  const painted = paintNow(state);
  if (!robot || !report || painted === null) return [];
  const worst = [...paintOf(robot, report, painted).values()];
  const n = (kind: string): number => worst.filter((one) => one === kind).length;
  const rest = robot.links.length - worst.length;
  const kinds = [
    ["error", n("error"), "with errors"],
    ["warning", n("warning"), "with warnings"],
    ["info", n("info"), "with info"],
    ["unverified", n("unverified"), "not verified"],
    ["good", rest, painted === "worst" ? "without" : "not named"],
  ] as const;
  const left = painted === "worst" ? namedLinks(robot, report).filter(({ isSystematic }) => isSystematic) : [];
  return [
    ...kinds.flatMap(([kind, n, text]) =>
      n > 0 ? [h("span", {}, h("span", { class: `dot ${kind}` }), ` ${count(n, "link")} ${text}`)] : [],
    ),
    ...(left.length > 0
      ? [
          h(
            "span",
            { class: "hint" },
            `Not shown: ${left.map(({ code, links }) => `${code} (${links.size} of ${count(robot.links.length, "link")})`).join(", ")}. Choose one to see its links.`,
          ),
        ]
      : []),
  ];
}

/** What was not verified: grey, not green. Rules about missing modules come last. */
function notVerified(urdd: UrddReport): Node[] {
  const links = urdd.geometry_not_verified;
  if (urdd.not_checked.length === 0 && links.length === 0) return [];
  const reasons = [...new Set(links.flatMap((link) => link.reasons))];
  return [
    h("h2", {}, "Not examined"),
    ...(links.length > 0 ? [unexamined(`the geometry of ${count(links.length, "link")}`, reasons)] : []),
    ...urdd.not_checked.map(({ codes, reason }) =>
      unexamined(codes.slice(0, 6).join(", ") + (codes.length > 6 ? ` and ${codes.length - 6} more` : ""), [reason]),
    ),
  ];
}

function unexamined(what: string, reasons: readonly string[]): HTMLElement {
  return h(
    "article",
    { class: "finding unverified" },
    h("div", { class: "heading" }, h("span", { class: "dot unverified" }), h("strong", {}, what)),
    ...reasons.map((reason) => h("p", {}, ...prose(name(reason)))),
  );
}

/** A finding: its message, its places, and the explanation of its rule. */
function card(app: App, key: string, finding: Finding): HTMLElement {
  const { opened } = app.store.now;
  const explanation = h("div", { class: "explanation" });
  const explained = `${key}\nexplanation`;
  const made = button("Explain", { class: "tiny" }, () => {
    keep(opened, explained, explanation.childElementCount === 0);
    void explain(app, finding.code, explanation);
  });
  if (opened.has(explained)) void explain(app, finding.code, explanation);
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
    placeList(app, key, places(finding), finding.count),
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

/** What an import made of an MJCF, SDF or USD, folded: what is lost, what is otherwise, and what was assumed. Nothing of a URDF. */
function imported(opened: Opened, { imported }: UrddReport): HTMLElement | false {
  if (!imported) return false;
  const { format, lost, otherwise, notes } = imported;
  const lines = [
    ...lost.map(({ what, count }) => `Lost: ${what} (${count})`),
    ...otherwise.map(({ what, count, how }) => `${what} (${count}): ${how ?? ""}`),
    ...notes,
  ];
  const losses = lost.length > 0 ? `, ${count(lost.length, "kind of thing is", "kinds of things are")} lost` : "";
  return folded(
    opened,
    "imported",
    { class: "imported" },
    `Imported from ${format.toUpperCase()}${losses}`,
    h("ul", {}, ...lines.map((line) => h("li", {}, name(line)))),
  );
}
