import type {
  About,
  Clearances,
  CollisionModel,
  Explanation,
  InverseQuestion,
  InverseSolution,
  PairDistance,
  Pose,
  Report,
  Shape,
  ShapeKind,
  SkipsAnswer,
} from "./protocol.js";

export type * from "./protocol.js";

/** The files of a URDD by path, with forward slashes, or the bytes of a zip archive of it. */
export type Source = { name: string } & (
  { files: Record<string, Uint8Array> } | { zip: Uint8Array }
);

/** Loads the module: from the package itself, or from these bytes. */
export function load(bytes?: BufferSource): Promise<Urdd>;

/** The files of a folder on disk, for Node. */
export function folder(path: string): Promise<Source>;

/** The loaded module. A crash (a `WebAssembly.RuntimeError`) ends it: load it again. */
export class Urdd {
  private constructor();
  /** The report, as `urdd validate --format json` prints it. */
  validate(source: Source): Report;
  /** Explains a rule, such as `DOF003`. */
  explain(code: string): Explanation;
  /** Opens a robot. Close it when it is no longer needed. */
  robot(source: Source): Robot;
}

/** A pair of shapes and their distance. */
export type Distance = Omit<PairDistance, "link_idxs" | "statistics">;

/** A robot. Configurations have a value for each DOF, rad or m; poses are in the root link's frame, metres. */
export class Robot {
  private constructor();
  /** Names, joints, bounds, mass and mesh files. */
  readonly about: About;
  /** The pose of each link. */
  linkPoses(q: ArrayLike<number> & Iterable<number>): Pose[];
  /** x, y, z and the quaternion w, x, y, z of each link, for each of the concatenated configurations. */
  linkPosesBatch(values: ArrayLike<number>): Float64Array;
  /** Random configuration `k` of SPEC 9.3. */
  random(k: number): number[];
  /** The configuration with each value clamped to its bounds. */
  clamp(q: Iterable<number>): number[];
  /** Searches for a configuration in which a link reaches a target position or pose. */
  inverseKinematics(
    question: InverseQuestion & { restarts?: number },
  ): InverseSolution;
  /** The distance and the closest points of each pair of shapes that is not skipped. */
  closestPoints(q: Iterable<number>, kind?: ShapeKind): Distance[];
  /** The nearest pairs. */
  nearest(q: Iterable<number>, k?: number, kind?: ShapeKind): Distance[];
  /** Whether shapes that are not skipped touch. */
  inCollision(q: Iterable<number>, kind?: ShapeKind): boolean;
  /** The learned self-collision model and its measured error rates; null if the URDD has none. */
  readonly collisionModel: CollisionModel | null;
  /**
   * The model's estimates, which are not a guarantee: if `may_collide` is false, a configuration can be filtered out;
   * check the others with `inCollision`. Null if the URDD has none.
   */
  clearances(q: Iterable<number>): Clearances | null;
  /** The skipped pairs, and the reasons. */
  skips(kind?: ShapeKind): SkipsAnswer;
  /** The boxes or spheres of a kind. */
  shapes(kind: ShapeKind): Shape[];
  /** The triangles of a mesh file of the URDD. */
  mesh(path: string): { positions: Float32Array; indices: Uint32Array };
  /** Frees its memory. */
  close(): void;
}
