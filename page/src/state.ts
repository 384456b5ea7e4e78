/** The state of the page, and who wants to hear of its changes. */

import type { ProximityAnswer, Report, ShapeKind, SkipEdit, SkipsAnswer } from "./engine/protocol";
import type { Entry, Part, RobotModel } from "./model";

export const LAYERS = [
  "original",
  "plain",
  "hulls",
  "pieces",
  "boxes",
  "spheres",
  "piece-boxes",
  "piece-spheres",
] as const;
export type LayerKind = (typeof LAYERS)[number];

export const LAYER_NAMES: Record<LayerKind, string> = {
  original: "Original",
  plain: "Plain",
  hulls: "Hulls",
  pieces: "Pieces",
  boxes: "Boxes",
  spheres: "Spheres",
  "piece-boxes": "Boxes of pieces",
  "piece-spheres": "Spheres of pieces",
};

export interface Layer {
  on: boolean;
  opacity: number;
}

export const OVERLAYS = ["wireframe", "frames", "axes", "com", "inertia", "path", "grid"] as const;
export type OverlayKind = (typeof OVERLAYS)[number];

export const OVERLAY_NAMES: Record<OverlayKind, string> = {
  wireframe: "Wireframe",
  frames: "Link frames",
  axes: "Joint axes",
  com: "Centres of mass",
  inertia: "Inertia boxes",
  path: "Path to the root",
  grid: "Ground",
};

export const TABS = ["Joints", "Shapes", "Proximity", "Skips", "Findings", "Info"] as const;
export type Tab = (typeof TABS)[number];

/** A pair of shapes: link and piece of each. */
export type Pair = [[number, number], [number, number]];

export interface State {
  entries: Entry[];
  robot: RobotModel | null;
  /** What is being loaded, with its progress. */
  loading: { what: string; done: number; of: number } | null;
  /** Why there is no robot. */
  failure: string | null;
  /** What could not be loaded of the picture, by layer. */
  faults: Map<string, string[]>;
  q: number[];
  /** x, y, z and the quaternion w, x, y, z of each link. */
  poses: Float64Array | null;
  selected: Part | null;
  hovered: Part | null;
  layers: Record<LayerKind, Layer>;
  overlays: Record<OverlayKind, boolean>;
  hidden: ReadonlySet<number>;
  tab: Tab;
  shapes: ShapeKind;
  proximity: { answer: ProximityAnswer | null; error: string | null };
  pair: Pair | null;
  skips: {
    answer: SkipsAnswer | null;
    error: string | null;
    /** Edits as they were before, the last last. */
    before: SkipEdit[][];
    /** Whether there are edits that are not saved. */
    dirty: boolean;
    /** How many saves can be undone. */
    saved: number;
  };
  report: { report: Report | null; error: string | null; busy: string | null };
  /** Colours of links by their worst finding. */
  painted: boolean;
  /** The pose error of the sample that is shown. */
  sample: { at: number; of: number; position: number; angle: number } | null;
  /** A line for the status bar, for a moment. */
  note: string | null;
}

export const NO_SKIPS: State["skips"] = { answer: null, error: null, before: [], dirty: false, saved: 0 };

export function initial(): State {
  const layer = (on: boolean): Layer => ({ on, opacity: 1 });
  return {
    entries: [],
    robot: null,
    loading: null,
    failure: null,
    faults: new Map(),
    q: [],
    poses: null,
    selected: null,
    hovered: null,
    layers: {
      original: layer(true),
      plain: layer(false),
      hulls: layer(false),
      pieces: layer(false),
      boxes: layer(false),
      spheres: layer(false),
      "piece-boxes": layer(false),
      "piece-spheres": layer(false),
    },
    overlays: { wireframe: false, frames: false, axes: false, com: false, inertia: false, path: false, grid: true },
    hidden: new Set(),
    tab: "Joints",
    shapes: "pieces",
    proximity: { answer: null, error: null },
    pair: null,
    skips: NO_SKIPS,
    report: { report: null, error: null, busy: null },
    painted: false,
    sample: null,
    note: null,
  };
}

type Listener = (state: State) => void;

export class StateStore {
  private state = initial();
  private readonly listeners: { keys: readonly (keyof State)[]; listener: Listener }[] = [];

  get now(): Readonly<State> {
    return this.state;
  }

  set(change: Partial<State>): void {
    const changed = (Object.keys(change) as (keyof State)[]).filter((key) => this.state[key] !== change[key]);
    if (changed.length === 0) return;
    this.state = { ...this.state, ...change };
    for (const { keys, listener } of this.listeners) {
      if (keys.some((key) => changed.includes(key))) listener(this.state);
    }
  }

  /** Calls now, and whenever one of these changed. */
  on(keys: readonly (keyof State)[], listener: Listener): void {
    this.listeners.push({ keys, listener });
    listener(this.state);
  }
}
