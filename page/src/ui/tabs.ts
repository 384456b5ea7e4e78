/** Tabs as in the ARIA practices: arrow keys move between them. */

import type { App } from "../app";
import { tally } from "../findings";
import { TABS, hasTab } from "../state";
import type { Tab } from "../state";
import { button, fill, h } from "./dom";
import { count } from "./format";

export function tabs(app: App, panels: Record<Tab, HTMLElement>): HTMLElement {
  const buttons = TABS.map((tab) => {
    const made = button(tab, { role: "tab", id: `tab-${tab}`, "aria-controls": `panel-${tab}` }, () => {
      // In narrow windows, a second click folds the panel.
      const { tab: now, unfolded } = app.store.now;
      app.store.set({ tab, unfolded: now === tab && unfolded === "panels" ? null : "panels" });
    });
    return made;
  });
  const list = h("div", { class: "tablist", role: "tablist", "aria-label": "Panels" }, ...buttons);
  list.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const there = TABS.filter((tab) => hasTab(tab, app.store.now));
    const tab = there[(there.indexOf(app.store.now.tab) + step + there.length) % there.length];
    if (!tab) return;
    app.store.set({ tab, unfolded: "panels" });
    buttons[TABS.indexOf(tab)]?.focus();
  });
  const bodies = TABS.map((tab) => {
    const body = h("div", {
      role: "tabpanel",
      id: `panel-${tab}`,
      "aria-labelledby": `tab-${tab}`,
      class: "body",
      tabindex: "0",
    });
    fill(body, panels[tab]);
    return body;
  });
  app.store.on(["tab"], ({ tab }) => {
    TABS.forEach((name, k) => {
      buttons[k]?.setAttribute("aria-selected", String(name === tab));
      buttons[k]?.setAttribute("tabindex", name === tab ? "0" : "-1");
      const body = bodies[k];
      if (body) body.hidden = name !== tab;
    });
  });
  app.store.on(["tab", "draft"], (state) => {
    TABS.forEach((tab, k) => {
      const button = buttons[k];
      if (button) button.hidden = !hasTab(tab, state);
    });
    if (!hasTab(state.tab, state)) app.store.set({ tab: "Joints" });
  });
  app.store.on(["report"], ({ report }) => {
    const counts = report.report ? tally(report.report) : null;
    const kind = counts?.error ? "error" : counts?.warning ? "warning" : "info";
    const button = buttons[TABS.indexOf("Findings")];
    if (!button) return;
    const badge = h("span", { class: `badge ${kind}` }, counts?.all.toLocaleString("en"));
    fill(button, "Findings", counts !== null && counts.all > 0 && badge);
    button.title = counts
      ? `${count(counts.all, "finding")}, as \`urdd ${report.report?.urdds[0]?.kind === "urdf" ? "lint" : "validate"}\` counts them`
      : "";
  });
  const panel = h("aside", { class: "tabs" }, list, ...bodies);
  app.store.on(["unfolded"], ({ unfolded }) => {
    document.documentElement.dataset["unfolded"] = unfolded ?? "";
  });
  return panel;
}
