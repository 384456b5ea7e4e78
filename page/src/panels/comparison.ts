/** The choice of a robot to compare with, and what differs. */

import type { App } from "../app";
import { CHANGE_COLORS } from "../compared";
import type { Change } from "../compared";
import { button, fill, h } from "../ui/dom";
import { count, name } from "../ui/format";

/** Maximum number of links that are listed. */
const LISTED = 200;

export function chooseOther(app: App): HTMLElement {
  const select = h("select", {
    "aria-label": "Compare with",
    title: "Draw another robot of the list beside this one, and what differs in colour",
  });
  select.addEventListener("change", () => {
    app.store.set({ compareWith: select.value || null });
  });
  app.store.on(["robot", "entries", "compareWith"], ({ robot, entries, compareWith }) => {
    const others = robot && robot.entry.id !== "" ? entries.filter(({ id }) => id !== robot.entry.id) : [];
    select.hidden = others.length === 0;
    fill(
      select,
      h("option", { value: "" }, compareWith === null ? "Compare with…" : "Compare with none"),
      ...others.map(({ id, name: text }) => h("option", { value: id, selected: id === compareWith }, name(text))),
    );
  });
  return select;
}

export function comparison(app: App): HTMLElement {
  const element = h("div", { class: "compared", role: "status", hidden: true });
  const away = button("✕", { class: "tiny", "aria-label": "End the comparison" }, () => {
    app.store.set({ compareWith: null });
  });
  app.store.on(["compared", "units"], ({ compared, robot }) => {
    element.hidden = !compared;
    if (!compared || !robot) return;
    const { changes, model } = compared;
    const of = (change: Change): string[] => {
      const n = changes.filter((one) => one.change === change).length;
      return n > 0 ? [`${n} ${change}`] : [];
    };
    const said = (["new", "gone", "moved", "changed"] as const).flatMap(of).join(", ");
    const items = changes.slice(0, LISTED).map(({ link, change, what }) => {
      const index = robot.link(link);
      const mark = h("span", { class: "mark" }, "■ ");
      mark.style.color = `var(${CHANGE_COLORS[change]})`;
      const text = name(link);
      const named = index < 0 ? text : button(text, { class: "place" }, () => app.select({ kind: "link", index }));
      return h("li", {}, mark, named, ` ${what === "" ? change : what}`);
    });
    fill(
      element,
      h(
        "div",
        {},
        h("strong", {}, `Left: ${name(model.entry.name)}`),
        h(
          "p",
          {},
          changes.length === 0
            ? "No link, joint, mass or shape differs."
            : `${count(changes.length, "link differs", "links differ")}: ${said}`,
        ),
        h("ul", {}, ...items),
        changes.length > LISTED && h("p", {}, `and ${changes.length - LISTED} more`),
      ),
      away,
    );
  });
  return element;
}
