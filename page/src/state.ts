/** The state of the page, and who wants to hear of its changes. */

import { SHAPE_KINDS } from "./engine/protocol";
import type { ProximityAnswer, Report, ShapeKind, SkipEdit, SkipsAnswer } from "./engine/protocol";
import type { AbsentMesh } from "./absent";
import type { Contacts } from "./contacts";
import type { Entry, Part, RobotModel } from "./model";
import { keptUnits } from "./ui/format";
import type { Units } from "./ui/format";

/** What the URDF itself has, the plain meshes, and what stands for links in checks. */
export const LAYERS = ["original", "collision", "plain", ...SHAPE_KINDS] as const;
export type LayerKind = (typeof LAYERS)[number];

export const LAYER_NAMES: Record<LayerKind, string> = {
  original: "Original",
  collision: "Collision",
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

/** What a layer shows, for those to whom its name says too little. */
export const LAYER_HINTS: Partial<Record<LayerKind, string>> = {
  original: "The URDF's visual geometry, with its colours and textures",
  collision: "The URDF's collision geometry",
  plain: "The meshes that all other shapes are computed from",
};

export const OVERLAYS = ["wireframe", "frames", "names", "axes", "com", "inertia", "path", "grid"] as const;
export type OverlayKind = (typeof OVERLAYS)[number];

export const OVERLAY_NAMES: Record<OverlayKind, string> = {
  wireframe: "Wireframe",
  frames: "Link frames",
  names: "Names of frames",
  axes: "Joint axes",
  com: "Centres of mass",
  inertia: "Inertia boxes",
  path: "Path to the root",
  grid: "Ground",
};

export const TABS = ["Joints", "Shapes", "Proximity", "Skips", "Findings", "Info"] as const;
export type Tab = (typeof TABS)[number];

/** Tabs in which a pair is chosen; outside of them none is. */
export const CHOOSES_PAIRS: ReadonlySet<Tab> = new Set(["Proximity", "Skips"] as const);

/** A pair of shapes: link and piece of each. */
export type Pair = [[number, number], [number, number]];

export interface State {
  entries: Entry[];
  robot: RobotModel | null;
  /** What is being loaded, with its progress. */
  loading: { title?: string; what: string; done: number; of: number } | null;
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
  /** Length of the axes of frames, metres; null where it follows from the robot's size. */
  frameSize: number | null;
  hidden: ReadonlySet<number>;
  tab: Tab;
  shapes: ShapeKind;
  proximity: { answer: ProximityAnswer | null; error: string | null };
  /** What is in contact now; null where that is not known. The same object as long as it is the same. */
  contacts: Contacts | null;
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
  /** Meshes that the URDF names and the URDD does not have. */
  absent: AbsentMesh[];
  /** Colours of links by their findings: by their worst, by those of one rule, or not. */
  painted: "worst" | { code: string } | null;
  /** Colours of links by the part that they are of, where the robot was put together. */
  byPart: boolean;
  /** The pose error of the sample that is shown. */
  sample: { at: number; of: number; position: number; angle: number } | null;
  /** A line for the status bar, for a moment. */
  note: string | null;
  units: Units;
  /** Whether `urdd view` answers: it ended, or another one is in its place. */
  server: "here" | "gone" | "another";
  /** What is unfolded where the window is narrow. */
  unfolded: "links" | "panels" | null;
}

export const NO_SKIPS: State["skips"] = { answer: null, error: null, before: [], dirty: false, saved: 0 };

/** The pair that fades the rest: in the tab of distances alone. */
export function ghosted({ pair, tab }: Readonly<State>): Pair | null {
  return tab === "Proximity" ? pair : null;
}

/** The layers that are drawn: a chosen pair is seen in its own shapes, whatever else is on. */
export function drawnLayers(state: Readonly<State>): State["layers"] {
  const { layers, shapes } = state;
  return ghosted(state) && !layers[shapes].on ? { ...layers, [shapes]: { on: true, opacity: 1 } } : layers;
}

export function initial(): State {
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
    layers: Object.fromEntries(LAYERS.map((layer) => [layer, { on: layer === "original", opacity: 1 }])) as Record<
      LayerKind,
      Layer
    >,
    overlays: {
      wireframe: false,
      frames: false,
      names: true,
      axes: false,
      com: false,
      inertia: false,
      path: false,
      grid: true,
    },
    frameSize: null,
    hidden: new Set(),
    tab: "Joints",
    shapes: "pieces",
    proximity: { answer: null, error: null },
    contacts: null,
    pair: null,
    skips: NO_SKIPS,
    report: { report: null, error: null, busy: null },
    absent: [],
    painted: null,
    byPart: true,
    sample: null,
    note: null,
    units: keptUnits(),
    server: "here",
    unfolded: null,
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
