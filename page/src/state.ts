/** The state of the page, and listeners for its changes. */

import type { Compared } from "./compared";
import type { Contacts } from "./contacts";
import { SHAPE_KINDS } from "./engine/protocol";
import type {
  Description,
  LoopErrors,
  ProximityAnswer,
  Report,
  ShapeKind,
  SkipEdit,
  SkipsAnswer,
} from "./engine/protocol";
import type { AbsentMesh } from "./missing";
import type { Entry, Part, RobotModel } from "./model";
import type { Obstacle } from "./showing";
import type { Trajectory } from "./trajectory";
import { keptUnits } from "./ui/format";
import type { Units } from "./ui/format";
import type { Opened } from "./ui/opened";

/** The description that this page makes a robot of, as a text that a person may change. */
export interface Draft {
  /** Its path among the dropped files. */
  path: string;
  format: Exclude<Description["format"], "xacro">;
  /** The text as it is now; null of a binary file. */
  text: string | null;
  /** Whether it differs from what was dropped, or saved last. */
  isChanged: boolean;
}

/** A draft that is a text. */
export type TextDraft = Draft & { text: string };

/** The draft, if it is a text. */
export function ofText(draft: Draft | null): TextDraft | null {
  return draft && draft.text !== null ? { ...draft, text: draft.text } : null;
}

/** The levels of spheres that can be drawn; a URDD has at most these (SPEC 8.9.2). */
const SPHERE_LEVELS = [
  "level-0",
  "level-1",
  "level-2",
  "level-3",
  "level-4",
  "level-5",
  "level-6",
  "level-7",
  "level-8",
  "level-9",
  "level-10",
  "level-11",
  "level-12",
  "level-13",
  "level-14",
  "level-15",
] as const;
type SphereLayer = (typeof SPHERE_LEVELS)[number];

/** Layers: the URDF's own geometry, the plain meshes, the collision shapes, and the levels of spheres. */
export const LAYERS = ["original", "collision", "plain", ...SHAPE_KINDS, ...SPHERE_LEVELS] as const;
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
  ...(Object.fromEntries(SPHERE_LEVELS.map((layer, level) => [layer, `Level ${level}`])) as Record<
    SphereLayer,
    string
  >),
};

/** The number of a level of spheres; null for other layers. */
export function sphereLevel(layer: LayerKind): number | null {
  const level = (SPHERE_LEVELS as readonly string[]).indexOf(layer);
  return level < 0 ? null : level;
}

export interface Layer {
  on: boolean;
  opacity: number;
}

/** Explanations of layers. */
export const LAYER_HINTS: Partial<Record<LayerKind, string>> = {
  original: "The URDF's visual geometry, with its colours and textures",
  collision: "The URDF's collision geometry",
  plain: "The meshes that all other shapes are computed from",
};

export const OVERLAYS = ["wireframe", "frames", "names", "axes", "com", "inertia", "path", "loops", "grid"] as const;
export type OverlayKind = (typeof OVERLAYS)[number];

export const OVERLAY_NAMES: Record<OverlayKind, string> = {
  wireframe: "Wireframe",
  frames: "Link frames",
  names: "Names of frames",
  axes: "Joint axes",
  com: "Centres of mass",
  inertia: "Inertia boxes",
  path: "Path to the root",
  loops: "Ends of loops",
  grid: "Ground",
};

export const TABS = ["Joints", "Shapes", "Proximity", "Skips", "Findings", "Info", "Text"] as const;
export type Tab = (typeof TABS)[number];

/** Whether a tab can be chosen. */
export function hasTab(tab: Tab, { draft }: Readonly<State>): boolean {
  return tab !== "Text" || ofText(draft) !== null;
}

/** Tabs in which a pair can be selected; other tabs clear the selection. */
export const CHOOSES_PAIRS: ReadonlySet<Tab> = new Set(["Proximity", "Skips"] as const);

/** A pair of shapes: link and piece of each. */
export type Pair = [[number, number], [number, number]];

export interface State {
  entries: Entry[];
  /** The text that the robot is made of in this page; null for others. */
  draft: Draft | null;
  /** The place of the text to show; a new object each time. */
  textAt: { line: number; column: number | null } | null;
  robot: RobotModel | null;
  /** The progress of loading. */
  loading: { title?: string; what: string; done: number; of: number } | null;
  /** Why there is no robot. */
  failure: string | null;
  /** Errors of loading, by layer. */
  faults: Map<string, string[]>;
  q: number[];
  /** x, y, z and the quaternion w, x, y, z of each link. */
  poses: Float64Array | null;
  /** How far the loops of the robot are from closed; null for a tree. */
  loops: LoopErrors | null;
  /** Whether DOFs that follow do so where a person moves others. */
  keepClosed: boolean;
  selected: Part | null;
  hovered: Part | null;
  layers: Record<LayerKind, Layer>;
  overlays: Record<OverlayKind, boolean>;
  /** Length of the axes of frames, metres; null for the default, by the robot's size. */
  frameSize: number | null;
  hidden: ReadonlySet<number>;
  tab: Tab;
  shapes: ShapeKind;
  proximity: { answer: ProximityAnswer | null; error: string | null };
  /** The present contacts; null if unknown. The same object while they do not change. */
  contacts: Contacts | null;
  pair: Pair | null;
  skips: {
    answer: SkipsAnswer | null;
    error: string | null;
    /** Previous edits for undo, the newest last. */
    before: SkipEdit[][];
    /** Whether there are unsaved edits. */
    dirty: boolean;
    /** Number of saves that can be undone. */
    saved: number;
  };
  report: { report: Report | null; error: string | null; busy: string | null };
  /** What is open among its findings and pairs, which panels keep; another robot's is another object. */
  opened: Opened;
  /** Meshes that the URDF references and the URDD lacks. */
  absent: AbsentMesh[];
  /** Files that the MJCF, SDF or USD names, and that are not there. */
  wanted: readonly string[];
  /** The drop that is being read, in words. */
  taking: string | null;
  /** What links are painted by: their worst finding, one rule, or nothing; `auto` until it is chosen. */
  painted: "worst" | { code: string } | null | "auto";
  /** Whether links are coloured by part, for a combined robot. */
  byPart: boolean;
  /** The pose errors of the displayed sample. */
  sample: { at: number; of: number; position: number; angle: number } | null;
  /** Poses of all links that are drawn beside the present ones: where a trajectory begins and ends. */
  ghosts: readonly Float64Array[];
  /** What a program shows around the robot, and the path that it shows. */
  world: readonly Obstacle[];
  path: Trajectory | null;
  /** The id of the robot that this one is to be compared with, and that robot once it is read. */
  compareWith: string | null;
  compared: Compared | null;
  /** A temporary line in the status bar. */
  note: string | null;
  units: Units;
  /** The generation of the open robot, which goes on while its picture is shown: its progress, or why it failed. */
  making: Pick<Entry, "making" | "failure" | "stopped">;
  /** Whether `urdd view` answers, has ended, or was replaced by another one. */
  server: "here" | "gone" | "another";
  /** What is unfolded in a narrow window: a panel, or the pills without room. */
  unfolded: "links" | "panels" | "pills" | null;
}

export const NO_SKIPS: State["skips"] = { answer: null, error: null, before: [], dirty: false, saved: 0 };

export const NOT_MADE: State["making"] = { making: null, failure: null };

/** A robot that nobody has looked at: nothing is selected or hidden, and no program shows anything. */
export function unseen(): Pick<
  State,
  "selected" | "hovered" | "hidden" | "pair" | "opened" | "compareWith" | "world" | "path"
> {
  return {
    selected: null,
    hovered: null,
    hidden: new Set(),
    pair: null,
    opened: new Map(),
    compareWith: null,
    world: [],
    path: null,
  };
}

/** What panels say of a robot that has only what its picture needs. */
export const PARTIAL = "this robot is still being generated.";

/** What panels say of a robot that has not all, and why; null if it has, or nobody knows why it has not. */
export function partial({ making, stopped }: Entry): string | null {
  if (making) return PARTIAL;
  return stopped ? "the rest of this robot was not generated; *Generate the rest* goes on." : null;
}

/** The pair that fades other links, in the Proximity tab only. */
export function ghosted({ pair, tab }: Readonly<State>): Pair | null {
  return tab === "Proximity" ? pair : null;
}

/** The drawn layers: a selected pair is always drawn in its own shapes. */
export function drawnLayers(state: Readonly<State>): State["layers"] {
  const { layers, shapes } = state;
  return ghosted(state) && !layers[shapes].on ? { ...layers, [shapes]: { on: true, opacity: 1 } } : layers;
}

export function initial(): State {
  return {
    ...unseen(),
    entries: [],
    draft: null,
    textAt: null,
    robot: null,
    loading: null,
    failure: null,
    faults: new Map(),
    q: [],
    poses: null,
    loops: null,
    keepClosed: true,
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
      loops: true,
      grid: true,
    },
    frameSize: null,
    tab: "Joints",
    shapes: "pieces",
    proximity: { answer: null, error: null },
    contacts: null,
    skips: NO_SKIPS,
    report: { report: null, error: null, busy: null },
    absent: [],
    wanted: [],
    taking: null,
    painted: "auto",
    byPart: true,
    sample: null,
    ghosts: [],
    compared: null,
    note: null,
    units: keptUnits(),
    making: NOT_MADE,
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

  /** Calls the listener now, and after each change of these. */
  on(keys: readonly (keyof State)[], listener: Listener): void {
    this.listeners.push({ keys, listener });
    listener(this.state);
  }
}
