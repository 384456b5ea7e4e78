import type {
  About,
  Clearances,
  CollisionModel,
  Explanation,
  PairDistance,
  Pose,
  Reached,
  Report,
  ShapeKind,
  SkipsAnswer,
  Volume,
  Wish,
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

/** The module, loaded. A fault of its own (a `WebAssembly.RuntimeError`) ends it: load it again. */
export class Urdd {
  private constructor();
  /** The report, as `urdd validate --format json` prints it. */
  validate(source: Source): Report;
  /** What a rule checks, such as `DOF003`, why, and what to do. */
  explain(code: string): Explanation;
  /** A robot to ask about itself. Close it when it is not needed any more. */
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
  poses(q: ArrayLike<number> & Iterable<number>): Pose[];
  /** x, y, z and the quaternion w, x, y, z of each link, in each of the configurations that follow each other. */
  posesOfMany(values: ArrayLike<number>): Float64Array;
  /** Number `k` of the random configurations of SPEC 9.2. */
  random(k: number): number[];
  /** The nearest configuration within the bounds. */
  clamp(q: Iterable<number>): number[];
  /** Looks for a configuration in which a point of a link is where it should be. */
  reach(wish: Wish & { restarts?: number }): Reached;
  /** Every pair of shapes that is not skipped. */
  distances(q: Iterable<number>, shapes?: ShapeKind): Distance[];
  /** The nearest pairs. */
  nearest(q: Iterable<number>, k?: number, shapes?: ShapeKind): Distance[];
  /** Whether shapes that are not skipped touch. */
  inCollision(q: Iterable<number>, shapes?: ShapeKind): boolean;
  /** What the learned self-collision model is, and how often it was wrong; null where the URDD has none. */
  readonly collisionModel: CollisionModel | null;
  /**
   * What that model estimates, which guarantees nothing: where `may_collide` is false a configuration may be passed
   * over, and the others checked by `inCollision`. Null where the URDD has none.
   */
  clearances(q: Iterable<number>): Clearances | null;
  /** Which pairs are skipped, and why. */
  skips(shapes?: ShapeKind): SkipsAnswer;
  /** Boxes or spheres. */
  volumes(shapes: ShapeKind): Volume[];
  /** The triangles of a mesh file of the URDD. */
  mesh(path: string): { positions: Float32Array; indices: Uint32Array };
  /** Gives its memory back. */
  close(): void;
}
