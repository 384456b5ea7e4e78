/** What closes the loops of a robot, and which of them are open. */

import type { App } from "../app";
import { button, fill, h } from "../ui/dom";
import { apart, count, name } from "../ui/format";

/** Maximum number of open loops that are listed. */
const LISTED = 12;

export function loops(app: App): HTMLElement {
  const keep = h("input", { type: "checkbox", id: "keep-closed" });
  keep.addEventListener("change", () => {
    app.store.set({ keepClosed: keep.checked });
    // From where they are, the loops close again.
    if (keep.checked) void app.reach(app.store.now.q);
  });
  const said = h("p", { class: "loops-said", "aria-live": "polite" });
  const open = h("ul", { class: "notes bad" });
  const closed = button("Closed", "A configuration in which all loops are closed, as the URDD has it", () => {
    const q = app.store.now.robot?.about.loops?.reference;
    if (q) app.move(q);
  });
  const block = h(
    "div",
    { class: "loops", role: "group", "aria-label": "Loops" },
    h("div", { class: "check" }, keep, h("label", { for: keep.id }, "Keep loops closed"), closed),
    said,
    open,
  );
  app.store.on(["robot", "keepClosed"], ({ robot, keepClosed }) => {
    block.hidden = !robot?.about.loops;
    keep.checked = keepClosed;
  });
  app.store.on(["robot", "loops", "units"], ({ robot, loops: errors }) => {
    const known = robot?.about.loops;
    if (!known || !errors) {
      fill(open);
      said.textContent = "";
      return;
    }
    const lines = known.loops.flatMap((one, k) => {
      const gap = errors.gaps[k];
      const text = gap ? apart(one, gap) : null;
      return text === null ? [] : [`${name(one.name)}: ${text} apart`];
    });
    const all = [count(known.loops.length, "loop"), count(known.couplings.length, "coupling")];
    const words = all.filter((_, k) => [known.loops, known.couplings][k]?.length).join(" and ");
    said.textContent = errors.is_closed
      ? `${words}, closed. ${count(known.independent.length, "DOF")} ${known.independent.length === 1 ? "moves" : "move"} freely.`
      : lines.length > 0
        ? `${lines.length} of ${count(known.loops.length, "loop")} open:`
        : known.couplings.length > 0
          ? "A coupling does not hold here."
          : "Not closed to 1e-9 here.";
    said.classList.toggle("bad", !errors.is_closed);
    const more = lines.length - LISTED;
    fill(open, ...lines.slice(0, LISTED).map((line) => h("li", {}, line)), more > 0 && h("li", {}, `and ${more} more`));
  });
  return block;
}
