/** What the page and the worker that owns the WebAssembly module say to each other. */

import type { Unit } from "../ui/format";

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

export type JointType = "Revolute" | "Continuous" | "Prismatic" | "Fixed" | "Floating" | "Planar" | "Spherical";

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
}

export interface MeshPaths {
  glb: string | null;
  read: string | null;
}

export interface OriginalMesh {
  link: number;
  geometry: "Visual" | "Collision";
  element: number;
  filename: string;
  path: string | null;
}

export interface Fault {
  module: string | null;
  reason: string;
}

/** What a robot is: see `wasm/src/about.rs`. */
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
  meshes: {
    original: OriginalMesh[] | null;
    plain: MeshPaths[][] | null;
    hulls: MeshPaths[][] | null;
    pieces: MeshPaths[][] | null;
  };
  faults: Fault[];
}

/** `urdd.json`, as far as the page looks at it; it may hold anything. */
export type Metadata = Record<string, unknown>;

/** What stands for links and their pieces in checks: the names that the library knows. */
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
  /** What the learned model says of the same configuration, or why it cannot; null where there is none, or for other
   * shapes than the pieces that it stands for. */
  model: Learned | { error: string } | null;
  /** How long the distances took, ms. */
  ms: number;
}

/** The learned self-collision model: see `wasm/src/model.rs`. */
export interface CollisionModel {
  /** Number of pairs of links that it has a clearance for. */
  pairs: number;
  /** Number of pairs that it takes to be apart always. */
  other_pairs: number;
  num_parameters: number;
  /** From here on distances were all the same to it, metres. */
  clip_distance: number;
  /** How often it is right on 50,000 configurations that SPEC 8.8.9 fixes. */
  evaluation: {
    num_colliding: number;
    /** In collision, and cleared all the same. */
    num_missed: number;
    /** In collision, and within a step of 0.05 rad or m of being free. */
    num_near_contact: number;
    num_near_contact_missed: number;
    num_free: number;
    /** Free, and cleared. */
    num_cleared: number;
  };
  /** The shares of these counts. */
  rates: { miss: Rate; near_contact_miss: Rate; clear: Rate };
}

/** A share of counted configurations, with the ends of its 95 % interval, 0 to 1. */
export interface Rate {
  count: number;
  of: number;
  lower: number;
  upper: number;
}

/** What the model estimates of a configuration. */
export interface Clearances {
  /** Whether any clearance is 0 or less. */
  may_collide: boolean;
  /** The minimum clearance, metres, and the index of its pair; null for a model without pairs. */
  min_clearance: { pair: number; links: [string, string]; link_idxs: [number, number]; clearance: number } | null;
  /** Of each pair, metres. */
  clearances: number[];
}

/** The model, and what it says. */
export type Learned = CollisionModel & Clearances;

export interface SkipEdit {
  link_a: string;
  link_b: string;
  skip: boolean;
  reason: string;
}

export interface SkipsAnswer {
  kind: ShapeKind;
  places: [number, number][];
  skipped: string[];
  reasons: string[] | null;
  edits: SkipEdit[] | null;
  skipped_reasons: string[] | null;
  /** The files that change, where edits were made. */
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
  geometry: "Visual" | "Collision";
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

/** Where a link should be, and which DOFs may change for it. */
export interface InverseQuestion {
  q: number[];
  link: number;
  /** In the link's frame, metres; its origin unless it is said. */
  point?: Vector;
  /** Where that point should be, in the root link's frame. */
  position: Vector;
  /** How the link should be turned; it does not matter unless it is said. */
  quaternion_wxyz?: Quaternion;
  /** All unless they are said. */
  dofs?: number[];
}

export interface InverseSolution {
  configuration: number[];
  position_error: number;
  rotation_error: number;
  reached: boolean;
}

/** Triangles of a mesh, or why there are none. */
export interface LinkMesh {
  link: number;
  piece: number;
  positions?: Float32Array;
  indices?: Uint32Array;
  error?: string;
}

export type Severity = "error" | "warning" | "info";

export interface Finding {
  code: string;
  name: string;
  severity: Severity;
  message: string;
  count: number;
  [key: string]: unknown;
}

export interface UrddReport {
  path: string;
  name: string | null;
  verdict: "pass" | "fail" | "incomplete" | "unreadable";
  reason: string | null;
  findings: Finding[];
  checks: { code: string; status: string; reason: string | null; skipped: string | null }[];
  not_checked: { codes: string[]; reason: string }[];
  geometry_not_verified: { link: number; codes: string[]; reasons: string[] }[];
  /** Why the rates of the self-collision model were not verified; null where they were, or there is none. */
  model_not_verified: { codes: string[]; reasons: string[] } | null;
  modules: { name: string; path: string; version: string | null; profile: string | null }[];
}

export interface Report {
  tool: { name: string; version: string };
  spec_version: string;
  urdds: UrddReport[];
  totals: Record<string, number>;
}

export interface Explanation {
  code: string;
  name: string;
  severity: Severity;
  clause: string;
  explanation: string;
}

export interface FileEntry {
  path: string;
  size: number;
  /** Where a site has it. */
  at?: string;
}

/** Where a robot's files lie. */
export type RobotSource =
  | { kind: "url"; name: string; base: string; token: string | null; files: FileEntry[]; revision: string | null }
  | { kind: "local"; name: string; files: { path: string; file: File }[] }
  | { kind: "zip"; name: string; bytes: ArrayBuffer };

/** What the worker answers, by the name of what is asked. */
export interface Calls {
  /** The module: its address, or itself, compressed by brotli. */
  init: [{ wasm: string | ArrayBuffer }, null];
  open: [{ source: RobotSource }, { about: About; files: FileEntry[]; folder: string }];
  linkPoses: [{ q: number[] }, Float64Array];
  random: [{ k: number }, number[]];
  file: [{ path: string }, ArrayBuffer];
  meshes: [{ kind: "plain" | "hulls" | "pieces" }, LinkMesh[]];
  /** Of files: `link` is the number of the file in the question. */
  triangles: [{ paths: string[] }, LinkMesh[]];
  sources: [Record<string, never>, SourceShape[]];
  inverseKinematics: [InverseQuestion, InverseSolution];
  shapes: [{ kind: ShapeKind }, Shape[]];
  /** The nearest pairs: `k` of them, and more where all of these are in contact. */
  proximity: [{ q: number[]; kind: ShapeKind; k: number }, ProximityAnswer];
  skips: [{ kind: ShapeKind }, SkipsAnswer];
  editSkips: [{ kind: ShapeKind; edits: SkipEdit[]; skipped_reasons: string[] | null }, SkipsAnswer];
  samples: [Record<string, never>, { samples: Sample[] }];
  explain: [{ code: string }, Explanation];
  validate: [{ name: string }, Report];
  /** How much memory the module has, bytes. */
  memory: [Record<string, never>, number];
}

export type CallName = keyof Calls;

export interface Request {
  id: number;
  call: CallName;
  question: unknown;
}

export type Answer =
  | { id: number; value: unknown }
  | { id: number; error: string; trapped: boolean }
  | { id: number; progress: { done: number; of: number; what: string } };
