/** The view in a link's fragment: `#r=h1&q=0,0.5&t=Proximity`. */

import { IS_ZIP, MAY_DESCRIBE } from "./drop";
import { SHAPE_KINDS } from "./engine/protocol";
import type { ShapeKind } from "./engine/protocol";
import { LAYERS, OVERLAYS, TABS } from "./state";
import type { Layer, LayerKind, OverlayKind, Pair, Tab } from "./state";

/** An empty list, as opposed to an omitted one. */
const NONE = "none";

export interface Shared {
  robot: string | null;
  q: number[] | null;
  tab: Tab | null;
  selected: string | null;
  joint: string | null;
  hidden: number[] | null;
  pair: Pair | null;
  shapes: ShapeKind | null;
  layers: Partial<Record<LayerKind, Layer>> | null;
  overlays: OverlayKind[] | null;
  /** Metres. */
  frameSize: number | null;
  camera: number[] | null;
  /** The id of the robot to compare with. */
  compareWith: string | null;
  token: string | null;
  /** The path of a description beside the page, which a robot is made of. */
  from: string | null;
}

/** A relative path of plain names, so that a link leads to nothing but files beside the page. */
const PLAIN = /^(?:\.\.\/)?(?:[A-Za-z0-9_][A-Za-z0-9_.-]*\/)*[A-Za-z0-9_][A-Za-z0-9_.-]*$/;

/** The path, if it is one of a description or an archive beside the page. */
function beside(path: string | null): string | null {
  return path !== null && PLAIN.test(path) && (MAY_DESCRIBE.test(path) || IS_ZIP.test(path)) ? path : null;
}

function numbers(text: string | null): number[] | null {
  if (text === null || text === "") return null;
  const values = text.split(",").map(Number);
  return values.every(Number.isFinite) ? values : null;
}

/** `3,7-9` means links 3, 7, 8, 9. */
function ranges(text: string | null): number[] | null {
  if (text === null) return null;
  const found: number[] = [];
  for (const word of text.split(",")) {
    const match = /^(\d{1,6})(?:-(\d{1,6}))?$/.exec(word);
    if (!match) continue;
    const [first, last] = [Number(match[1]), Number(match[2] ?? match[1])];
    for (let link = first; link <= last; link++) found.push(link);
  }
  return found;
}

function inRanges(links: readonly number[]): string {
  const words: string[] = [];
  const sorted = [...links].sort((a, b) => a - b);
  for (let k = 0; k < sorted.length;) {
    const first = sorted[k] ?? 0;
    let n = 1;
    while (sorted[k + n] === first + n) n++;
    words.push(n === 1 ? `${first}` : `${first}-${first + n - 1}`);
    k += n;
  }
  return words.join(",");
}

/** `3.0,5.2`: piece 0 of link 3, and piece 2 of link 5. */
function pairOf(text: string | null): Pair | null {
  const match = /^(\d{1,6})\.(\d{1,6}),(\d{1,6})\.(\d{1,6})$/.exec(text ?? "");
  if (!match) return null;
  const [a = 0, b = 0, c = 0, d = 0] = match.slice(1).map(Number);
  return [
    [a, b],
    [c, d],
  ];
}

export function read(fragment: string): Shared {
  const words = new URLSearchParams(fragment.replace(/^#/, ""));
  const tab = TABS.find((tab) => tab === words.get("t")) ?? null;
  const layers: Partial<Record<LayerKind, Layer>> = {};
  for (const word of (words.get("l") ?? "").split(",")) {
    const [name, opacity] = word.split(":");
    const layer = LAYERS.find((layer) => layer === name);
    const share = opacity === undefined ? 1 : Number(opacity);
    if (layer && share >= 0 && share <= 1) layers[layer] = { on: true, opacity: share };
  }
  const overlays = words.get("o");
  return {
    robot: words.get("r"),
    q: numbers(words.get("q")),
    tab,
    selected: words.get("s"),
    joint: words.get("j"),
    hidden: ranges(words.get("x")),
    pair: pairOf(words.get("p")),
    shapes: SHAPE_KINDS.find((kind) => kind === words.get("k")) ?? null,
    layers: Object.keys(layers).length > 0 || words.get("l") === NONE ? layers : null,
    overlays: overlays === null ? null : OVERLAYS.filter((kind) => overlays.split(",").includes(kind)),
    frameSize: numbers(words.get("f"))?.find((size) => size > 0) ?? null,
    camera: numbers(words.get("c")),
    compareWith: words.get("v"),
    token: words.get("token"),
    from: beside(words.get("from")),
  };
}

export function write(shared: Shared): string {
  const words: string[] = [];
  const add = (key: string, value: string | null): void => {
    if (value !== null && value !== "")
      words.push(`${key}=${encodeURIComponent(value).replaceAll("%2C", ",").replaceAll("%3A", ":")}`);
  };
  const short = (value: number): string => String(Number(value.toFixed(7)));
  add("r", shared.robot);
  add("t", shared.tab);
  add("s", shared.selected);
  add("j", shared.joint);
  add("k", shared.shapes);
  add("p", shared.pair?.map((place) => place.join(".")).join(",") ?? null);
  add("x", shared.hidden ? inRanges(shared.hidden) : null);
  const layers = Object.entries(shared.layers ?? {}).filter(([, layer]) => layer.on);
  const drawn = layers.map(([name, layer]) => (layer.opacity < 1 ? `${name}:${short(layer.opacity)}` : name));
  add("l", shared.layers && (drawn.join(",") || NONE));
  add("o", shared.overlays && (shared.overlays.join(",") || NONE));
  add("f", shared.frameSize === null ? null : short(shared.frameSize));
  add("q", shared.q?.map(short).join(",") ?? null);
  add("v", shared.compareWith);
  add("c", shared.camera?.map(short).join(",") ?? null);
  return words.join("&");
}
