/** The appearance of each link: selected, in contact, painted by findings or by parts, or faded. */

import { Color } from "three";
import { placeKey } from "../contacts";
import { CHANGE_COLORS } from "../compared";
import { paintNow, paintOf } from "../findings";
import { partColor } from "../parts";
import { ghosted } from "../state";
import type { LayerKind, State } from "../state";
import { color } from "../ui/theme";
import type { Look } from "./robot";

/** The appearance of faded links. */
const FADED = 0.18;

export function looks(state: Readonly<State>): (link: number, piece: number, layer: LayerKind) => Look {
  const tints = tinted(state);
  const paint = painted(state);
  const { contacts, shapes } = state;
  const touching = new Color(color("--error"));
  const ghost = ghosted(state);
  const isPainted = paintNow(state) !== null || state.compared !== null;
  return (link, piece, layer) => {
    const isExact = layer === shapes;
    const place = layer === "pieces" || layer.startsWith("piece-") ? piece : 0;
    // In the layer of the checked shapes, only the shapes that touch; in other layers the whole link.
    const touches =
      !isPainted &&
      (isExact ? (contacts?.places.has(placeKey(link, place)) ?? false) : (contacts?.links.has(link) ?? false));
    let fade = 1;
    if (ghost) {
      const isOne = ghost.some(([other, k]) => other === link && k === place);
      fade = isExact && isOne ? 1 : ghost.some(([other]) => other === link) ? 0.3 : FADED;
    }
    return { tint: tints.get(link) ?? (touches ? touching : null), fade, paint: touches ? touching : paint(link) };
  };
}

function tinted({ robot, selected, hovered, pair, tab }: Readonly<State>): Map<number, Color> {
  const tints = new Map<number, Color>();
  const tint = (link: number | null | undefined, name: string): void => {
    if (link !== null && link !== undefined) tints.set(link, new Color(color(name)));
  };
  if (tab === "Skips") for (const [link] of pair ?? []) tint(link, "--mark");
  for (const [part, own, parent] of [
    [hovered, "--hover", "--parent"],
    [selected, "--accent", "--parent"],
  ] as const) {
    if (part?.kind === "link") tint(part.index, own);
    else if (part) {
      tint(robot?.joints[part.index]?.parent, parent);
      tint(robot?.joints[part.index]?.child, own === "--hover" ? "--child" : own);
    }
  }
  return tints;
}

function painted(state: Readonly<State>): (link: number) => Color | null {
  const { robot, byPart, report, compared } = state;
  if (robot && compared) {
    const changes = new Map(compared.changes.map(({ link, change }) => [link, change]));
    return (link) => {
      const change = changes.get(robot.links[link]?.name ?? "");
      return new Color(color(change ? CHANGE_COLORS[change] : "--open"));
    };
  }
  const by = paintNow(state);
  const parts = new Map<number, Color>();
  if (byPart)
    robot?.parts.forEach(({ links }, part) => {
      for (const link of links) parts.set(link, new Color(partColor(part)));
    });
  if (!robot || by === null) return (link) => parts.get(link) ?? null;
  const worst = paintOf(robot, report.report, by);
  const names = { error: "--error", warning: "--warning", info: "--info", unverified: "--open" };
  return (link) => {
    const found = worst.get(link);
    // If only one rule counts, a link that it does not name is neither good nor bad.
    const rest = report.report && by === "worst" ? "--good" : "--open";
    return new Color(color(found ? names[found] : rest));
  };
}
