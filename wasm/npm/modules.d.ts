// Types of the documents of a URDD of version 1. Written from `schema/` by
// crates/urdd-format/tests/format/typescript.rs. Do not edit.

/** Keys of extensions, which any object may have. */
export interface Extensible {
  [key: `x_${string}`]: unknown;
}

/**
 * How much of the specification a URDD carries and fulfils; each class holds those before it.
 * - `Core`: Kinematics: urdf, dof, chain, connections, bounds (and kinematics samples, recommended).
 * - `Geometry`: Core, and the four mesh modules.
 * - `Shapes`: Geometry, and the link shape modules.
 */
export type ConformanceClass = "Core" | "Geometry" | "Shapes";

/**
 * The program that wrote a URDD.
 */
export interface Generator extends Extensible {
  /**
   * Name of the program.
   */
  name: string;
  /**
   * Its version, in its own numbering.
   */
  version: string;
}

/**
 * What a URDD was made from: one key, which says of what kind the source is.
 */
export type Source = UrdfSource;

/**
 * A file of the directory, with what is needed to see that it is unchanged.
 */
export interface FileEntry extends Extensible {
  /**
   * Path relative to the URDD's root, with forward slashes.
   */
  path: string;
  /**
   * Size in bytes.
   *
   * Unit: `byte`.
   */
  size: number;
  /**
   * SHA-256 of the bytes.
   */
  sha256: string;
}

/**
 * A URDF, carried verbatim in the URDD's root.
 */
export interface UrdfSource extends Extensible {
  Urdf: FileEntry;
}

/**
 * One module of the directory.
 */
export interface ModuleEntry extends Extensible {
  /**
   * Name of the module, such as `dof_module`: the last part of its path.
   */
  name: string;
  /**
   * Version of the module's format; equal to the module's `VERSION` file.
   */
  version: string;
  /**
   * Folder of the module, relative to the URDD's root, with forward slashes.
   */
  path: string;
  /**
   * Names of the modules that this one was derived from.
   */
  depends_on: string[];
  /**
   * Every file of the module, sorted by path (byte order).
   */
  files: FileEntry[];
}

/**
 * Root metadata of a URDD (`urdd.json`): names the robot, the specification's version, the source, and
 * every module with its files.
 */
export interface RootMetadata extends Extensible {
  /**
   * Version of the URDD specification that this directory follows.
   */
  urdd_version: string;
  /**
   * Name of the robot; equal to `name` of `urdf_module`.
   */
  robot_name: string;
  /**
   * The conformance class that the directory claims to fulfil.
   */
  conformance_class: ConformanceClass;
  /**
   * The program that wrote the directory; null when written by hand. Free: not checked.
   */
  generator: Generator | null;
  /**
   * What the directory was made from; null when from nothing that can be named.
   */
  source: Source | null;
  /**
   * Every module, in the order of the specification's table of modules, extensions last.
   */
  modules: ModuleEntry[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A link: a rigid body.
 */
export interface Link extends Extensible {
  /**
   * Name, unique among the links.
   */
  name: string;
  /**
   * Mass, centre of mass and inertia.
   */
  inertial: Inertial | null;
  /**
   * Visual elements in the order of the file.
   */
  visual: Visual[];
  /**
   * Collision elements in the order of the file.
   */
  collision: Collision[];
  /**
   * Other elements directly under `<link>`, each as its own XML text.
   */
  unknown_elements: string[];
}

/**
 * Mass properties of a link.
 */
export interface Inertial extends Extensible {
  /**
   * Centre of mass, and the axes of `inertia`, in the link's frame.
   *
   * Frame: `link`.
   */
  origin: Origin | null;
  /**
   * Mass.
   */
  mass: Mass | null;
  /**
   * Inertia tensor about the centre of mass, in the axes of `origin`.
   *
   * Frame: `inertial`.
   */
  inertia: Inertia | null;
}

/**
 * A pose as the URDF writes it.
 */
export interface Origin extends Extensible {
  /**
   * Position, metres: x, y, z.
   *
   * Unit: `m`.
   */
  xyz: [number, number, number] | null;
  /**
   * Fixed-axis roll, pitch, yaw, radians: turn about x, then y, then z of the outer frame.
   *
   * Unit: `rad`.
   */
  rpy: [number, number, number] | null;
  /**
   * Rotation as a quaternion x, y, z, w of any length but zero, instead of `rpy`. It counts from URDF
   * version 1.1 on; before, it has no meaning.
   *
   * Unit: `1`.
   */
  quat_xyzw: [number, number, number, number] | null;
}

/**
 * Mass of a link.
 */
export interface Mass extends Extensible {
  /**
   * Kilograms.
   *
   * Unit: `kg`.
   */
  value: number;
}

/**
 * The six independent elements of a symmetric inertia tensor, kg m².
 */
export interface Inertia extends Extensible {
  /**
   * Element xx.
   *
   * Unit: `kg*m^2`.
   */
  ixx: number | null;
  /**
   * Element xy.
   *
   * Unit: `kg*m^2`.
   */
  ixy: number | null;
  /**
   * Element xz.
   *
   * Unit: `kg*m^2`.
   */
  ixz: number | null;
  /**
   * Element yy.
   *
   * Unit: `kg*m^2`.
   */
  iyy: number | null;
  /**
   * Element yz.
   *
   * Unit: `kg*m^2`.
   */
  iyz: number | null;
  /**
   * Element zz.
   *
   * Unit: `kg*m^2`.
   */
  izz: number | null;
}

/**
 * What a link looks like, or a part of it.
 */
export interface Visual extends Extensible {
  /**
   * Name of the element.
   */
  name: string | null;
  /**
   * Pose of the geometry in the link's frame.
   *
   * Frame: `link`.
   */
  origin: Origin | null;
  /**
   * Its shape.
   *
   * Frame: `shape`.
   */
  geometry: Geometry | null;
  /**
   * Its material.
   */
  material: Material | null;
}

/**
 * A shape: an object of one key, which says of what kind it is.
 */
export type Geometry = MeshGeometry | BoxGeometry | CylinderGeometry | CapsuleGeometry | SphereGeometry;

/**
 * A mesh file.
 */
export interface Mesh extends Extensible {
  /**
   * File name as the URDF has it (`package://…`, `file://…`, relative or absolute).
   */
  filename: string;
  /**
   * Factors along x, y, z; null means 1, 1, 1.
   *
   * Unit: `1`.
   */
  scale: [number, number, number] | null;
}

/**
 * A mesh file.
 */
export interface MeshGeometry extends Extensible {
  Mesh: Mesh;
}

/**
 * A box about the origin.
 */
export interface Cuboid extends Extensible {
  /**
   * Full side lengths along x, y, z, metres.
   *
   * Unit: `m`.
   */
  size: [number, number, number];
}

/**
 * A box about the origin.
 */
export interface BoxGeometry extends Extensible {
  Box: Cuboid;
}

/**
 * A cylinder about the origin, along z.
 */
export interface Cylinder extends Extensible {
  /**
   * Radius, metres.
   *
   * Unit: `m`.
   */
  radius: number;
  /**
   * Full length, metres.
   *
   * Unit: `m`.
   */
  length: number;
}

/**
 * A cylinder about the origin, along z.
 */
export interface CylinderGeometry extends Extensible {
  Cylinder: Cylinder;
}

/**
 * A capsule about the origin, along z: a cylinder with half a sphere on each end.
 */
export interface Capsule extends Extensible {
  /**
   * Radius, metres.
   *
   * Unit: `m`.
   */
  radius: number;
  /**
   * Length of the cylinder without the half spheres, metres.
   *
   * Unit: `m`.
   */
  length: number;
}

/**
 * A capsule about the origin, along z.
 */
export interface CapsuleGeometry extends Extensible {
  Capsule: Capsule;
}

/**
 * A sphere about the origin.
 */
export interface Sphere extends Extensible {
  /**
   * Radius, metres.
   *
   * Unit: `m`.
   */
  radius: number;
}

/**
 * A sphere about the origin.
 */
export interface SphereGeometry extends Extensible {
  Sphere: Sphere;
}

/**
 * A material, or a reference to one by its name.
 */
export interface Material extends Extensible {
  /**
   * Name.
   */
  name: string | null;
  /**
   * Colour.
   */
  color: Color | null;
  /**
   * Texture.
   */
  texture: Texture | null;
}

/**
 * A colour.
 */
export interface Color extends Extensible {
  /**
   * Red, green, blue, opacity, each from 0 to 1.
   *
   * Unit: `1`.
   */
  rgba: [number, number, number, number];
}

/**
 * A texture.
 */
export interface Texture extends Extensible {
  /**
   * File name as the URDF has it.
   */
  filename: string;
}

/**
 * What a link collides with, or a part of it.
 */
export interface Collision extends Extensible {
  /**
   * Name of the element.
   */
  name: string | null;
  /**
   * Pose of the geometry in the link's frame.
   *
   * Frame: `link`.
   */
  origin: Origin | null;
  /**
   * Its shape.
   *
   * Frame: `shape`.
   */
  geometry: Geometry | null;
}

/**
 * A joint: how one link moves on another.
 */
export interface Joint extends Extensible {
  /**
   * Name, unique among the joints.
   */
  name: string;
  /**
   * How it moves.
   */
  joint_type: JointType;
  /**
   * Pose of the joint's frame (which is the child link's frame at zero) in the parent link's frame.
   *
   * Frame: `parent_link`.
   */
  origin: Origin | null;
  /**
   * The link that carries the joint.
   */
  parent: LinkName;
  /**
   * The link that the joint moves.
   */
  child: LinkName;
  /**
   * Axis in the joint's frame, as written: not normalised. Null means (1, 0, 0).
   *
   * Frame: `joint`.
   */
  axis: Axis | null;
  /**
   * Limits.
   */
  limit: Limit | null;
  /**
   * Damping and friction.
   */
  dynamics: Dynamics | null;
  /**
   * The joint that this one follows.
   */
  mimic: Mimic | null;
  /**
   * Soft limits.
   */
  safety_controller: SafetyController | null;
  /**
   * Reference positions.
   */
  calibration: Calibration | null;
  /**
   * Other elements directly under `<joint>`, each as its own XML text.
   */
  unknown_elements: string[];
}

/**
 * How a joint moves.
 * - `Revolute`: Turns about its axis, within limits. One DOF, rad.
 * - `Continuous`: Turns about its axis, without limits. One DOF, rad.
 * - `Prismatic`: Slides along its axis. One DOF, m.
 * - `Fixed`: Does not move. No DOF.
 * - `Floating`: Moves freely. Six DOFs: x, y, z (m), then a rotation vector (rad).
 * - `Planar`: Slides in the plane normal to its axis and turns about it. Three DOFs: x, y (m), angle
 * (rad).
 * - `Spherical`: Turns freely. Three DOFs: a rotation vector (rad). Not in URDF's own list; accepted
 * by many readers.
 */
export type JointType = "Revolute" | "Continuous" | "Prismatic" | "Fixed" | "Floating" | "Planar" | "Spherical";

/**
 * A link, by name.
 */
export interface LinkName extends Extensible {
  /**
   * Name of the link.
   */
  link: string;
}

/**
 * The axis of a joint.
 */
export interface Axis extends Extensible {
  /**
   * Direction in the joint's frame, of any length but zero.
   *
   * Unit: `1`.
   */
  xyz: [number, number, number] | null;
}

/**
 * Limits of a joint: rad, rad/s, N m for turning joints; m, m/s, N for sliding ones.
 */
export interface Limit extends Extensible {
  /**
   * Smallest position.
   *
   * Unit: `rad or m`.
   */
  lower: number | null;
  /**
   * Largest position.
   *
   * Unit: `rad or m`.
   */
  upper: number | null;
  /**
   * Largest effort.
   *
   * Unit: `N*m or N`.
   */
  effort: number | null;
  /**
   * Largest speed.
   *
   * Unit: `rad/s or m/s`.
   */
  velocity: number | null;
  /**
   * Largest acceleration, rad/s² or m/s². This and the next two: from URDF version 1.2 on.
   *
   * Unit: `rad/s^2 or m/s^2`.
   */
  acceleration: number | null;
  /**
   * Largest deceleration, rad/s² or m/s²; where it is absent, that of `acceleration`.
   *
   * Unit: `rad/s^2 or m/s^2`.
   */
  deceleration: number | null;
  /**
   * Largest rate of change of acceleration, rad/s³ or m/s³.
   *
   * Unit: `rad/s^3 or m/s^3`.
   */
  jerk: number | null;
}

/**
 * Dynamics of a joint.
 */
export interface Dynamics extends Extensible {
  /**
   * Damping: N m s/rad, or N s/m.
   *
   * Unit: `N*m*s/rad or N*s/m`.
   */
  damping: number | null;
  /**
   * Static friction: N m, or N.
   *
   * Unit: `N*m or N`.
   */
  friction: number | null;
}

/**
 * Follows another joint: `position = multiplier * position of joint + offset`.
 */
export interface Mimic extends Extensible {
  /**
   * Name of the joint that is followed.
   */
  joint: string;
  /**
   * Factor; null means 1.
   *
   * Unit: `1 or rad/m or m/rad`.
   */
  multiplier: number | null;
  /**
   * Offset, rad or m; null means 0.
   *
   * Unit: `rad or m`.
   */
  offset: number | null;
}

/**
 * Soft limits of a joint.
 */
export interface SafetyController extends Extensible {
  /**
   * Where the controller begins to limit the position, below.
   *
   * Unit: `rad or m`.
   */
  soft_lower_limit: number | null;
  /**
   * Where the controller begins to limit the position, above.
   *
   * Unit: `rad or m`.
   */
  soft_upper_limit: number | null;
  /**
   * Relation between position and velocity limits.
   *
   * Unit: `1/s`.
   */
  k_position: number | null;
  /**
   * Relation between effort and velocity limits.
   *
   * Unit: `N*m*s/rad or N*s/m`.
   */
  k_velocity: number | null;
}

/**
 * Reference positions of a joint.
 */
export interface Calibration extends Extensible {
  /**
   * Position at which a rising edge is seen.
   *
   * Unit: `rad or m`.
   */
  rising: number | null;
  /**
   * Position at which a falling edge is seen.
   *
   * Unit: `rad or m`.
   */
  falling: number | null;
}

/**
 * The source URDF as data. What the URDF leaves out is null (or an empty list), never a default.
 * Lengths are metres, angles radians, masses kilograms; rotations are the URDF's own fixed-axis roll,
 * pitch, yaw. Numbers that are not finite in the URDF are written as null.
 */
export interface UrdfModule extends Extensible {
  /**
   * Name of the robot (`<robot name>`).
   */
  name: string;
  /**
   * The URDF format version that the file states (`<robot version>`).
   */
  version: string | null;
  /**
   * Links in the order of the file. The place in this list is the link index.
   *
   * Length: `links`.
   */
  links: Link[];
  /**
   * Joints in the order of the file. The place in this list is the joint index.
   *
   * Length: `joints`.
   */
  joints: Joint[];
  /**
   * Materials declared at the top of the file, in its order.
   */
  materials: Material[];
  /**
   * Other elements directly under `<robot>` (transmission, gazebo, ros2_control, …), each as its own XML
   * text, in the order of the file.
   */
  unknown_elements: string[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * What a mimic joint's position is: `multiplier * q[dof_idx] + offset`.
 */
export interface ResolvedMimic extends Extensible {
  /**
   * The DOF that drives the joint; null where the chain of mimics ends in a fixed joint, and the
   * position is `offset` at all times.
   *
   * Index of: `dof`.
   */
  dof_idx: number | null;
  /**
   * Factor: the product of the factors along the chain of mimics.
   *
   * Unit: `1 or rad/m or m/rad`.
   */
  multiplier: number;
  /**
   * Offset, rad or m, accumulated along the chain of mimics.
   *
   * Unit: `rad or m`.
   */
  offset: number;
}

/**
 * A degree of freedom.
 */
export interface Dof extends Extensible {
  /**
   * Name: the joint's name where the joint has one DOF; else that name, a slash, and `trans_x`,
   * `trans_y`, `trans_z`, `rot_x`, `rot_y`, `rot_z` or (planar) `rot`.
   */
  name: string;
  /**
   * The joint that it moves.
   *
   * Index of: `joint`.
   */
  joint_idx: number;
  /**
   * Name of that joint.
   */
  joint_name: string;
  /**
   * What it measures.
   */
  quantity: Quantity;
}

/**
 * What a DOF measures.
 * - `Angle`: An angle, or a component of a rotation vector: radians.
 * - `Length`: A length: metres.
 */
export type Quantity = "Angle" | "Length";

/**
 * The robot's degrees of freedom (DOFs), in joint order, and the position of every joint as a function
 * of them.
 */
export interface DofModule extends Extensible {
  /**
   * Number of DOFs: the length of a configuration vector.
   *
   * Unit: `1`.
   */
  num_dofs: number;
  /**
   * For each DOF, its joint.
   *
   * Index of: `joint`. Length: `dofs`.
   */
  dof_idx_to_joint_idx_mapping: number[];
  /**
   * For each joint, its DOFs, ascending; empty for fixed and for mimic joints.
   *
   * Index of: `dof`. Length: `joints`.
   */
  joint_idx_to_dof_idxs_mapping: number[][];
  /**
   * For each joint, how it follows a DOF if it is a mimic joint, else null. Chains of mimics are
   * resolved.
   *
   * Length: `joints`.
   */
  joint_idx_to_mimic_mapping: (ResolvedMimic | null)[];
  /**
   * What each DOF is.
   *
   * Length: `dofs`.
   */
  dofs: Dof[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A link, with its neighbours.
 */
export interface LinkInChain extends Extensible {
  /**
   * Name of the link.
   */
  name: string;
  /**
   * Its own index: its place in this list.
   *
   * Index of: `link`.
   */
  link_idx: number;
  /**
   * The joint that moves it; null for the root.
   *
   * Index of: `joint`.
   */
  parent_joint_idx: number | null;
  /**
   * The link that this joint sits on; null for the root.
   *
   * Index of: `link`.
   */
  parent_link_idx: number | null;
  /**
   * The joints that sit on this link, ascending.
   *
   * Index of: `joint`.
   */
  children_joint_idxs: number[];
  /**
   * The links that these joints move, ascending.
   *
   * Index of: `link`.
   */
  children_link_idxs: number[];
}

/**
 * A joint, with its two links and its motion.
 */
export interface JointInChain extends Extensible {
  /**
   * Name of the joint.
   */
  joint_name: string;
  /**
   * Its own index: its place in this list.
   *
   * Index of: `joint`.
   */
  joint_idx: number;
  /**
   * Name of the link that carries it.
   */
  parent_link_name: string;
  /**
   * That link.
   *
   * Index of: `link`.
   */
  parent_link_idx: number;
  /**
   * Name of the link that it moves.
   */
  child_link_name: string;
  /**
   * That link.
   *
   * Index of: `link`.
   */
  child_link_idx: number;
  /**
   * How it moves.
   */
  joint_type: JointType;
  /**
   * Pose of the joint's frame in the parent link's frame. At the zero position the child link's frame is
   * the joint's frame.
   *
   * Frame: `parent_link`.
   */
  origin: Pose;
  /**
   * Unit axis in the joint's frame; for a planar joint the plane's normal. Null for fixed, floating and
   * spherical joints, which have none.
   *
   * Unit: `1`. Frame: `joint`.
   */
  axis: [number, number, number] | null;
}

/**
 * A rigid transform: where a frame lies, and how it is turned, seen from another frame. It takes
 * coordinates of the inner frame to the outer one: `p_outer = R * p_inner + position`.
 */
export interface Pose extends Extensible {
  /**
   * Origin of the inner frame in the outer frame, metres: x, y, z.
   *
   * Unit: `m`.
   */
  position: [number, number, number];
  /**
   * Rotation from the inner to the outer frame as a unit quaternion: w, x, y, z, with `w >= 0`.
   *
   * Unit: `1`.
   */
  quaternion_wxyz: [number, number, number, number];
}

/**
 * The kinematic tree: who is whose parent, and where each joint sits and how it moves. With
 * `dof_module`, this is all that forward kinematics needs.
 */
export interface ChainModule extends Extensible {
  /**
   * Every link, in link order.
   *
   * Length: `links`.
   */
  links_in_chain: LinkInChain[];
  /**
   * Every joint, in joint order.
   *
   * Length: `joints`.
   */
  joints_in_chain: JointInChain[];
  /**
   * Links by their depth below the root: level 0 is the root alone; each level ascending.
   *
   * Index of: `link`.
   */
  kinematic_hierarchy: number[][];
  /**
   * The one link without a parent.
   *
   * Index of: `link`.
   */
  root_idx: number;
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A path through the kinematic tree.
 */
export interface LinkPath extends Extensible {
  /**
   * The links along the path, both ends included.
   *
   * Index of: `link`.
   */
  links: number[];
  /**
   * The joints between them: one fewer than `links`.
   *
   * Index of: `joint`.
   */
  joints: number[];
}

/**
 * Paths through the kinematic tree. The path from link i to link j climbs from i to their lowest
 * common ancestor and goes down to j, so two slices of `root_paths` give it.
 */
export interface ConnectionsModule extends Extensible {
  /**
   * For each link, the path to it from the root.
   *
   * Length: `links`.
   */
  root_paths: LinkPath[];
  /**
   * Element (i, j) is the lowest link that lies above (or is) both i and j.
   *
   * Index of: `link`. Length: `links`, each `links`.
   */
  lowest_common_ancestors: number[][];
  /**
   * Element (i, j) is the path from link i to link j. May be null above 300 links, and where the paths
   * hold more than 2,000,000 links together.
   *
   * Length: `links`, each `links`.
   */
  link_to_link_paths: LinkPath[][] | null;
  /**
   * Element (i, j), where j is a descendant of i: the links from i (exclusive) to j (inclusive); where i
   * is j: `[i]`; else null. The whole may be null where `link_to_link_paths` may.
   *
   * Index of: `link`. Length: `links`, each `links`.
   */
  link_connection_paths: (number[] | null)[][] | null;
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * Bounds of the configuration space, per DOF: rad or m as `dofs` of `dof_module` says. Every bound is
 * finite.
 */
export interface BoundsModule extends Extensible {
  /**
   * Lower and upper bound of each DOF.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  bounds: [number, number][];
  /**
   * Lower bound of each DOF: the first elements of `bounds`.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  dof_lower_bounds: number[];
  /**
   * Upper bound of each DOF: the second elements of `bounds`.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  dof_upper_bounds: number[];
  /**
   * For each DOF, whether the source limits it. A DOF without limits has the bounds [-pi, pi] if it is
   * an angle and [-1, 1] if it is a length; a rotation vector's norm is at most pi.
   *
   * Length: `dofs`.
   */
  dof_limited: boolean[];
  /**
   * For each DOF, the largest speed (rad/s or m/s); null where the source has none.
   *
   * Unit: `rad/s or m/s`. Length: `dofs`.
   */
  dof_velocity_limits: (number | null)[];
  /**
   * For each DOF, the largest effort (N m or N); null where the source has none.
   *
   * Unit: `N*m or N`. Length: `dofs`.
   */
  dof_effort_limits: (number | null)[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A configuration, and where every link is then.
 */
export interface KinematicsSample extends Extensible {
  /**
   * Which configuration it is.
   */
  kind: ConfigurationKind;
  /**
   * The number of a sampled configuration; null for the other kinds.
   *
   * Index of: `sample`.
   */
  sample_idx: number | null;
  /**
   * One value per DOF, rad or m.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  configuration: number[];
  /**
   * For each link, its frame's pose in the root link's frame.
   *
   * Frame: `root`. Length: `links`.
   */
  link_poses: Pose[];
}

/**
 * A configuration that the specification defines.
 * - `Zero`: Every DOF 0, even where 0 is out of bounds.
 * - `Middle`: Every DOF half-way between its bounds; a rotation vector 0.
 * - `Lower`: Every DOF at its lower bound; a rotation vector (-pi, 0, 0).
 * - `Upper`: Every DOF at its upper bound; a rotation vector (pi, 0, 0).
 * - `Sampled`: Number `sample_idx` of the sequence of sampled configurations.
 */
export type ConfigurationKind = "Zero" | "Middle" | "Lower" | "Upper" | "Sampled";

/**
 * Configurations, and the pose of every link in each: values by which a consumer in any language
 * proves its forward kinematics right.
 */
export interface KinematicsSamplesModule extends Extensible {
  /**
   * The samples: zero, middle, lower, upper, then sampled ones in order.
   */
  samples: KinematicsSample[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A link that carries all parts and belongs to none of them.
 */
export interface CompositionBase extends Extensible {
  /**
   * The link.
   *
   * Index of: `link or other`.
   */
  link_idx: number;
}

/**
 * A robot that became a part of another.
 */
export interface CompositionPart extends Extensible {
  /**
   * By what name the recipe knows it; unique among the parts.
   */
  id: string;
  /**
   * Name of the robot that the part was.
   */
  name: string;
  /**
   * What it was taken from, with a digest.
   */
  source: PartSource;
  /**
   * What stands before the part's names of links and joints in this robot; empty for nothing.
   */
  prefix: string;
  /**
   * The part's links that are in this robot, in link order.
   */
  links: PartLink[];
  /**
   * The part's joints that are in this robot, in joint order.
   */
  joints: PartJoint[];
  /**
   * Names of the part's links that were left out, in the part's order.
   */
  dropped_links: string[];
  /**
   * Names of the part's joints that were left out, in the part's order.
   */
  dropped_joints: string[];
  /**
   * The part's joints that were made fixed, in joint order.
   */
  frozen_joints: FrozenJoint[];
  /**
   * What it hangs on; null for the part that is the root.
   */
  attachment: PartAttachment | null;
  /**
   * How the part itself was combined; null where it was not combined, or where this is not known.
   */
  composition: PartComposition | null;
}

/**
 * The source of a part: the SHA-256 of the file that identifies it.
 */
export type PartSource = UrddPartSource | UrdfPartSource;

/**
 * A URDD: of its `urdd.json`, which has the hashes of all its files.
 */
export interface UrddPartSource extends Extensible {
  /**
   * SHA-256 of a file's bytes, as 64 lower-case hexadecimal digits.
   */
  Urdd: string;
}

/**
 * A URDF, or a file that makes one: of the file.
 */
export interface UrdfPartSource extends Extensible {
  /**
   * SHA-256 of a file's bytes, as 64 lower-case hexadecimal digits.
   */
  Urdf: string;
}

/**
 * A link of a part.
 */
export interface PartLink extends Extensible {
  /**
   * Its name in the part.
   */
  name: string;
  /**
   * The link of this robot.
   *
   * Index of: `link or other`.
   */
  link_idx: number;
}

/**
 * A joint of a part.
 */
export interface PartJoint extends Extensible {
  /**
   * Its name in the part.
   */
  name: string;
  /**
   * The joint of this robot.
   *
   * Index of: `joint or other`.
   */
  joint_idx: number;
}

/**
 * A joint that moved in the part, and is fixed in this robot.
 */
export interface FrozenJoint extends Extensible {
  /**
   * The joint.
   *
   * Index of: `joint or other`.
   */
  joint_idx: number;
  /**
   * Where it was made fixed: a value for each DOF that it had, rad or m.
   *
   * Unit: `rad or m`.
   */
  position: number[];
}

/**
 * What a part hangs on.
 */
export interface PartAttachment extends Extensible {
  /**
   * The part that carries it; null for the base.
   *
   * Index of: `part or other`.
   */
  part_idx: number | null;
  /**
   * The link that carries it.
   *
   * Index of: `link or other`.
   */
  link_idx: number;
  /**
   * The joint between that link and the part's root link.
   *
   * Index of: `joint or other`.
   */
  joint_idx: number;
}

/**
 * How a part itself was combined, as the part's own `composition_module` says. Its indices are those
 * of the part's own modules.
 */
export interface PartComposition extends Extensible {
  /**
   * The link that carries all parts and belongs to none of them; null where a part is the root.
   */
  base: CompositionBase | null;
  /**
   * The parts.
   */
  parts: CompositionPart[];
}

/**
 * How this robot was combined from others, its parts. The robot itself is defined by the URDF that the
 * URDD carries; this module says which part each of its links and joints came from.
 */
export interface CompositionModule extends Extensible {
  /**
   * The link that carries all parts and belongs to none of them; null where a part is the root.
   */
  base: CompositionBase | null;
  /**
   * The parts, in the order in which they stand in the URDF. The place in this list is the part's index.
   *
   * Length: `parts`.
   */
  parts: CompositionPart[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A configuration that a person named.
 */
export interface NamedConfiguration extends Extensible {
  /**
   * Its name; unique in the module, and not empty.
   */
  name: string;
  /**
   * The positions that the person set, in DOF order. What a person decides is free; the names must
   * exist.
   */
  positions: DofPosition[];
  /**
   * What follows: one value per DOF, rad or m. A DOF without an entry in `positions` has its value in
   * the default configuration.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  configuration: number[];
}

/**
 * The position of a DOF.
 */
export interface DofPosition extends Extensible {
  /**
   * Name of the DOF, as in `dofs` of `dof_module`.
   */
  dof_name: string;
  /**
   * Its position, rad or m.
   *
   * Unit: `rad or m`.
   */
  position: number;
}

/**
 * Configurations that a person named: `home`, `ready`, `retract`.
 */
export interface NamedConfigurationsModule extends Extensible {
  /**
   * The configurations, in the order in which the person added them.
   */
  configurations: NamedConfiguration[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A place in the URDF that names a mesh.
 */
export interface MeshReference extends Extensible {
  /**
   * The link.
   *
   * Index of: `link`.
   */
  link_idx: number;
  /**
   * Whether a visual or a collision element names it.
   */
  geometry: GeometryKind;
  /**
   * Which of the link's elements of that kind.
   *
   * Index of: `visual or collision`.
   */
  element_idx: number;
  /**
   * File name as the URDF has it.
   */
  filename: string;
  /**
   * The carried file, relative to the URDD's root; null where the mesh could not be found.
   */
  path: string | null;
}

/**
 * Which of a link's two geometries a mesh was made from.
 * - `Visual`: The `visual` elements.
 * - `Collision`: The `collision` elements.
 */
export type GeometryKind = "Visual" | "Collision";

/**
 * A carried mesh file.
 */
export interface OriginalMesh extends Extensible {
  /**
   * Path relative to the URDD's root, with forward slashes.
   */
  path: string;
  /**
   * Files that the mesh names in turn (`.mtl`, `.bin`, textures), relative to the URDD's root, sorted.
   * They lie where the mesh expects them.
   */
  side_files: string[];
  /**
   * Whether the file can be read as a mesh, and has a triangle with an area. Where not, elements that
   * name it have no surface.
   */
  usable: boolean;
}

/**
 * Every mesh that the URDF names, carried unchanged.
 */
export interface OriginalMeshesModule extends Extensible {
  /**
   * Every mesh reference of the URDF: links in order, visual before collision, elements in order.
   */
  references: MeshReference[];
  /**
   * Every carried mesh file once, sorted by path (byte order).
   */
  files: OriginalMesh[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * The mesh of a link.
 */
export interface PlainMesh extends Extensible {
  /**
   * Which geometry it was made from.
   */
  geometry: GeometryKind;
  /**
   * Its files.
   */
  files: MeshFiles;
}

/**
 * One mesh in up to three formats, the same triangles in each: vertices in metres, in the link's
 * frame, binary32. Paths are relative to the URDD's root, with forward slashes.
 */
export interface MeshFiles extends Extensible {
  /**
   * Binary STL; null where the module has none.
   */
  stl: string | null;
  /**
   * Wavefront OBJ; null where the module has none.
   */
  obj: string | null;
  /**
   * Binary glTF 2.0, no node with a transform, vertices in link axes, with the source's colours.
   */
  glb: string;
}

/**
 * One mesh per link: all its geometry of one kind, with origin, rotation and scale applied and
 * primitives tessellated.
 */
export interface PlainMeshesModule extends Extensible {
  /**
   * Which geometry is preferred; the other is used for a link that has none of it.
   */
  preferred_geometry: GeometryKind;
  /**
   * For each link its mesh, or null for a link without geometry.
   *
   * Length: `links`.
   */
  link_meshes: (PlainMesh | null)[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * The convex hull of each link's plain mesh.
 */
export interface ConvexHullMeshesModule extends Extensible {
  /**
   * For each link its hull, or null for a link without a plain mesh.
   *
   * Length: `links`.
   */
  link_hulls: (MeshFiles | null)[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * How convex pieces were made.
 */
export interface DecompositionMethod extends Extensible {
  /**
   * Name of the algorithm.
   */
  name: string;
  /**
   * How far a point of the link's surface may lie outside the pieces, metres, where the algorithm
   * promises that; else null.
   *
   * Unit: `m`.
   */
  surface_tolerance: number | null;
}

/**
 * Each link's plain mesh as a union of convex pieces.
 */
export interface ConvexDecompositionMeshesModule extends Extensible {
  /**
   * How the pieces were made. Any method may be used, as long as `surface_tolerance` holds (7.10).
   */
  method: DecompositionMethod;
  /**
   * For each link its pieces; empty for a link without a plain mesh. The place in the list is the piece
   * index.
   *
   * Length: `links`, each `pieces`.
   */
  link_pieces: MeshFiles[][];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * An oriented bounding box.
 */
export interface Obb extends Extensible {
  /**
   * Half of each side length, metres, along the box's own axes.
   *
   * Unit: `m`. Frame: `shape`.
   */
  half_extents: [number, number, number];
  /**
   * Centre in the link's frame, metres.
   *
   * Unit: `m`. Frame: `link`.
   */
  offset_xyz: [number, number, number];
  /**
   * Rotation from the box's axes to the link's: fixed-axis roll, pitch, yaw, radians.
   *
   * Unit: `rad`. Frame: `link`.
   */
  offset_rpy: [number, number, number];
}

/**
 * A bounding sphere.
 */
export interface BoundingSphere extends Extensible {
  /**
   * Radius, metres.
   *
   * Unit: `m`.
   */
  radius: number;
  /**
   * Centre in the link's frame, metres.
   *
   * Unit: `m`. Frame: `link`.
   */
  offset_xyz: [number, number, number];
}

/**
 * Oriented bounding boxes (OBBs) and bounding spheres of each link and of each convex piece, in the
 * link's frame.
 */
export interface LinkShapesApproximationsModule extends Extensible {
  /**
   * For each link, a box that holds its hull; null for a link without a mesh.
   *
   * Length: `links`.
   */
  full_obbs: (Obb | null)[];
  /**
   * For each link, a sphere that holds its hull; null for a link without a mesh.
   *
   * Length: `links`.
   */
  full_bounding_spheres: (BoundingSphere | null)[];
  /**
   * For each link, a box for each convex piece.
   *
   * Length: `links`, each `pieces`.
   */
  decomposition_obbs: Obb[][];
  /**
   * For each link, a sphere for each convex piece.
   *
   * Length: `links`, each `pieces`.
   */
  decomposition_bounding_spheres: BoundingSphere[][];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * The largest distance of any point of a shape from the origin of its link's frame, metres.
 */
export interface LinkShapesMaxDistanceFromOriginModule extends Extensible {
  /**
   * For each link, of its convex hull; null for a link without one.
   *
   * Unit: `m`. Length: `links`.
   */
  full_convex_hulls_maximum_distances: (number | null)[];
  /**
   * For each link, of its box; null for a link without one.
   *
   * Unit: `m`. Length: `links`.
   */
  full_obbs_maximum_distances: (number | null)[];
  /**
   * For each link, of its sphere; null for a link without one.
   *
   * Unit: `m`. Length: `links`.
   */
  full_bounding_spheres_maximum_distances: (number | null)[];
  /**
   * For each link, of each convex piece.
   *
   * Unit: `m`. Length: `links`, each `pieces`.
   */
  decomposition_convex_hulls_maximum_distances: number[][];
  /**
   * For each link, of the box of each convex piece.
   *
   * Unit: `m`. Length: `links`, each `pieces`.
   */
  decomposition_obbs_maximum_distances: number[][];
  /**
   * For each link, of the sphere of each convex piece.
   *
   * Unit: `m`. Length: `links`, each `pieces`.
   */
  decomposition_bounding_spheres_maximum_distances: number[][];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A convex piece of a link.
 */
export interface PieceShape extends Extensible {
  /**
   * The link.
   *
   * Index of: `link`.
   */
  link_idx: number;
  /**
   * The piece, as in `link_pieces` of `convex_decomposition_meshes_module`.
   *
   * Index of: `piece`.
   */
  piece_idx: number;
}

/**
 * Square symmetric matrices over one list of shapes, metres.
 */
export interface DistanceStatistics extends Extensible {
  /**
   * Mean distance of each pair.
   *
   * Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or
   * decomposition_shapes`.
   */
  mean_distances: number[][];
  /**
   * Smallest distance of each pair.
   *
   * Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or
   * decomposition_shapes`.
   */
  min_distances: number[][];
  /**
   * Largest distance of each pair.
   *
   * Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or
   * decomposition_shapes`.
   */
  max_distances: number[][];
}

/**
 * Mean, smallest and largest distance of each pair of shapes over the specification's sampled
 * configurations, metres. A distance is 0 where the shapes touch or overlap.
 */
export interface LinkShapesDistanceStatisticsModule extends Extensible {
  /**
   * Number of sampled configurations, from the first of the specification's sequence.
   *
   * Unit: `1`.
   */
  num_samples: number;
  /**
   * What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
   *
   * Index of: `link`. Length: `full_shapes`.
   */
  full_shapes: number[];
  /**
   * What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
   *
   * Length: `decomposition_shapes`.
   */
  decomposition_shapes: PieceShape[];
  /**
   * Between the links' convex hulls.
   */
  full_convex_hulls: DistanceStatistics;
  /**
   * Between the links' boxes.
   */
  full_obbs: DistanceStatistics;
  /**
   * Between the links' spheres.
   */
  full_bounding_spheres: DistanceStatistics;
  /**
   * Between convex pieces; null above 500 pieces, unless asked for.
   */
  decomposition_convex_hulls: DistanceStatistics | null;
  /**
   * Between the boxes of convex pieces; null above 500 pieces, unless asked for.
   */
  decomposition_obbs: DistanceStatistics | null;
  /**
   * Between the spheres of convex pieces; null above 500 pieces, unless asked for.
   */
  decomposition_bounding_spheres: DistanceStatistics | null;
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * The reason of each pair, for each kind of shape.
 */
export interface SkipReasons extends Extensible {
  /**
   * Between the links' convex hulls.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_convex_hulls: SkipReason[][];
  /**
   * Between the links' boxes.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_obbs: SkipReason[][];
  /**
   * Between the links' spheres.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_bounding_spheres: SkipReason[][];
  /**
   * Between convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_convex_hulls: SkipReason[][] | null;
  /**
   * Between the boxes of convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_obbs: SkipReason[][] | null;
  /**
   * Between the spheres of convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_bounding_spheres: SkipReason[][] | null;
}

/**
 * The reason of a pair of shapes: the first of these that applies.
 * - `SameLink`: Both shapes are on one link. A simple skip.
 * - `Always`: The largest sampled distance is at most 0.001 m: always in contact. A simple skip.
 * - `Adjacent`: A joint connects the two links. Not a simple skip.
 * - `Default`: The distance in the default configuration is at most 0.001 m: in contact when the robot
 * stands still at zero. Not a simple skip.
 * - `Never`: The smallest sampled distance is more than 0.001 m: never in contact, as far as the
 * samples show. Not a simple skip.
 * - `None`: None of these: in contact in some of the sampled configurations and not in others.
 */
export type SkipReason = "SameLink" | "Always" | "Adjacent" | "Default" | "Never" | "None";

/**
 * For each pair of shapes, whether the two are always in contact, so that checking them for collision
 * says nothing, and the reason of the pair.
 */
export interface LinkShapesSimpleSkipsModule extends Extensible {
  /**
   * What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
   *
   * Index of: `link`. Length: `full_shapes`.
   */
  full_shapes: number[];
  /**
   * What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
   *
   * Length: `decomposition_shapes`.
   */
  decomposition_shapes: PieceShape[];
  /**
   * Skips between the links' convex hulls: true where both shapes are on one link, or where the largest
   * sampled distance is at most 0.001 m.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_convex_hulls_simple_skips: boolean[][];
  /**
   * Skips between the links' boxes.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_obbs_simple_skips: boolean[][];
  /**
   * Skips between the links' spheres.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_bounding_spheres_simple_skips: boolean[][];
  /**
   * Skips between convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_convex_hulls_simple_skips: boolean[][] | null;
  /**
   * Skips between the boxes of convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_obbs_simple_skips: boolean[][] | null;
  /**
   * Skips between the spheres of convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_bounding_spheres_simple_skips: boolean[][] | null;
  /**
   * The reason of each pair, for each of the matrices above.
   */
  reasons: SkipReasons;
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A reason of `link_shapes_simple_skips_module` for which pairs can be skipped: all but `None`.
 * - `SameLink`: Both shapes are on one link.
 * - `Always`: Always in contact, as far as the samples show.
 * - `Adjacent`: A joint connects the two links.
 * - `Default`: In contact in the default configuration.
 * - `Never`: Never in contact, as far as the samples show: the number of samples is `num_samples` of
 * `link_shapes_distance_statistics_module`.
 */
export type SkippedReason = "SameLink" | "Always" | "Adjacent" | "Default" | "Never";

/**
 * A person's decision on a pair of links, for all their shapes of every kind.
 */
export interface SkipEdit extends Extensible {
  /**
   * Name of one link.
   */
  link_a: string;
  /**
   * Name of the other link; may be the same.
   */
  link_b: string;
  /**
   * Whether checks between the two are skipped.
   */
  skip: boolean;
  /**
   * Why.
   */
  reason: string;
}

/**
 * The pairs of shapes that a collision check skips: those with one of the skipped reasons, and then a
 * person's edits, applied in order.
 */
export interface LinkShapesSkipsModule extends Extensible {
  /**
   * The reasons of `link_shapes_simple_skips_module` for which a pair is skipped, each once, in the
   * order of the specification.
   */
  skipped_reasons: SkippedReason[];
  /**
   * The edits, applied in order. What a person decides is free; the names must exist.
   */
  edits: SkipEdit[];
  /**
   * What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
   *
   * Index of: `link`. Length: `full_shapes`.
   */
  full_shapes: number[];
  /**
   * What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
   *
   * Length: `decomposition_shapes`.
   */
  decomposition_shapes: PieceShape[];
  /**
   * Skips between the links' convex hulls.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_convex_hulls_skips: boolean[][];
  /**
   * Skips between the links' boxes.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_obbs_skips: boolean[][];
  /**
   * Skips between the links' spheres.
   *
   * Length: `full_shapes`, each `full_shapes`.
   */
  full_bounding_spheres_skips: boolean[][];
  /**
   * Skips between convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_convex_hulls_skips: boolean[][] | null;
  /**
   * Skips between the boxes of convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_obbs_skips: boolean[][] | null;
  /**
   * Skips between the spheres of convex pieces; null where the statistics are.
   *
   * Length: `decomposition_shapes`, each `decomposition_shapes`.
   */
  decomposition_bounding_spheres_skips: boolean[][] | null;
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * Something that the network is told of a configuration.
 */
export type ModelInput = AngleModelInput | LengthModelInput | RotationVectorModelInput;

/**
 * An angle.
 */
export interface AngleInput extends Extensible {
  /**
   * The DOF, which is an angle.
   *
   * Index of: `dof`.
   */
  dof_idx: number;
}

/**
 * Four numbers of an angle q: sin q, cos q, sin 2q, cos 2q.
 */
export interface AngleModelInput extends Extensible {
  Angle: AngleInput;
}

/**
 * A length.
 */
export interface LengthInput extends Extensible {
  /**
   * The DOF, which is a length.
   *
   * Index of: `dof`.
   */
  dof_idx: number;
  /**
   * What becomes 0, metres.
   *
   * Unit: `m`.
   */
  middle: number;
  /**
   * How far from that is 1, metres; positive.
   *
   * Unit: `m`.
   */
  half_range: number;
}

/**
 * One number of a length q: (q - middle) / half_range.
 */
export interface LengthModelInput extends Extensible {
  Length: LengthInput;
}

/**
 * A rotation vector.
 */
export interface RotationVectorInput extends Extensible {
  /**
   * Its three DOFs.
   *
   * Index of: `dof`.
   */
  dof_idxs: [number, number, number];
}

/**
 * Nine numbers of a rotation vector: its rotation matrix, row by row.
 */
export interface RotationVectorModelInput extends Extensible {
  RotationVector: RotationVectorInput;
}

/**
 * A layer of a network: its values are `weights` times the values before, plus `biases`.
 */
export interface ModelLayer extends Extensible {
  /**
   * One row for each value of the layer, with one number for each value before it.
   *
   * Unit: `1 or m`.
   */
  weights: number[][];
  /**
   * One number for each value of the layer.
   *
   * Unit: `1 or m`.
   */
  biases: number[];
}

/**
 * A pair of links that the network has an output for.
 */
export interface ModelPair extends Extensible {
  /**
   * One link.
   *
   * Index of: `link`.
   */
  link_a_idx: number;
  /**
   * The other, of a higher index.
   *
   * Index of: `link`.
   */
  link_b_idx: number;
  /**
   * The clearance of the pair is the network's output less this, metres. A clearance of 0 or less means
   * that the pair may be in contact.
   *
   * Unit: `m`.
   */
  margin: number;
}

/**
 * A pair of links.
 */
export interface LinkPair extends Extensible {
  /**
   * One link.
   *
   * Index of: `link`.
   */
  link_a_idx: number;
  /**
   * The other, of a higher index.
   *
   * Index of: `link`.
   */
  link_b_idx: number;
}

/**
 * Sampled configurations (SPEC 9.3) that follow each other.
 */
export interface SampleRange extends Extensible {
  /**
   * The first.
   *
   * Index of: `sample`.
   */
  first_sample_idx: number;
  /**
   * How many.
   *
   * Unit: `1`.
   */
  num_configurations: number;
}

/**
 * How often the model is right on the sampled configurations 2^31 to 2^31 + 49,999, which have no part
 * in making any model. A configuration is in collision where a pair of links in `pairs` or
 * `other_pairs` is in contact, and free otherwise. The model clears a configuration where every
 * clearance is above 0.
 */
export interface ModelEvaluation extends Extensible {
  /**
   * Number of configurations in collision.
   *
   * Unit: `1`.
   */
  num_colliding: number;
  /**
   * Number of these that the model clears: the misses.
   *
   * Unit: `1`.
   */
  num_missed: number;
  /**
   * Number of configurations in collision that are near contact: a step of at most 0.05 rad or 0.05 m in
   * each DOF makes them free (SPEC 8.8.10).
   *
   * Unit: `1`.
   */
  num_near_contact: number;
  /**
   * Number of these that the model clears.
   *
   * Unit: `1`.
   */
  num_near_contact_missed: number;
  /**
   * Number of free configurations.
   *
   * Unit: `1`.
   */
  num_free: number;
  /**
   * Number of these that the model clears.
   *
   * Unit: `1`.
   */
  num_cleared: number;
}

/**
 * What the model gives in a configuration.
 */
export interface ModelTestVector extends Extensible {
  /**
   * One value for each DOF, rad or m.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  configuration: number[];
  /**
   * One clearance for each entry of `pairs`, metres.
   *
   * Unit: `m`. Length: `pairs`.
   */
  clearances: number[];
}

/**
 * A network that estimates, for a configuration, how near pairs of links are to each other. It is for
 * passing over configurations that are far from any contact. It is an estimate, not a guarantee:
 * `evaluation` says how often it is wrong.
 */
export interface SelfCollisionModelModule extends Extensible {
  /**
   * Of the shapes and the kinematics that it was trained on: SHA-256 of the text that SPEC 8.8.7
   * defines.
   */
  trained_on: string;
  /**
   * Distances from here on were all the same to it, metres.
   *
   * Unit: `m`.
   */
  clip_distance: number;
  /**
   * What the network is told of a configuration, in the order of its first layer's columns.
   */
  inputs: ModelInput[];
  /**
   * The layers of the network, the first one first. After each but the last, every value is replaced by
   * its hyperbolic tangent.
   */
  layers: ModelLayer[];
  /**
   * The pairs of links that the network has an output for, in that order.
   *
   * Length: `pairs`.
   */
  pairs: ModelPair[];
  /**
   * The pairs of links that are not skipped and have no output: they were never near in training.
   */
  other_pairs: LinkPair[];
  /**
   * The sampled configurations (SPEC 9.3) that it was trained on.
   */
  training: SampleRange;
  /**
   * The sampled configurations that decided when training ended and what the margins are.
   */
  calibration: SampleRange;
  /**
   * How often it is right on the sampled configurations that SPEC 8.8.9 fixes.
   */
  evaluation: ModelEvaluation;
  /**
   * What it gives in some configurations.
   */
  test_vectors: ModelTestVector[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * A level: spheres of each link, and what they say.
 */
export interface SphereLevel extends Extensible {
  /**
   * Where the spheres are from.
   */
  origin: SphereOrigin;
  /**
   * Whether every point of every piece is in a sphere of its link. Such a level never calls a collision
   * free.
   */
  covers: boolean;
  /**
   * The level before this one whose spheres hold the spheres of this one; null for the first level.
   *
   * Index of: `other`.
   */
  outer_level_idx: number | null;
  /**
   * For each link, its spheres; none for a link without a piece.
   *
   * Length: `links`.
   */
  spheres: LinkSphere[][];
  /**
   * For each link, how far its spheres are from its pieces; null for a link without spheres.
   *
   * Length: `links`.
   */
  fits: (SphereFit | null)[];
  /**
   * Pairs of links that a check by this level leaves out, besides the skipped ones (SPEC 8.8.5): they
   * were in no sampled collision, and their spheres touch all the same. None for a level that covers.
   */
  ignored_pairs: LinkPair[];
  /**
   * Pairs of links with a sphere of each in contact in every sampled configuration.
   */
  always_pairs: LinkPair[];
  /**
   * Pairs of links with a sphere of each in contact in some of the sampled configurations, and not in
   * all. All other pairs are in contact in none.
   */
  sometimes_pairs: LinkPair[];
  /**
   * How often a check by this level is right in the sampled configurations.
   */
  evaluation: SphereEvaluation;
}

/**
 * Where the spheres of a level are from.
 * - `Computed`: A program made them from the pieces.
 * - `Given`: A person gave them. A producer that makes the module again keeps them.
 */
export type SphereOrigin = "Computed" | "Given";

/**
 * A sphere of a link.
 */
export interface LinkSphere extends Extensible {
  /**
   * Radius, metres.
   *
   * Unit: `m`.
   */
  radius: number;
  /**
   * Centre in the link's frame, metres.
   *
   * Unit: `m`. Frame: `link`.
   */
  offset_xyz: [number, number, number];
  /**
   * The sphere of the same link in the outer level that this one is inside of; null in the first level.
   *
   * Index of: `other`.
   */
  outer_sphere_idx: number | null;
}

/**
 * How far the spheres of a link are from its pieces, by the points of SPEC 8.9.5.
 */
export interface SphereFit extends Extensible {
  /**
   * The largest distance of a point on the spheres from the pieces, metres.
   *
   * Unit: `m`.
   */
  max_standoff: number;
  /**
   * The mean distance of points on the spheres from the pieces, metres.
   *
   * Unit: `m`.
   */
  mean_standoff: number;
  /**
   * The part of the surface of the pieces that is outside of all spheres, from 0 to 1.
   *
   * Unit: `1`.
   */
  uncovered_fraction: number;
  /**
   * The largest distance of a point of that surface from the spheres, metres; 0 where all of it is in
   * spheres.
   *
   * Unit: `m`.
   */
  max_uncovered: number;
}

/**
 * How often a check by a level is right. A configuration is in collision where two pieces are in
 * contact whose links are not skipped, and free otherwise; the level touches where spheres are in
 * contact of two links that are neither skipped nor ignored.
 */
export interface SphereEvaluation extends Extensible {
  /**
   * Number of configurations in collision.
   *
   * Unit: `1`.
   */
  num_colliding: number;
  /**
   * Number of these in which the level does not touch.
   *
   * Unit: `1`.
   */
  num_missed: number;
  /**
   * Number of free configurations.
   *
   * Unit: `1`.
   */
  num_free: number;
  /**
   * Number of these in which the level touches.
   *
   * Unit: `1`.
   */
  num_false_contacts: number;
}

/**
 * Spheres that stand for the convex pieces of links, for programs that check very many configurations.
 */
export interface LinkShapesSpheresModule extends Extensible {
  /**
   * The levels, from coarse to fine. The first has one sphere for each link with a piece.
   */
  levels: SphereLevel[];
  /**
   * How many sampled configurations (SPEC 9.3), from 2^31 on, pairs and counts of the levels are of.
   *
   * Unit: `1`.
   */
  num_samples: number;
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/**
 * What holds two links together besides the joints of the tree.
 */
export interface Loop extends Extensible {
  /**
   * Its name; unique among loops and couplings.
   */
  name: string;
  /**
   * Which numbers of the pose of frame B in frame A are held.
   */
  kind: LoopKind;
  /**
   * The link that frame A is fixed to.
   *
   * Index of: `link`.
   */
  link_a_idx: number;
  /**
   * Frame A, in that link's frame.
   *
   * Frame: `link`.
   */
  frame_a: Pose;
  /**
   * The link that frame B is fixed to: another one.
   *
   * Index of: `link`.
   */
  link_b_idx: number;
  /**
   * Frame B, in that link's frame.
   *
   * Frame: `link`.
   */
  frame_b: Pose;
  /**
   * How far the held position may be off where the loop counts as closed, m: the precision of the
   * source. Not negative.
   *
   * Unit: `m`.
   */
  position_tolerance: number;
  /**
   * How far the held rotation may be off there, rad. Not negative.
   *
   * Unit: `rad`.
   */
  rotation_tolerance: number;
}

/**
 * What a loop holds. The axes are those of its frames: z is the axis of a hinge, slide or plane.
 * - `Fixed`: Position and rotation: a weld.
 * - `Revolute`: The position, and the direction of z: a hinge about z.
 * - `Prismatic`: The position along x and y, and the rotation: a slide along z.
 * - `Cylindrical`: The position along x and y, and the direction of z: a hinge about z that slides
 * along it.
 * - `Universal`: The position, and the right angle between z of both frames: a universal joint.
 * - `Spherical`: The position: a ball.
 * - `Planar`: The position along z, and the direction of z: frame B moves in the x-y plane of frame A.
 */
export type LoopKind = "Fixed" | "Revolute" | "Prismatic" | "Cylindrical" | "Universal" | "Spherical" | "Planar";

/**
 * An equation between DOFs: the constant and all terms add up to 0.
 */
export interface Coupling extends Extensible {
  /**
   * Its name; unique among loops and couplings.
   */
  name: string;
  /**
   * The constant.
   *
   * Unit: `rad or m`.
   */
  constant: number;
  /**
   * One term for each DOF, in DOF order.
   */
  terms: CouplingTerm[];
}

/**
 * What a DOF adds to the sum of a coupling: c1 q + c2 q^2 + c3 q^3 + c4 q^4.
 */
export interface CouplingTerm extends Extensible {
  /**
   * The DOF.
   *
   * Index of: `dof`.
   */
  dof_idx: number;
  /**
   * c1, c2, c3 and c4.
   *
   * Unit: `1 or rad/m or m/rad or 1/rad or 1/m or rad/m^2 or m/rad^2 or 1/rad^2 or 1/m^2 or rad/m^3 or
   * m/rad^3 or 1/rad^3 or 1/m^3 or rad/m^4 or m/rad^4`.
   */
  coefficients: [number, number, number, number];
}

/**
 * A closed configuration whose independent DOFs have the values of a sampled configuration.
 */
export interface ClosedSample extends Extensible {
  /**
   * The number of the sampled configuration.
   *
   * Index of: `sample`.
   */
  sample_idx: number;
  /**
   * One value per DOF, rad or m; null where none was found that is closed.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  configuration: number[] | null;
}

/**
 * What closes the kinematic loops of a robot, and couplings between its DOFs. The links and joints of
 * the other modules are its spanning tree.
 */
export interface LoopsModule extends Extensible {
  /**
   * The loops.
   */
  loops: Loop[];
  /**
   * Equations between DOFs, such as gears between joints of different branches.
   */
  couplings: Coupling[];
  /**
   * The DOFs that move freely, ascending; the others follow from them. Their number is the mobility at
   * the reference configuration.
   *
   * Index of: `dof`.
   */
  independent_dof_idxs: number[];
  /**
   * A configuration in which all loops are closed and all couplings hold: one value per DOF, rad or m.
   *
   * Unit: `rad or m`. Length: `dofs`.
   */
  reference_configuration: number[];
  /**
   * Sampled configurations that are closed, numbered from 0 without gaps.
   */
  closed_samples: ClosedSample[];
  /**
   * The JSON Schema that this document follows, for editors.
   */
  $schema?: string;
}

/** The documents by the names of their modules. */
export interface Documents {
  "urdd.json": RootMetadata;
  urdf_module: UrdfModule;
  dof_module: DofModule;
  chain_module: ChainModule;
  connections_module: ConnectionsModule;
  bounds_module: BoundsModule;
  kinematics_samples_module: KinematicsSamplesModule;
  composition_module: CompositionModule;
  named_configurations_module: NamedConfigurationsModule;
  original_meshes_module: OriginalMeshesModule;
  plain_meshes_module: PlainMeshesModule;
  convex_hull_meshes_module: ConvexHullMeshesModule;
  convex_decomposition_meshes_module: ConvexDecompositionMeshesModule;
  link_shapes_approximations_module: LinkShapesApproximationsModule;
  link_shapes_max_distance_from_origin_module: LinkShapesMaxDistanceFromOriginModule;
  link_shapes_distance_statistics_module: LinkShapesDistanceStatisticsModule;
  link_shapes_simple_skips_module: LinkShapesSimpleSkipsModule;
  link_shapes_skips_module: LinkShapesSkipsModule;
  self_collision_model_module: SelfCollisionModelModule;
  link_shapes_spheres_module: LinkShapesSpheresModule;
  loops_module: LoopsModule;
}
