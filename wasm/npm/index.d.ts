import type {
  About,
  Clearances,
  ClosedLoops,
  CollisionModel,
  Description,
  Explanation,
  InverseQuestion,
  InverseSolution,
  LoopErrors,
  PairDistance,
  Pose,
  Quaternion,
  Report,
  Shape,
  ShapeKind,
  SkipsAnswer,
  Vector,
} from "./protocol.js";

export type * from "./protocol.js";

/** The files of a URDD by path, with forward slashes, or the bytes of a zip archive of it. */
export type Source = { name: string } & (
  { files: Record<string, Uint8Array> } | { zip: Uint8Array }
);

/**
 * Loads the module: from the package itself, or from these bytes. `makerBytes` are those of `urdd/make.wasm`, which
 * lints and generates, where the package's own cannot be fetched.
 */
export function load(
  bytes?: BufferSource,
  makerBytes?: BufferSource | Promise<BufferSource>,
): Promise<Urdd>;

/**
 * A program that a URDF is for; a distribution of ROS stands for its urdfdom and its ros2_control, `gazebo` and
 * `ros2_control` for each of their versions.
 */
export type Program =
  | "ros"
  | "lyrical"
  | "rolling"
  | "jazzy"
  | "kilted"
  | "humble"
  | "noetic"
  | "iron"
  | "gazebo"
  | "fortress"
  | "harmonic"
  | "jetty"
  | "mujoco"
  | "mujoco3.3"
  | "pinocchio"
  | "drake"
  | "pybullet"
  | "isaac"
  | "newton"
  | "three"
  | "ros2_control"
  | "gz_ros2_control";

/** The files of a folder on disk, for Node. */
export function folder(path: string): Promise<Source>;

/** What is chosen of a description that is no URDF. */
export interface ImportOptions {
  /** The body of an MJCF or USD that is the root of the robot. By default it is told by the structure. */
  body?: string;
  /** The model of an SDF that has several. */
  model?: string;
  /** How a ball joint is written; by default `spherical`. */
  ball?: "spherical" | "revolute";
  /** The mass of links between several joints of one body: none, or 1e-9 kg and 1e-9 kg m²; by default `none`. */
  massless?: "none" | "tiny";
}

/** As the options of `urdd.generate` in Python. */
export interface GenerateOptions extends ImportOptions {
  /** The path of the description; it may be left out where there is one alone. */
  path?: string;
  /** Modules or classes besides the core class; by default all but the learned model. */
  modules?: string[];
  /** The geometry that shapes are computed from; by default `visual`. */
  geometry?: "visual" | "collision";
  /** By default all three; the .glb is always written. */
  mesh_formats?: ("glb" | "stl" | "obj")[];
  /** Maximum number of convex pieces of a link, 1 to 64; by default 7. */
  pieces?: number;
  /** Mean distance from the outside of pieces to the link's surface, metres; above 0. */
  piece_tolerance?: number;
  /** Sampled configurations of the distance statistics, 1 to 100,000; by default 1000. */
  samples?: number;
  /** The named configuration of an MJCF in which links that touch are skipped, in place of the default configuration. */
  reference?: string;
  /** Refuses a robot of which a mesh is missing, or something has to be assumed. */
  strict?: boolean;
}

/** Progress of a long job: `done` of `of` steps are finished. */
export interface Progress {
  what: string;
  done: number;
  of: number;
}

/** A generated URDD: its files, what it is, and what was assumed. */
export interface Generated {
  name: string;
  files: Record<string, Uint8Array>;
  links: number;
  joints: number;
  dofs: number;
  class: string;
  modules: string[];
  notes: string[];
}

/** The files of an imported robot. */
export interface ImportedRobot {
  /** The path of the URDF. */
  urdf: string;
  files: Record<string, Uint8Array>;
  /** What was carried, carried otherwise, and lost. */
  report: Record<string, unknown>;
}

/** The formats of other programs. */
export type Format =
  | "srdf"
  | "urdf"
  | "drake"
  | "mjcf"
  | "curobo"
  | "foam"
  | "spherized"
  | "moveit"
  | "sdf"
  | "usd"
  | "urdf-plus"
  | "extended-urdf";

/** As the options of `urdd.export` in Python. */
export interface ExportOptions {
  /** The name of the file, after which meshes are named, or of the package; by default `robot`. */
  output?: string;
  // `cargo xtask update` writes these.
  /**
   * Shapes that represent the links, in the collision geometry and in the disabled pairs. `pieces`: the convex pieces
   * of links; `hulls`: the convex hulls of links; `boxes`: the bounding boxes of hulls; `spheres`: the bounding spheres
   * of hulls; `piece-boxes`: the bounding boxes of pieces; `piece-spheres`: the bounding spheres of pieces; `source`:
   * the collision elements of the source: boxes, cylinders, capsules, spheres and meshes as it has them, and pieces for
   * links that have none. Visual primitives stay primitives too.
   */
  shapes?: ShapeKind | "source";
  /**
   * Reasons for which pairs of links are disabled. Default: those of the URDD. A person's edits apply in either case.
   */
  reasons?: ("same-link" | "always" | "adjacent" | "default" | "never")[];
  /**
   * Checks a pair of links if the URDD skips some pairs of their pieces and checks others. By default, such a pair is
   * disabled. Applies to formats that list pairs of links; MJCF always follows the URDD for each piece, and USD then
   * does.
   */
  keep_pairs?: boolean;
  /**
   * Maximum number of spheres per link. Default: 12 on average and at most 150 in total; with `cover`, 8. It is a whole
   * number from 1 to 10,000.
   */
  spheres?: number;
  /**
   * Maximum number of spheres for all links together; each link has at least one. It is a whole number from 1 to
   * 65,535.
   */
  total_spheres?: number;
  /**
   * Makes the spheres enclose each link completely. No collision is missed then, but often every configuration is in
   * contact; the file states how often. By default, spheres are fitted to give the same answers as the shapes.
   */
  cover?: boolean;
  /**
   * Number of sampled configurations in which spheres are measured; fewer where that would take long. It is a whole
   * number from 100 to 1,000,000.
   */
  samples?: number;
  /**
   * Visual geometry with fewer triangles: at most a part of them (`0.1`), or at most as many in total (`20000`).
   * `false` leaves it out.
   */
  visuals?: boolean | number;
  /**
   * The folder of the mesh files, relative to the file. Default: the name of the file without its extension, followed
   * by `_meshes`.
   */
  mesh_folder?: string;
  /**
   * MJCF, SDF and USD: the root link moves freely. Otherwise it is fixed to the world.
   */
  floating_base?: boolean;
  /**
   * Puts a box, cylinder, capsule or sphere around each convex mesh in its place, the tightest that has at most VOLUME
   * times the volume of the mesh and is at most STANDOFF metres off it. Pairs are judged by these shapes. Not for
   * formats of spheres.
   */
  fit?: [number, number];
  /**
   * Makes one body of links that are fixed to each other, with their masses, shapes and pairs. Each keeps its frame: a
   * site, a frame, an empty `Xform`, or in URDF an empty link. Not for formats of spheres.
   */
  merge_fixed?: boolean;
  /**
   * Makes another link the root: joints between it and the old root are turned round. Values, limits and names of
   * joints stay. Not for formats of spheres.
   */
  root?: string;
  /**
   * MJCF and USD: adds an actuator, or a drive, to each joint of one DOF. Gains are computed from inertias, for
   * `bandwidth`. `position`: they are told positions, rad or m; `velocity`: they are told velocities, rad/s or m/s;
   * `motor`: they are told torques or forces, N m or N.
   */
  actuators?: "position" | "velocity" | "motor";
  /**
   * MJCF and USD: the frequency below which a joint follows its actuator, Hz. Default: that of `NAME.export.toml`, or
   * 10. It is from 0.01 to 1,000 Hz.
   */
  bandwidth?: number;
  /**
   * MJCF: a gyroscope and an accelerometer at each IMU frame of `NAME.export.toml`.
   */
  sensors?: boolean;
  /**
   * MJCF: writes a scene with floor and light beside the file: `NAME_scene.xml`.
   */
  scene?: boolean;
  /**
   * cuRobo: writes the whole robot file, for the URDF of this path.
   */
  robot_file?: string;
  /**
   * MoveIt: the name of the package. Default: the name of the folder. Drake: writes `package.xml` and a model directive
   * beside the file.
   */
  package?: string;
  /**
   * MoveIt: the distribution of ROS 2 whose MoveIt and ros2_control read the package. Default: jazzy, whose files
   * Kilted reads too. `humble`: MoveIt 2.5, ros2_control 2; `jazzy`: MoveIt 2.12, ros2_control 4; Kilted reads the same
   * files.
   */
  ros?: "humble" | "jazzy";
  // These are written by hand.
  /** The content of an `export.toml`. */
  setup?: string;
}

/** Files for another program. */
export interface Exported {
  /** The path of the format's own file. */
  main: string;
  files: Record<string, Uint8Array>;
  notes: string[];
  /** What was carried, carried otherwise, and lost. */
  report: Record<string, unknown>;
}

/** The loaded module. A crash (a `WebAssembly.RuntimeError`) ends it: load it again. */
export class Urdd {
  private constructor();
  /** The report, as `urdd validate --format json` prints it. */
  validate(source: Source): Report;
  /**
   * What is wrong with a URDF, and what programs do with it: the report, as `urdd lint --format json` prints it. The URDF is
   * a text, its bytes, or a file among others; a mesh that is not among them is missing. The first call loads a second
   * module.
   */
  lint(
    urdf: string | Uint8Array | Source,
    question?: {
      /** The programs that it is for: what these refuse is an error, what only others do is an information. */
      for?: Program[];
      /** Its path among the files; it may be left out where there is one `.urdf` alone. */
      urdf?: string;
    },
  ): Promise<Report>;
  /** The robot descriptions among files. A xacro file is a program, which has to be expanded first. */
  descriptions(source: Source): Promise<Description[]>;
  /**
   * A URDD of a URDF, MJCF, SDF or USD, as `urdd generate` makes it: a source for `validate`, `robot` and `export`. It takes
   * seconds to a minute on the calling thread: use a worker. The same description gives the same bytes here, and
   * within SPEC's tolerances those of the program.
   */
  generate(
    source: string | Uint8Array | Source,
    options?: GenerateOptions,
    progress?: (progress: Progress) => void,
  ): Promise<Generated>;
  /** The URDF of an MJCF, SDF or USD, with its meshes, an SRDF and an `export.toml`, as `urdd import` writes them. */
  importRobot(
    source: Source,
    options?: ImportOptions & { path?: string },
  ): Promise<ImportedRobot>;
  /** The robot of a URDD for another program, as `urdd export` writes it. */
  export(
    urdd: Source,
    format: Format,
    options?: ExportOptions,
  ): Promise<Exported>;
  /** Explains a rule, such as `DOF003`; those of `lint` after its first call. */
  explain(code: string): Explanation;
  /** Opens a robot. Close it when it is no longer needed. */
  robot(source: Source): Robot;
}

/** A pair of shapes and their distance. */
export type Distance = Omit<PairDistance, "link_idxs" | "statistics">;

/** The distance between a shape of the robot, or of what it carries, and an obstacle. */
export interface ObstacleDistance {
  link: string;
  piece: number;
  obstacle: string;
  /** Metres; 0 if they touch or overlap. */
  distance: number;
  /** The closest points, in the root link's frame, metres. */
  points: [Vector, Vector];
}

/** How far two shapes overlap. */
export interface Depth {
  /** The length of the least translation that separates the two, metres. */
  depth: number;
  /** The unit vector along which the second would move, in the root link's frame. */
  direction: Vector;
  /** The derivative of the depth for each DOF, m/rad or m/m. */
  gradient: number[];
}

/**
 * A body. Capsules and cylinders are along the z axis of its frame; the half length is that of the segment. `points` is a
 * cloud: all points that are at most `radius` from one of them. `height_field` has `columns` heights in a row: each is a
 * column with the sizes `cell` along x and y, its centre at x = column * cell[0], y = row * cell[1], which reaches from its
 * height `thickness` down. Metres.
 */
export type Body = {
  name: string;
  /** Of its frame, in the root link's frame, or in that of the link that carries it; metres. */
  position?: Vector;
  quaternion_wxyz?: Quaternion;
  /** Names of links and of what they carry that may touch it. */
  ignoring?: string[];
} & (
  | { box: { half_extents: Vector } }
  | { sphere: { radius: number } }
  | { capsule: { radius: number; half_length: number } }
  | { cylinder: { radius: number; half_length: number } }
  | { hull: { points: Vector[] } }
  | { points: { points: Vector[]; radius: number } }
  | {
      height_field: {
        heights: number[];
        columns: number;
        cell: [number, number];
        thickness: number;
      };
    }
);

/** The pairs of the robot's own shapes, with what its links carry. */
export interface Own {
  /** `pieces` by default. */
  kind?: ShapeKind;
  attached?: (Body & { link: number })[];
  /** Names of links and of what they carry, by pairs that are left out: MoveIt's allowed collision matrix. */
  without?: [string, string][];
  /** Names of links and of what they carry that are left out, among obstacles too. */
  without_bodies?: string[];
}

/** The pairs of a shape of the robot and an obstacle. Obstacles that stay or move are not prepared again. */
export interface Among extends Own {
  obstacles: Body[];
}

/** How a motion is checked. */
export interface EdgeOptions {
  /** The distance that is kept, metres; 0 by default. */
  margin?: number;
  resolution?: number;
  /** Whether kinematic loops may be open on the way: all DOFs go straight. */
  open_loops?: boolean;
}

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
    question: InverseQuestion & {
      restarts?: number;
      /** Of the translation along and the rotation about the axes of the target; 0 leaves one free. */
      weights?: [number, number, number, number, number, number];
      /** A configuration that the solution should be near. */
      posture?: number[];
      /** The shapes that must not touch one another in the solution. */
      free_of?: ShapeKind;
      /** Obstacles that the shapes of `free_of`, or pieces, must not touch in the solution. */
      obstacles?: Body[];
      /** What links carry: it counts with the shapes. */
      attached?: (Body & { link: number })[];
      /** The distance that the solution keeps from obstacles, metres. */
      margin?: number;
      /** Whether to find out why a target is not reached: the verdict then is not `unknown`. */
      explain?: boolean;
    },
  ): InverseSolution;
  /**
   * How far a configuration is from closed: the gap of each kinematic loop (metres, rad), and the sum of each coupling. A
   * robot without `loops_module` has neither, and is closed.
   */
  loopErrors(q: Iterable<number>): LoopErrors;
  /**
   * The closed configuration that is near, within the bounds. The DOFs of `held` keep their values. Where none is found,
   * `is_closed` is false, and the configuration is the one with the smallest gaps. Start from the last closed one of a motion.
   */
  closeLoops(q: Iterable<number>, held?: number[]): ClosedLoops;
  /** The DOFs that move freely at a closed configuration, and those that follow from them. */
  freeDofs(q: Iterable<number>): { independent: number[]; dependent: number[] };
  /** The left-hand side of each equation of the loops and couplings, 0 where it holds: metres, rad. */
  loopResiduals(q: Iterable<number>): number[];
  /** The derivatives of the equations: for each, one number for each DOF. Rows that say the same as others are normal. */
  loopJacobian(q: Iterable<number>): number[][];
  /**
   * The velocities of all DOFs, rad/s or m/s, that keep the loops closed, for those of the independent ones
   * (`about.loops.independent`; all for a tree); null where the others do not follow from these.
   */
  loopVelocities(
    q: Iterable<number>,
    independent: Iterable<number>,
  ): number[] | null;
  /** The distance and the closest points of each pair of shapes that is not skipped. */
  closestPoints(q: Iterable<number>, kind?: ShapeKind): Distance[];
  /** The nearest pairs, among obstacles where they are given. */
  nearest(q: Iterable<number>, k: number, among: Among): ObstacleDistance[];
  nearest(q: Iterable<number>, k?: number, among?: ShapeKind | Own): Distance[];
  /**
   * The pairs of links that are skipped because they touch in the default configuration, or in the reference. Where they
   * touch elsewhere, the robot collides, and `inCollision` calls it free.
   */
  skippedContacts(kind?: ShapeKind): [string, string][];
  /** Whether shapes that are not skipped touch, or one touches an obstacle. */
  inCollision(q: Iterable<number>, among?: ShapeKind | Own | Among): boolean;
  /**
   * Whether a pair is at most `margin` apart, metres. With a margin above 0, pairs count whose links can move against each
   * other.
   */
  isWithin(
    q: Iterable<number>,
    margin: number,
    among?: ShapeKind | Own | Among,
  ): boolean;
  /**
   * Where a straight motion is blocked, as a part of it from 0 to 1; null if it is free. Between two checked
   * configurations no point of the robot travels farther than `resolution`, metres, and the end and the halves come
   * first: the answer need not be the first part that is blocked. Without, the motion is proved free, which needs 0.1 mm
   * more than the margin.
   *
   * Of a robot with kinematic loops, the independent DOFs go straight and the others follow. Both ends must be closed
   * (`closeLoops`), and a resolution is needed. Where the loops do not close on the way, the motion is blocked.
   */
  blockedEdge(
    start: Iterable<number>,
    end: Iterable<number>,
    among?: (Own | Among) & EdgeOptions,
  ): number | null;
  /**
   * The last part of a straight motion that is known to be free (0 if the start is not), and the first that is blocked;
   * null if it is free. Between the two no point of the robot travels farther than a thousandth of the resolution.
   */
  firstContact(
    start: Iterable<number>,
    end: Iterable<number>,
    among?: (Own | Among) & EdgeOptions,
  ): {
    free: number;
    blocked: number;
    /** A pair too near; loops that do not close; or an end on another branch of the closed configurations. */
    obstruction: "contact" | "open" | "branch";
  } | null;
  /** The nearest pairs, with the derivative of each distance for each DOF, m/rad or m/m; null where the two touch. */
  gradients(
    q: Iterable<number>,
    k: number,
    among: Among,
  ): (ObstacleDistance & { gradient: number[] | null })[];
  gradients(
    q: Iterable<number>,
    k?: number,
    among?: ShapeKind | Own,
  ): (Distance & { gradient: number[] | null })[];
  /** The pairs that touch or overlap. */
  penetrations(q: Iterable<number>, among: Among): (ObstacleDistance & Depth)[];
  penetrations(
    q: Iterable<number>,
    among?: ShapeKind | Own,
  ): (Distance & Depth)[];
  /** The largest velocity (rad/s or m/s) and effort (N m or N) of each DOF; null without a limit. */
  readonly limits: {
    velocity: (number | null)[];
    effort: (number | null)[];
  };
  /** The mass of each link, kg, and its centre of mass in the link's frame, metres. */
  readonly linkMasses: { mass: number; centre: Vector }[];
  /** The centre of mass in the root link's frame, metres; null for a robot without masses. */
  centreOfMass(q: Iterable<number>): Vector | null;
  /**
   * The torque (N m) or force (N) of each DOF that holds the robot still against gravity: what the motors must give,
   * positive where the DOF must push toward larger values. `gravity` is in the root link's frame, m/s², by default
   * (0, 0, -9.81). A payload is a link's index, a mass in kg, and its place in the link's frame, metres, by default the
   * origin.
   */
  gravityTorques(
    q: Iterable<number>,
    settings?: {
      gravity?: Vector;
      payload?: { link: number; mass: number; point?: Vector };
    },
  ): number[];
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
  /**
   * Prepares the spheres that the URDD has (its `link_shapes_spheres_module`), for yes or no: the finest level that covers the
   * shapes, or the last that does not. Close it when it is no longer needed; it outlives the robot.
   */
  sphereChecker(options: { covers: true }): SphereChecker<CoveringAnswer>;
  sphereChecker(options?: { covers?: false }): SphereChecker<ApproximateAnswer>;
  /** The triangles of a mesh file of the URDD. */
  mesh(path: string): { positions: Float32Array; indices: Uint32Array };
  /** Frees its memory. */
  close(): void;
}

/** What covering spheres say: certainly no contact; or spheres touch, and the shapes may. */
export type CoveringAnswer = "free" | "maybe";
/** What approximating spheres say: whether spheres touch. Nothing is certain of the shapes. */
export type ApproximateAnswer = "free" | "contact";

/** How a motion is checked by spheres. */
export interface SphereEdgeOptions {
  /** The distance that is kept, metres; 0 by default. */
  margin?: number;
  /** No point of a sphere travels farther between two checked configurations, metres; 0.01 by default. */
  resolution?: number;
  /** Whether kinematic loops may be open on the way, which is needed for a robot with any: all DOFs go straight. */
  open_loops?: boolean;
}

/**
 * The spheres of a robot. Configurations have a value for each DOF, rad or m, at most 1e9. Batches take them one after
 * another: they are faster, also because a call takes longer than a check.
 */
export class SphereChecker<
  Answer extends CoveringAnswer | ApproximateAnswer =
    CoveringAnswer | ApproximateAnswer,
> {
  private constructor();
  /** The number of values of a configuration. */
  readonly numDofs: number;
  /**
   * The same spheres among obstacles: each query then asks for both. Obstacles that stay or move since the last call are not
   * prepared again. Close it, too.
   */
  around(obstacles: Body[]): SphereChecker<Answer>;
  /** What the spheres say of a configuration. No answer is a boolean: compare with `"free"`. */
  inCollision(q: Iterable<number>): Answer;
  inCollisionBatch(values: ArrayLike<number>): Answer[];
  /** The same of spheres that are at most `margin` apart, metres. */
  isWithin(q: Iterable<number>, margin: number): Answer;
  isWithinBatch(values: ArrayLike<number>, margin: number): Answer[];
  /** Where spheres touch on a straight motion, as a part of it from 0 to 1; null if they do not. It need not be the first. */
  blockedEdge(
    start: Iterable<number>,
    end: Iterable<number>,
    options?: SphereEdgeOptions,
  ): number | null;
  /** The same for many motions; NaN where the motion is free. */
  blockedEdgeBatch(
    starts: ArrayLike<number>,
    ends: ArrayLike<number>,
    options?: SphereEdgeOptions,
  ): Float64Array;
  /** The last part of a straight motion in which no spheres touch, and the first in which some do; null if it is free. */
  firstContact(
    start: Iterable<number>,
    end: Iterable<number>,
    options?: SphereEdgeOptions,
  ): { free: number; blocked: number } | null;
  /** Two numbers for each of many motions; NaN where it is free. */
  firstContactBatch(
    starts: ArrayLike<number>,
    ends: ArrayLike<number>,
    options?: SphereEdgeOptions,
  ): Float64Array;
  /** Frees its memory. */
  close(): void;
}
