/** What an import made of an MJCF, SDF or USD: what is lost, what is otherwise, and what was assumed. */

import type { UrddReport } from "../engine/protocol";
import { h } from "../ui/dom";
import { count, name } from "../ui/format";

/** The lines of the report, folded; nothing of a URDF. */
export function imported({ imported }: UrddReport): HTMLElement | false {
  if (!imported) return false;
  const { format, lost, otherwise, notes } = imported;
  const lines = [
    ...lost.map(({ what, count }) => `Lost: ${what} (${count})`),
    ...otherwise.map(({ what, count, how }) => `${what} (${count}): ${how ?? ""}`),
    ...notes,
  ];
  const losses = lost.length > 0 ? `, ${count(lost.length, "kind of thing is", "kinds of things are")} lost` : "";
  return h(
    "details",
    { class: "imported" },
    h("summary", {}, `Imported from ${format.toUpperCase()}${losses}`),
    h("ul", {}, ...lines.map((line) => h("li", {}, name(line)))),
  );
}
