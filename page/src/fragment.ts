/** The state that a link carries, in the URL's fragment: `#r=h1&q=0,0.5&t=Proximity`. */

import { LAYERS, OVERLAYS, TABS } from "./state";
import type { Layer, LayerKind, OverlayKind, Tab } from "./state";

export interface Shared {
  robot: string | null;
  q: number[] | null;
  tab: Tab | null;
  selected: string | null;
  layers: Partial<Record<LayerKind, Layer>> | null;
  overlays: OverlayKind[] | null;
  camera: number[] | null;
  token: string | null;
}

function numbers(text: string | null): number[] | null {
  if (text === null || text === "") return null;
  const values = text.split(",").map(Number);
  return values.every(Number.isFinite) ? values : null;
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
    layers: Object.keys(layers).length > 0 ? layers : null,
    overlays: overlays === null ? null : OVERLAYS.filter((kind) => overlays.split(",").includes(kind)),
    camera: numbers(words.get("c")),
    token: words.get("token"),
  };
}

export function write(shared: Shared): string {
  const words: string[] = [];
  const add = (key: string, value: string | null): void => {
    if (value !== null && value !== "")
      words.push(`${key}=${encodeURIComponent(value).replaceAll("%2C", ",").replaceAll("%3A", ":")}`);
  };
  const short = (value: number): string => String(Number(value.toFixed(5)));
  add("r", shared.robot);
  add("t", shared.tab);
  add("s", shared.selected);
  const layers = Object.entries(shared.layers ?? {}).filter(([, layer]) => layer.on);
  add("l", layers.map(([name, layer]) => (layer.opacity < 1 ? `${name}:${short(layer.opacity)}` : name)).join(","));
  add("o", shared.overlays?.join(",") ?? null);
  add("q", shared.q?.map(short).join(",") ?? null);
  add("c", shared.camera?.map(short).join(",") ?? null);
  return words.join("&");
}
