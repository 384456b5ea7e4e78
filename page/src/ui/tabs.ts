/** Tabs as the ARIA practices have them: arrows move between them. */

import type { App } from "../app";
import { TABS } from "../state";
import type { Tab } from "../state";
import { fill, h } from "./dom";

export function tabs(app: App, panels: Record<Tab, HTMLElement>): HTMLElement {
  const buttons = TABS.map((tab) => {
    const button = h("button", { type: "button", role: "tab", id: `tab-${tab}`, "aria-controls": `panel-${tab}` }, tab);
    button.addEventListener("click", () => {
      app.store.set({ tab });
    });
    return button;
  });
  const list = h("div", { class: "tablist", role: "tablist", "aria-label": "Panels" }, ...buttons);
  list.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const at = TABS.indexOf(app.store.now.tab);
    const next = (at + step + TABS.length) % TABS.length;
    const tab = TABS[next];
    if (tab) app.store.set({ tab });
    buttons[next]?.focus();
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
  app.store.on(["report"], ({ report }) => {
    const n = report.report?.urdds[0]?.findings.length ?? 0;
    const button = buttons[TABS.indexOf("Findings")];
    if (button) fill(button, "Findings", n > 0 && h("span", { class: "badge" }, String(n)));
  });
  return h("aside", { class: "tabs" }, list, ...bodies);
}
