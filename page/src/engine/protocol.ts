/** Messages between the page and the worker that owns the WebAssembly module. */

import type { GeometryKind, JointType, LoopKind, SkipEdit } from "../../../wasm/npm/modules";

export type { JointType, SkipEdit };

/** The unit of a DOF. */
export type Unit = "rad" | "m";

export type Vector = [number, number, number];
/** w, x, y, z. */
export type Quaternion = [number, number, number, number];

export interface Pose {
  position: Vector;
  quaternion_wxyz: Quaternion;
}

export interface Inertial extends Pose {
  mass: number | null;
  /** xx, xy, xz, yy, yz, zz; kg m². */
  inertia: [number, number, number, number, number, number] | null;
}

export interface Link {
  name: string;
  parent_joint: number | null;
  inertial: Inertial | null;
}

export interface Limit {
  lower: number | null;
  upper: number | null;
  effort: number | null;
  velocity: number | null;
}

export interface Joint {
  name: string;
  type: JointType;
  parent: number | null;
  child: number | null;
  origin: Pose | null;
  axis: Vector | null;
  dofs: number[] | null;
  mimic: { dof: number | null; multiplier: number; offset: number } | null;
  limit: Limit | null;
}

export interface Dof {
  name: string;
  joint: number;
  unit: Unit;
  bounds: [number, number] | null;
  /** Whether the source limits it; without, the bounds are a range to sample from, which it may leave. */
  is_limited: boolean | null;
}

export interface MeshPaths {
  glb: string | null;
  read: string | null;
}

export interface OriginalMesh {
  link: number;
  geometry: GeometryKind;
  element: number;
  filename: string;
  path: string | null;
}

export interface Fault {
  module: string | null;
  reason: string;
}

/** A kinematic loop: the frames in two links that it holds together. */
export interface Loop {
  name: string;
  kind: LoopKind;
  links: [number, number];
  /** In the frames of the links. */
  frames: [Pose, Pose];
  /** How far its ends may stay apart, m and rad. */
  tolerances: [number, number];
}

/** What closes the loops of a robot. */
export interface Loops {
  loops: Loop[];
  /** Equations between DOFs. */
  couplings: { name: string; dofs: number[] }[];
  /** The DOFs that move freely; the others follow. */
  independent: number[];
  /** A closed configuration. */
  reference: number[];
}

/** How far a configuration is from closed. */
export interface LoopErrors {
  /** Of each loop: metres and rad. */
  gaps: { position: number; rotation: number }[];
  /** Of each coupling; 0 where it holds. */
  sums: number[];
  is_closed: boolean;
}

/** A closed configuration near another one; where none was found, the one with the smallest gaps. */
export interface ClosedLoops {
  configuration: number[];
  is_closed: boolean;
}

/** The description of a robot: see `wasm/src/about.rs`. */
export interface About {
  name: string | null;
  folder: string;
  profile: string;
  metadata: Metadata | null;
  links: Link[];
  joints: Joint[];
  dofs: Dof[] | null;
  zero: number[] | null;
  middle: number[] | null;
  /** Null for a tree. */
  loops: Loops | null;
  meshes: {
    original: OriginalMesh[] | null;
    plain: MeshPaths[][] | null;
    hulls: MeshPaths[][] | null;
    pieces: MeshPaths[][] | null;
  };
  faults: Fault[];
}

/** `urdd.json`, with any content. */
export type Metadata = Record<string, unknown>;

/** The kinds of collision shapes, by the library's names. */
export const SHAPE_KINDS = ["hulls", "pieces", "boxes", "spheres", "piece-boxes", "piece-spheres"] as const;
export type ShapeKind = (typeof SHAPE_KINDS)[number];

export interface Statistics {
  min: number;
  mean: number;
  max: number;
}

export interface PairDistance {
  links: [string, string];
  link_idxs: [number, number];
  pieces: [number, number];
  distance: number;
  relative: number | null;
  points: [Vector, Vector];
  statistics: Statistics | null;
}

export interface ProximityAnswer {
  nearest: PairDistance[];
  in_collision: boolean;
  pairs: number;
  of: number | null;
  num_samples: number | null;
  /** The links of each pair that touches, and is skipped because it touches at rest. */
  skipped_touching: [number, number][];
  /** The learned model's estimate for the same configuration, or its error; null without a model, or for other shapes
   * than pieces. */
  model: Learned | { error: string } | null;
  /** Time to compute the distances, ms. */
  ms: number;
}

/** The learned self-collision model: see `wasm/src/model.rs`. */
export interface CollisionModel {
  /** Number of pairs of links that it has a clearance for. */
  pairs: number;
  /** Number of pairs that it assumes to be always apart. */
  other_pairs: number;
  num_parameters: number;
  /** Training clipped distances at this value, metres. */
  clip_distance: number;
  /** Its accuracy on 50,000 configurations that SPEC 8.8.9 defines. */
  evaluation: {
    num_colliding: number;
    /** In collision, but cleared. */
    num_missed: number;
    /** In collision, and within a step of 0.05 rad or m of being free. */
    num_near_contact: number;
    num_near_contact_missed: number;
    num_free: number;
    /** Free, and cleared. */
    num_cleared: number;
  };
  /** The rates from these counts. */
  rates: { miss: Rate; near_contact_miss: Rate; clear: Rate };
}

/** A fraction of configurations, with its 95 % interval, 0 to 1. */
export interface Rate {
  count: number;
  of: number;
  lower: number;
  upper: number;
}

/** The model's estimates for a configuration. */
export interface Clearances {
  /** Whether any clearance is 0 or less. */
  may_collide: boolean;
  /** The minimum clearance, metres, and the index of its pair; null for a model without pairs. */
  min_clearance: { pair: number; links: [string, string]; link_idxs: [number, number]; clearance: number } | null;
  /** For each pair, metres. */
  clearances: number[];
}

/** The model and its estimates. */
export type Learned = CollisionModel & Clearances;

export interface SkipsAnswer {
  kind: ShapeKind;
  places: [number, number][];
  skipped: string[];
  reasons: string[] | null;
  edits: SkipEdit[] | null;
  skipped_reasons: string[] | null;
  /** The files that edits change. */
  files?: { path: string; text: string }[];
}

export interface Sample {
  kind: string;
  sample_idx: number | null;
  configuration: number[];
  link_poses: Pose[];
}

export interface Shape {
  link: number;
  piece: number;
  solid: { position: Vector; quaternion_wxyz?: Quaternion; half_extents?: Vector; radius?: number };
}

/** A visual or collision element of the URDF: see `wasm/src/sources.rs`. */
export interface SourceShape extends Pose {
  link: number;
  geometry: GeometryKind;
  element: number;
  shape: {
    Mesh?: { filename: string; scale: Vector | null };
    Box?: { size: Vector };
    Cylinder?: { radius: number; length: number };
    Capsule?: { radius: number; length: number };
    Sphere?: { radius: number };
  } | null;
  path: string | null;
  side_files: string[];
  rgba: [number, number, number, number] | null;
}

/** A target for a link, and the DOFs that may change. */
export interface InverseQuestion {
  q: number[];
  link: number;
  /** The point of the link that reaches the position, in the link's frame, metres; its origin by default. */
  point?: Vector;
  /** The target position, in the root link's frame, metres. */
  position: Vector;
  /** The target rotation of the link; free by default. */
  quaternion_wxyz?: Quaternion;
  /** The DOFs that may change; all by default. */
  dofs?: number[];
  /** Whether kinematic loops may be open in the solution. */
  open_loops?: boolean;
}

export interface InverseSolution {
  configuration: number[];
  position_error: number;
  rotation_error: number;
  reached: boolean;
  /** `unknown` unless it was asked why a target is not reached. */
  verdict: "reached" | "refused" | "limits" | "out of reach" | "loops" | "unknown";
}

export type Severity = "error" | "warning" | "info";

export interface Finding {
  code: string;
  name: string;
  severity: Severity;
  message: string;
  count: number;
  /** What programs do because of it. */
  programs: { program: string; does: Deed; is_supposed: boolean }[];
  [key: string]: unknown;
}

/** What a program does with a part of a URDF, or with the whole. */
export type Deed = "reads" | "drops" | "refuses" | "crashes";

export interface ProgramResult {
  /** `mujoco`, `urdfdom6`. */
  program: string;
  name: string;
  /** Its name whatever its version. */
  family: string;
  /** The version that its reader was held to. */
  version: string;
  /** Whether the settings name it. */
  is_chosen: boolean;
  /** The worst that it does; null where it reads all as it is written, but for what is usual. */
  does: Deed | null;
  effects: ProgramEffect[];
  effects_cut: number;
}

/** Something that a program does otherwise than the file says. */
export interface ProgramEffect {
  does: Deed;
  line: number | null;
  column: number | null;
  /** Such as `joint/elbow/limit`; null for the whole file. */
  part: string | null;
  reason: string;
  /** What the program makes of the part, where it reads it otherwise. */
  makes: string | null;
  /** Whether it does so with every robot, or because of another fault. */
  is_usual: boolean;
  /** Whether the program refuses the file for something else before: it is so once that is mended. */
  is_supposed: boolean;
}

export interface ImportedFrom {
  /** `mjcf` or `sdf`. */
  format: string;
  otherwise: { what: string; count: number; how: string | null }[];
  lost: { what: string; count: number; how: string | null }[];
  notes: string[];
}

export interface UrddReport {
  /** Whether it is about a URDD, or a URDF by itself. */
  kind: "urdd" | "urdf";
  path: string;
  name: string | null;
  verdict: "pass" | "fail" | "incomplete" | "unreadable";
  reason: string | null;
  findings: Finding[];
  checks: { code: string; status: string; reason: string | null; skipped: string | null }[];
  not_checked: { codes: string[]; reason: string }[];
  geometry_not_verified: { link: number; codes: string[]; reasons: string[] }[];
  /** Why the rates of the self-collision model were not verified; null if they were, or without a model. */
  model_not_verified: { codes: string[]; reasons: string[] } | null;
  /** What programs do with a URDF; empty for a URDD. */
  programs: ProgramResult[];
  /** The MJCF, SDF or USD that the URDF was imported from; null if it was written as a URDF. */
  imported: ImportedFrom | null;
  modules: { name: string; path: string; version: string | null; profile: string | null }[];
}

export interface Report {
  tool: { name: string; version: string };
  spec_version: string;
  urdds: UrddReport[];
  totals: Record<string, number>;
  /** For a URDF by itself: its text, expanded if it is xacro, unless it is too large; and the rules of its findings. */
  text?: string | null;
  /** For a URDF by itself: the `urdd.toml` that counts, and what is wrong with it. */
  settings?: { file: string | null; fault: string | null };
  rules?: Explanation[];
}

export interface Explanation {
  code: string;
  name: string;
  severity: Severity;
  /** Null if the rule is about robots and not about URDDs. */
  clause: string | null;
  explanation: string;
}

/** A robot description among files. */
export interface Description {
  path: string;
  name: string;
  format: "urdf" | "xacro" | "mjcf" | "sdf" | "usd";
}

export interface FileEntry {
  path: string;
  size: number;
  /** Its path on a site. */
  at?: string;
}
