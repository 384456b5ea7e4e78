/** Keyboard shortcuts. Inactive while the user types. */

import type { App } from "./app";
import type { Stage } from "./stage";
import { undo } from "./skips";
import { TABS, hasTab } from "./state";

export function keys(app: App, stage: Stage | null): void {
  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    const isField = /^(?:INPUT|SELECT|TEXTAREA)$/.test(target.tagName);
    const types = isField && !/^(?:range|checkbox)$/.test(target.getAttribute("type") ?? "");
    if ((event.ctrlKey || event.metaKey) && !event.altKey && !types) {
      const again = event.key === "y" || (event.key.toLowerCase() === "z" && event.shiftKey);
      if (!again && event.key !== "z") return;
      event.preventDefault();
      // In Skips, undo applies to edits.
      if (app.store.now.tab === "Skips" && !again) void undo(app);
      else if (app.store.now.robot?.moves) app.step(again ? "forth" : "back");
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Escape") {
      app.store.set({ pair: null, selected: null, unfolded: null });
      stage?.measure.use(false);
      return;
    }
    if (isField) return;
    const number = Number(event.key);
    const tab = TABS[number - 1];
    if (tab && hasTab(tab, app.store.now)) {
      app.store.set({ tab, unfolded: "panels" });
    } else if (event.key === "/") {
      event.preventDefault();
      app.store.set({ unfolded: "links" });
      document.getElementById("find")?.focus();
    } else if (event.key === " " && target.tagName !== "BUTTON") {
      event.preventDefault();
      dispatchEvent(new Event("urdd-play"));
    } else if (event.key === "r") dispatchEvent(new Event("urdd-random"));
    else if (event.key === "f") stage?.look("fit");
    else if (event.key === "g") stage?.gizmo.next();
    else if (event.key === "z") {
      const zero = app.store.now.robot?.about.zero;
      if (zero) app.move(zero);
    } else if (event.key === "h") {
      const { selected, hidden } = app.store.now;
      if (selected?.kind === "link") app.hide([selected.index], !hidden.has(selected.index));
    }
  });
}
