"""The modules of version 1, as dataclasses: every field with its meaning, shape, unit and frame.

Written by `python/scripts/make_types.py` from `schema/`. Do not edit.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from ._reading import Reading

__all__ = [
    "AngleInput",
    "Axis",
    "BoundingSphere",
    "BoundsModule",
    "Calibration",
    "Capsule",
    "ChainModule",
    "ClosedSample",
    "Collision",
    "Color",
    "CompositionBase",
    "CompositionModule",
    "CompositionPart",
    "ConfigurationKind",
    "ConformanceClass",
    "ConnectionsModule",
    "ConvexDecompositionMeshesModule",
    "ConvexHullMeshesModule",
    "Coupling",
    "CouplingTerm",
    "Cuboid",
    "Cylinder",
    "DecompositionMethod",
    "DistanceStatistics",
    "Dof",
    "DofModule",
    "DofPosition",
    "Dynamics",
    "FileEntry",
    "FrozenJoint",
    "Generator",
    "Geometry",
    "GeometryKind",
    "Inertia",
    "Inertial",
    "Joint",
    "JointInChain",
    "JointType",
    "KinematicsSample",
    "KinematicsSamplesModule",
    "LengthInput",
    "Limit",
    "Link",
    "LinkInChain",
    "LinkName",
    "LinkPair",
    "LinkPath",
    "LinkShapesApproximationsModule",
    "LinkShapesDistanceStatisticsModule",
    "LinkShapesMaxDistanceFromOriginModule",
    "LinkShapesSimpleSkipsModule",
    "LinkShapesSkipsModule",
    "LinkShapesSpheresModule",
    "LinkSphere",
    "Loop",
    "LoopKind",
    "LoopsModule",
    "Mass",
    "Material",
    "Mesh",
    "MeshFiles",
    "MeshReference",
    "Mimic",
    "ModelEvaluation",
    "ModelInput",
    "ModelLayer",
    "ModelPair",
    "ModelTestVector",
    "ModuleEntry",
    "Modules",
    "NamedConfiguration",
    "NamedConfigurationsModule",
    "Obb",
    "Origin",
    "OriginalMesh",
    "OriginalMeshesModule",
    "PartAttachment",
    "PartComposition",
    "PartJoint",
    "PartLink",
    "PartSource",
    "PieceShape",
    "PlainMesh",
    "PlainMeshesModule",
    "Pose",
    "Quantity",
    "ResolvedMimic",
    "RootMetadata",
    "RotationVectorInput",
    "SafetyController",
    "SampleRange",
    "SelfCollisionModelModule",
    "SkipEdit",
    "SkipReason",
    "SkipReasons",
    "SkippedReason",
    "Source",
    "Sphere",
    "SphereEvaluation",
    "SphereFit",
    "SphereLevel",
    "SphereOrigin",
    "Texture",
    "UrdfModule",
    "Visual",
    "read_root_metadata",
]

ConformanceClass: TypeAlias = Literal["Core", "Geometry", "Shapes"]
"""How much of the specification a URDD carries and fulfils; each class holds those before it.
- `Core`: Kinematics: urdf, dof, chain, connections, bounds (and kinematics samples, recommended).
- `Geometry`: Core, and the four mesh modules.
- `Shapes`: Geometry, and the link shape modules.
"""

JointType: TypeAlias = Literal["Revolute", "Continuous", "Prismatic", "Fixed", "Floating", "Planar", "Spherical"]
"""How a joint moves.
- `Revolute`: Turns about its axis, within limits. One DOF, rad.
- `Continuous`: Turns about its axis, without limits. One DOF, rad.
- `Prismatic`: Slides along its axis. One DOF, m.
- `Fixed`: Does not move. No DOF.
- `Floating`: Moves freely. Six DOFs: x, y, z (m), then a rotation vector (rad).
- `Planar`: Slides in the plane normal to its axis and turns about it. Three DOFs: x, y (m), angle (rad).
- `Spherical`: Turns freely. Three DOFs: a rotation vector (rad). Not in URDF's own list; accepted by many
  readers.
"""

Quantity: TypeAlias = Literal["Angle", "Length"]
"""What a DOF measures.
- `Angle`: An angle, or a component of a rotation vector: radians.
- `Length`: A length: metres.
"""

ConfigurationKind: TypeAlias = Literal["Zero", "Middle", "Lower", "Upper", "Sampled"]
"""A configuration that the specification defines.
- `Zero`: Every DOF 0, even where 0 is out of bounds.
- `Middle`: Every DOF half-way between its bounds; a rotation vector 0.
- `Lower`: Every DOF at its lower bound; a rotation vector (-pi, 0, 0).
- `Upper`: Every DOF at its upper bound; a rotation vector (pi, 0, 0).
- `Sampled`: Number `sample_idx` of the sequence of sampled configurations.
"""

GeometryKind: TypeAlias = Literal["Visual", "Collision"]
"""Which of a link's two geometries a mesh was made from.
- `Visual`: The `visual` elements.
- `Collision`: The `collision` elements.
"""

SkipReason: TypeAlias = Literal["SameLink", "Always", "Adjacent", "Default", "Never", "None"]
"""The reason of a pair of shapes: the first of these that applies.
- `SameLink`: Both shapes are on one link. A simple skip.
- `Always`: The largest sampled distance is at most 0.001 m: always in contact. A simple skip.
- `Adjacent`: A joint connects the two links. Not a simple skip.
- `Default`: The distance in the default configuration is at most 0.001 m: in contact when the robot stands still
  at zero. Not a simple skip.
- `Never`: The smallest sampled distance is more than 0.001 m: never in contact, as far as the samples show. Not
  a simple skip.
- `None`: None of these: in contact in some of the sampled configurations and not in others.
"""

SkippedReason: TypeAlias = Literal["SameLink", "Always", "Adjacent", "Default", "Never"]
"""A reason of `link_shapes_simple_skips_module` for which pairs can be skipped: all but `None`.
- `SameLink`: Both shapes are on one link.
- `Always`: Always in contact, as far as the samples show.
- `Adjacent`: A joint connects the two links.
- `Default`: In contact in the default configuration.
- `Never`: Never in contact, as far as the samples show: the number of samples is `num_samples` of
  `link_shapes_distance_statistics_module`.
"""

SphereOrigin: TypeAlias = Literal["Computed", "Given"]
"""Where the spheres of a level are from.
- `Computed`: A program made them from the pieces.
- `Given`: A person gave them. A producer that makes the module again keeps them.
"""

LoopKind: TypeAlias = Literal["Fixed", "Revolute", "Prismatic", "Cylindrical", "Universal", "Spherical", "Planar"]
"""What a loop holds. The axes are those of its frames: z is the axis of a hinge, slide or plane.
- `Fixed`: Position and rotation: a weld.
- `Revolute`: The position, and the direction of z: a hinge about z.
- `Prismatic`: The position along x and y, and the rotation: a slide along z.
- `Cylindrical`: The position along x and y, and the direction of z: a hinge about z that slides along it.
- `Universal`: The position, and the right angle between z of both frames: a universal joint.
- `Spherical`: The position: a ball.
- `Planar`: The position along z, and the direction of z: frame B moves in the x-y plane of frame A.
"""


@dataclass(frozen=True)
class Generator:
    """The program that wrote a URDD."""

    name: str
    """Name of the program."""

    version: str
    """Its version, in its own numbering."""


@dataclass(frozen=True)
class FileEntry:
    """A file of the directory, with what is needed to see that it is unchanged."""

    path: str
    """Path relative to the URDD's root, with forward slashes."""

    size: int
    """Size in bytes.

    Unit: `byte`.
    """

    sha256: str
    """SHA-256 of the bytes."""


@dataclass(frozen=True)
class ModuleEntry:
    """One module of the directory."""

    name: str
    """Name of the module, such as `dof_module`: the last part of its path."""

    version: str
    """Version of the module's format; equal to the module's `VERSION` file."""

    path: str
    """Folder of the module, relative to the URDD's root, with forward slashes."""

    depends_on: list[str]
    """Names of the modules that this one was derived from."""

    files: list[FileEntry]
    """Every file of the module, sorted by path (byte order)."""


@dataclass(frozen=True)
class RootMetadata:
    """Root metadata of a URDD (`urdd.json`): names the robot, the specification's version, the source, and every
    module with its files."""

    urdd_version: str
    """Version of the URDD specification that this directory follows."""

    robot_name: str
    """Name of the robot; equal to `name` of `urdf_module`."""

    conformance_class: ConformanceClass
    """The conformance class that the directory claims to fulfil."""

    generator: Generator | None
    """The program that wrote the directory; null when written by hand. Free: not checked."""

    source: Source | None
    """What the directory was made from; null when from nothing that can be named."""

    modules: list[ModuleEntry]
    """Every module, in the order of the specification's table of modules, extensions last."""


@dataclass(frozen=True)
class Link:
    """A link: a rigid body."""

    name: str
    """Name, unique among the links."""

    inertial: Inertial | None
    """Mass, centre of mass and inertia."""

    visual: list[Visual]
    """Visual elements in the order of the file."""

    collision: list[Collision]
    """Collision elements in the order of the file."""

    unknown_elements: list[str]
    """Other elements directly under `<link>`, each as its own XML text."""


@dataclass(frozen=True)
class Inertial:
    """Mass properties of a link."""

    origin: Origin | None
    """Centre of mass, and the axes of `inertia`, in the link's frame.

    Frame: `link`.
    """

    mass: Mass | None
    """Mass."""

    inertia: Inertia | None
    """Inertia tensor about the centre of mass, in the axes of `origin`.

    Frame: `inertial`.
    """


@dataclass(frozen=True)
class Origin:
    """A pose as the URDF writes it."""

    xyz: list[float] | None
    """Position, metres: x, y, z.

    Unit: `m`.
    """

    rpy: list[float] | None
    """Fixed-axis roll, pitch, yaw, radians: turn about x, then y, then z of the outer frame.

    Unit: `rad`.
    """

    quat_xyzw: list[float] | None
    """Rotation as a quaternion x, y, z, w of any length but zero, instead of `rpy`. It counts from URDF version 1.1
    on; before, it has no meaning.

    Unit: `1`.
    """


@dataclass(frozen=True)
class Mass:
    """Mass of a link."""

    value: float
    """Kilograms.

    Unit: `kg`.
    """


@dataclass(frozen=True)
class Inertia:
    """The six independent elements of a symmetric inertia tensor, kg m²."""

    ixx: float | None
    """Element xx.

    Unit: `kg*m^2`.
    """

    ixy: float | None
    """Element xy.

    Unit: `kg*m^2`.
    """

    ixz: float | None
    """Element xz.

    Unit: `kg*m^2`.
    """

    iyy: float | None
    """Element yy.

    Unit: `kg*m^2`.
    """

    iyz: float | None
    """Element yz.

    Unit: `kg*m^2`.
    """

    izz: float | None
    """Element zz.

    Unit: `kg*m^2`.
    """


@dataclass(frozen=True)
class Visual:
    """What a link looks like, or a part of it."""

    name: str | None
    """Name of the element."""

    origin: Origin | None
    """Pose of the geometry in the link's frame.

    Frame: `link`.
    """

    geometry: Geometry | None
    """Its shape.

    Frame: `shape`.
    """

    material: Material | None
    """Its material."""


@dataclass(frozen=True)
class Mesh:
    """A mesh file."""

    filename: str
    """File name as the URDF has it (`package://…`, `file://…`, relative or absolute)."""

    scale: list[float] | None
    """Factors along x, y, z; null means 1, 1, 1.

    Unit: `1`.
    """


@dataclass(frozen=True)
class Cuboid:
    """A box about the origin."""

    size: list[float]
    """Full side lengths along x, y, z, metres.

    Unit: `m`.
    """


@dataclass(frozen=True)
class Cylinder:
    """A cylinder about the origin, along z."""

    radius: float
    """Radius, metres.

    Unit: `m`.
    """

    length: float
    """Full length, metres.

    Unit: `m`.
    """


@dataclass(frozen=True)
class Capsule:
    """A capsule about the origin, along z: a cylinder with half a sphere on each end."""

    radius: float
    """Radius, metres.

    Unit: `m`.
    """

    length: float
    """Length of the cylinder without the half spheres, metres.

    Unit: `m`.
    """


@dataclass(frozen=True)
class Sphere:
    """A sphere about the origin."""

    radius: float
    """Radius, metres.

    Unit: `m`.
    """


@dataclass(frozen=True)
class Material:
    """A material, or a reference to one by its name."""

    name: str | None
    """Name."""

    color: Color | None
    """Colour."""

    texture: Texture | None
    """Texture."""


@dataclass(frozen=True)
class Color:
    """A colour."""

    rgba: list[float]
    """Red, green, blue, opacity, each from 0 to 1.

    Unit: `1`.
    """


@dataclass(frozen=True)
class Texture:
    """A texture."""

    filename: str
    """File name as the URDF has it."""


@dataclass(frozen=True)
class Collision:
    """What a link collides with, or a part of it."""

    name: str | None
    """Name of the element."""

    origin: Origin | None
    """Pose of the geometry in the link's frame.

    Frame: `link`.
    """

    geometry: Geometry | None
    """Its shape.

    Frame: `shape`.
    """


@dataclass(frozen=True)
class Joint:
    """A joint: how one link moves on another."""

    name: str
    """Name, unique among the joints."""

    joint_type: JointType
    """How it moves."""

    origin: Origin | None
    """Pose of the joint's frame (which is the child link's frame at zero) in the parent link's frame.

    Frame: `parent_link`.
    """

    parent: LinkName
    """The link that carries the joint."""

    child: LinkName
    """The link that the joint moves."""

    axis: Axis | None
    """Axis in the joint's frame, as written: not normalised. Null means (1, 0, 0).

    Frame: `joint`.
    """

    limit: Limit | None
    """Limits."""

    dynamics: Dynamics | None
    """Damping and friction."""

    mimic: Mimic | None
    """The joint that this one follows."""

    safety_controller: SafetyController | None
    """Soft limits."""

    calibration: Calibration | None
    """Reference positions."""

    unknown_elements: list[str]
    """Other elements directly under `<joint>`, each as its own XML text."""


@dataclass(frozen=True)
class LinkName:
    """A link, by name."""

    link: str
    """Name of the link."""


@dataclass(frozen=True)
class Axis:
    """The axis of a joint."""

    xyz: list[float] | None
    """Direction in the joint's frame, of any length but zero.

    Unit: `1`.
    """


@dataclass(frozen=True)
class Limit:
    """Limits of a joint: rad, rad/s, N m for turning joints; m, m/s, N for sliding ones."""

    lower: float | None
    """Smallest position.

    Unit: `rad or m`.
    """

    upper: float | None
    """Largest position.

    Unit: `rad or m`.
    """

    effort: float | None
    """Largest effort.

    Unit: `N*m or N`.
    """

    velocity: float | None
    """Largest speed.

    Unit: `rad/s or m/s`.
    """

    acceleration: float | None
    """Largest acceleration, rad/s² or m/s². This and the next two: from URDF version 1.2 on.

    Unit: `rad/s^2 or m/s^2`.
    """

    deceleration: float | None
    """Largest deceleration, rad/s² or m/s²; where it is absent, that of `acceleration`.

    Unit: `rad/s^2 or m/s^2`.
    """

    jerk: float | None
    """Largest rate of change of acceleration, rad/s³ or m/s³.

    Unit: `rad/s^3 or m/s^3`.
    """


@dataclass(frozen=True)
class Dynamics:
    """Dynamics of a joint."""

    damping: float | None
    """Damping: N m s/rad, or N s/m.

    Unit: `N*m*s/rad or N*s/m`.
    """

    friction: float | None
    """Static friction: N m, or N.

    Unit: `N*m or N`.
    """


@dataclass(frozen=True)
class Mimic:
    """Follows another joint: `position = multiplier * position of joint + offset`."""

    joint: str
    """Name of the joint that is followed."""

    multiplier: float | None
    """Factor; null means 1.

    Unit: `1 or rad/m or m/rad`.
    """

    offset: float | None
    """Offset, rad or m; null means 0.

    Unit: `rad or m`.
    """


@dataclass(frozen=True)
class SafetyController:
    """Soft limits of a joint."""

    soft_lower_limit: float | None
    """Where the controller begins to limit the position, below.

    Unit: `rad or m`.
    """

    soft_upper_limit: float | None
    """Where the controller begins to limit the position, above.

    Unit: `rad or m`.
    """

    k_position: float | None
    """Relation between position and velocity limits.

    Unit: `1/s`.
    """

    k_velocity: float | None
    """Relation between effort and velocity limits.

    Unit: `N*m*s/rad or N*s/m`.
    """


@dataclass(frozen=True)
class Calibration:
    """Reference positions of a joint."""

    rising: float | None
    """Position at which a rising edge is seen.

    Unit: `rad or m`.
    """

    falling: float | None
    """Position at which a falling edge is seen.

    Unit: `rad or m`.
    """


@dataclass(frozen=True)
class UrdfModule:
    """The source URDF as data. What the URDF leaves out is null (or an empty list), never a default. Lengths are
    metres, angles radians, masses kilograms; rotations are the URDF's own fixed-axis roll, pitch, yaw. Numbers
    that are not finite in the URDF are written as null."""

    name: str
    """Name of the robot (`<robot name>`)."""

    version: str | None
    """The URDF format version that the file states (`<robot version>`)."""

    links: list[Link]
    """Links in the order of the file. The place in this list is the link index.

    Length: `links`.
    """

    joints: list[Joint]
    """Joints in the order of the file. The place in this list is the joint index.

    Length: `joints`.
    """

    materials: list[Material]
    """Materials declared at the top of the file, in its order."""

    unknown_elements: list[str]
    """Other elements directly under `<robot>` (transmission, gazebo, ros2_control, …), each as its own XML text, in
    the order of the file."""


@dataclass(frozen=True)
class ResolvedMimic:
    """What a mimic joint's position is: `multiplier * q[dof_idx] + offset`."""

    dof_idx: int | None
    """The DOF that drives the joint; null where the chain of mimics ends in a fixed joint, and the position is
    `offset` at all times.

    Index of: `dof`.
    """

    multiplier: float
    """Factor: the product of the factors along the chain of mimics.

    Unit: `1 or rad/m or m/rad`.
    """

    offset: float
    """Offset, rad or m, accumulated along the chain of mimics.

    Unit: `rad or m`.
    """


@dataclass(frozen=True)
class Dof:
    """A degree of freedom."""

    name: str
    """Name: the joint's name where the joint has one DOF; else that name, a slash, and `trans_x`, `trans_y`,
    `trans_z`, `rot_x`, `rot_y`, `rot_z` or (planar) `rot`."""

    joint_idx: int
    """The joint that it moves.

    Index of: `joint`.
    """

    joint_name: str
    """Name of that joint."""

    quantity: Quantity
    """What it measures."""


@dataclass(frozen=True)
class DofModule:
    """The robot's degrees of freedom (DOFs), in joint order, and the position of every joint as a function of them."""

    num_dofs: int
    """Number of DOFs: the length of a configuration vector.

    Unit: `1`.
    """

    dof_idx_to_joint_idx_mapping: list[int]
    """For each DOF, its joint.

    Index of: `joint`. Length: `dofs`.
    """

    joint_idx_to_dof_idxs_mapping: list[list[int]]
    """For each joint, its DOFs, ascending; empty for fixed and for mimic joints.

    Index of: `dof`. Length: `joints`.
    """

    joint_idx_to_mimic_mapping: list[ResolvedMimic | None]
    """For each joint, how it follows a DOF if it is a mimic joint, else null. Chains of mimics are resolved.

    Length: `joints`.
    """

    dofs: list[Dof]
    """What each DOF is.

    Length: `dofs`.
    """


@dataclass(frozen=True)
class LinkInChain:
    """A link, with its neighbours."""

    name: str
    """Name of the link."""

    link_idx: int
    """Its own index: its place in this list.

    Index of: `link`.
    """

    parent_joint_idx: int | None
    """The joint that moves it; null for the root.

    Index of: `joint`.
    """

    parent_link_idx: int | None
    """The link that this joint sits on; null for the root.

    Index of: `link`.
    """

    children_joint_idxs: list[int]
    """The joints that sit on this link, ascending.

    Index of: `joint`.
    """

    children_link_idxs: list[int]
    """The links that these joints move, ascending.

    Index of: `link`.
    """


@dataclass(frozen=True)
class JointInChain:
    """A joint, with its two links and its motion."""

    joint_name: str
    """Name of the joint."""

    joint_idx: int
    """Its own index: its place in this list.

    Index of: `joint`.
    """

    parent_link_name: str
    """Name of the link that carries it."""

    parent_link_idx: int
    """That link.

    Index of: `link`.
    """

    child_link_name: str
    """Name of the link that it moves."""

    child_link_idx: int
    """That link.

    Index of: `link`.
    """

    joint_type: JointType
    """How it moves."""

    origin: Pose
    """Pose of the joint's frame in the parent link's frame. At the zero position the child link's frame is the
    joint's frame.

    Frame: `parent_link`.
    """

    axis: list[float] | None
    """Unit axis in the joint's frame; for a planar joint the plane's normal. Null for fixed, floating and spherical
    joints, which have none.

    Unit: `1`. Frame: `joint`.
    """


@dataclass(frozen=True)
class Pose:
    """A rigid transform: where a frame lies, and how it is turned, seen from another frame. It takes coordinates of
    the inner frame to the outer one: `p_outer = R * p_inner + position`."""

    position: list[float]
    """Origin of the inner frame in the outer frame, metres: x, y, z.

    Unit: `m`.
    """

    quaternion_wxyz: list[float]
    """Rotation from the inner to the outer frame as a unit quaternion: w, x, y, z, with `w >= 0`.

    Unit: `1`.
    """


@dataclass(frozen=True)
class ChainModule:
    """The kinematic tree: who is whose parent, and where each joint sits and how it moves. With `dof_module`, this
    is all that forward kinematics needs."""

    links_in_chain: list[LinkInChain]
    """Every link, in link order.

    Length: `links`.
    """

    joints_in_chain: list[JointInChain]
    """Every joint, in joint order.

    Length: `joints`.
    """

    kinematic_hierarchy: list[list[int]]
    """Links by their depth below the root: level 0 is the root alone; each level ascending.

    Index of: `link`.
    """

    root_idx: int
    """The one link without a parent.

    Index of: `link`.
    """


@dataclass(frozen=True)
class LinkPath:
    """A path through the kinematic tree."""

    links: list[int]
    """The links along the path, both ends included.

    Index of: `link`.
    """

    joints: list[int]
    """The joints between them: one fewer than `links`.

    Index of: `joint`.
    """


@dataclass(frozen=True)
class ConnectionsModule:
    """Paths through the kinematic tree. The path from link i to link j climbs from i to their lowest common
    ancestor and goes down to j, so two slices of `root_paths` give it."""

    root_paths: list[LinkPath]
    """For each link, the path to it from the root.

    Length: `links`.
    """

    lowest_common_ancestors: list[list[int]]
    """Element (i, j) is the lowest link that lies above (or is) both i and j.

    Index of: `link`. Length: `links`, each `links`.
    """

    link_to_link_paths: list[list[LinkPath]] | None
    """Element (i, j) is the path from link i to link j. May be null above 300 links, and where the paths hold more
    than 2,000,000 links together.

    Length: `links`, each `links`.
    """

    link_connection_paths: list[list[list[int] | None]] | None
    """Element (i, j), where j is a descendant of i: the links from i (exclusive) to j (inclusive); where i is j:
    `[i]`; else null. The whole may be null where `link_to_link_paths` may.

    Index of: `link`. Length: `links`, each `links`.
    """


@dataclass(frozen=True)
class BoundsModule:
    """Bounds of the configuration space, per DOF: rad or m as `dofs` of `dof_module` says. Every bound is finite."""

    bounds: list[list[float]]
    """Lower and upper bound of each DOF.

    Unit: `rad or m`. Length: `dofs`.
    """

    dof_lower_bounds: list[float]
    """Lower bound of each DOF: the first elements of `bounds`.

    Unit: `rad or m`. Length: `dofs`.
    """

    dof_upper_bounds: list[float]
    """Upper bound of each DOF: the second elements of `bounds`.

    Unit: `rad or m`. Length: `dofs`.
    """

    dof_limited: list[bool]
    """For each DOF, whether the source limits it. A DOF without limits has the bounds [-pi, pi] if it is an angle
    and [-1, 1] if it is a length; a rotation vector's norm is at most pi.

    Length: `dofs`.
    """

    dof_velocity_limits: list[float | None]
    """For each DOF, the largest speed (rad/s or m/s); null where the source has none.

    Unit: `rad/s or m/s`. Length: `dofs`.
    """

    dof_effort_limits: list[float | None]
    """For each DOF, the largest effort (N m or N); null where the source has none.

    Unit: `N*m or N`. Length: `dofs`.
    """


@dataclass(frozen=True)
class KinematicsSample:
    """A configuration, and where every link is then."""

    kind: ConfigurationKind
    """Which configuration it is."""

    sample_idx: int | None
    """The number of a sampled configuration; null for the other kinds.

    Index of: `sample`.
    """

    configuration: list[float]
    """One value per DOF, rad or m.

    Unit: `rad or m`. Length: `dofs`.
    """

    link_poses: list[Pose]
    """For each link, its frame's pose in the root link's frame.

    Frame: `root`. Length: `links`.
    """


@dataclass(frozen=True)
class KinematicsSamplesModule:
    """Configurations, and the pose of every link in each: values by which a consumer in any language proves its
    forward kinematics right."""

    samples: list[KinematicsSample]
    """The samples: zero, middle, lower, upper, then sampled ones in order."""


@dataclass(frozen=True)
class CompositionBase:
    """A link that carries all parts and belongs to none of them."""

    link_idx: int
    """The link.

    Index of: `link or other`.
    """


@dataclass(frozen=True)
class CompositionPart:
    """A robot that became a part of another."""

    id: str
    """By what name the recipe knows it; unique among the parts."""

    name: str
    """Name of the robot that the part was."""

    source: PartSource
    """What it was taken from, with a digest."""

    prefix: str
    """What stands before the part's names of links and joints in this robot; empty for nothing."""

    links: list[PartLink]
    """The part's links that are in this robot, in link order."""

    joints: list[PartJoint]
    """The part's joints that are in this robot, in joint order."""

    dropped_links: list[str]
    """Names of the part's links that were left out, in the part's order."""

    dropped_joints: list[str]
    """Names of the part's joints that were left out, in the part's order."""

    frozen_joints: list[FrozenJoint]
    """The part's joints that were made fixed, in joint order."""

    attachment: PartAttachment | None
    """What it hangs on; null for the part that is the root."""

    composition: PartComposition | None
    """How the part itself was combined; null where it was not combined, or where this is not known."""


@dataclass(frozen=True)
class PartLink:
    """A link of a part."""

    name: str
    """Its name in the part."""

    link_idx: int
    """The link of this robot.

    Index of: `link or other`.
    """


@dataclass(frozen=True)
class PartJoint:
    """A joint of a part."""

    name: str
    """Its name in the part."""

    joint_idx: int
    """The joint of this robot.

    Index of: `joint or other`.
    """


@dataclass(frozen=True)
class FrozenJoint:
    """A joint that moved in the part, and is fixed in this robot."""

    joint_idx: int
    """The joint.

    Index of: `joint or other`.
    """

    position: list[float]
    """Where it was made fixed: a value for each DOF that it had, rad or m.

    Unit: `rad or m`.
    """


@dataclass(frozen=True)
class PartAttachment:
    """What a part hangs on."""

    part_idx: int | None
    """The part that carries it; null for the base.

    Index of: `part or other`.
    """

    link_idx: int
    """The link that carries it.

    Index of: `link or other`.
    """

    joint_idx: int
    """The joint between that link and the part's root link.

    Index of: `joint or other`.
    """


@dataclass(frozen=True)
class PartComposition:
    """How a part itself was combined, as the part's own `composition_module` says. Its indices are those of the
    part's own modules."""

    base: CompositionBase | None
    """The link that carries all parts and belongs to none of them; null where a part is the root."""

    parts: list[CompositionPart]
    """The parts."""


@dataclass(frozen=True)
class CompositionModule:
    """How this robot was combined from others, its parts. The robot itself is defined by the URDF that the URDD
    carries; this module says which part each of its links and joints came from."""

    base: CompositionBase | None
    """The link that carries all parts and belongs to none of them; null where a part is the root."""

    parts: list[CompositionPart]
    """The parts, in the order in which they stand in the URDF. The place in this list is the part's index.

    Length: `parts`.
    """


@dataclass(frozen=True)
class NamedConfiguration:
    """A configuration that a person named."""

    name: str
    """Its name; unique in the module, and not empty."""

    positions: list[DofPosition]
    """The positions that the person set, in DOF order. What a person decides is free; the names must exist."""

    configuration: list[float]
    """What follows: one value per DOF, rad or m. A DOF without an entry in `positions` has its value in the default
    configuration.

    Unit: `rad or m`. Length: `dofs`.
    """


@dataclass(frozen=True)
class DofPosition:
    """The position of a DOF."""

    dof_name: str
    """Name of the DOF, as in `dofs` of `dof_module`."""

    position: float
    """Its position, rad or m.

    Unit: `rad or m`.
    """


@dataclass(frozen=True)
class NamedConfigurationsModule:
    """Configurations that a person named: `home`, `ready`, `retract`."""

    configurations: list[NamedConfiguration]
    """The configurations, in the order in which the person added them."""


@dataclass(frozen=True)
class MeshReference:
    """A place in the URDF that names a mesh."""

    link_idx: int
    """The link.

    Index of: `link`.
    """

    geometry: GeometryKind
    """Whether a visual or a collision element names it."""

    element_idx: int
    """Which of the link's elements of that kind.

    Index of: `visual or collision`.
    """

    filename: str
    """File name as the URDF has it."""

    path: str | None
    """The carried file, relative to the URDD's root; null where the mesh could not be found."""


@dataclass(frozen=True)
class OriginalMesh:
    """A carried mesh file."""

    path: str
    """Path relative to the URDD's root, with forward slashes."""

    side_files: list[str]
    """Files that the mesh names in turn (`.mtl`, `.bin`, textures), relative to the URDD's root, sorted. They lie
    where the mesh expects them."""

    usable: bool
    """Whether the file can be read as a mesh, and has a triangle with an area. Where not, elements that name it
    have no surface."""


@dataclass(frozen=True)
class OriginalMeshesModule:
    """Every mesh that the URDF names, carried unchanged."""

    references: list[MeshReference]
    """Every mesh reference of the URDF: links in order, visual before collision, elements in order."""

    files: list[OriginalMesh]
    """Every carried mesh file once, sorted by path (byte order)."""


@dataclass(frozen=True)
class PlainMesh:
    """The mesh of a link."""

    geometry: GeometryKind
    """Which geometry it was made from."""

    files: MeshFiles
    """Its files."""


@dataclass(frozen=True)
class MeshFiles:
    """One mesh in up to three formats, the same triangles in each: vertices in metres, in the link's frame,
    binary32. Paths are relative to the URDD's root, with forward slashes."""

    stl: str | None
    """Binary STL; null where the module has none."""

    obj: str | None
    """Wavefront OBJ; null where the module has none."""

    glb: str
    """Binary glTF 2.0, no node with a transform, vertices in link axes, with the source's colours."""


@dataclass(frozen=True)
class PlainMeshesModule:
    """One mesh per link: all its geometry of one kind, with origin, rotation and scale applied and primitives
    tessellated."""

    preferred_geometry: GeometryKind
    """Which geometry is preferred; the other is used for a link that has none of it."""

    link_meshes: list[PlainMesh | None]
    """For each link its mesh, or null for a link without geometry.

    Length: `links`.
    """


@dataclass(frozen=True)
class ConvexHullMeshesModule:
    """The convex hull of each link's plain mesh."""

    link_hulls: list[MeshFiles | None]
    """For each link its hull, or null for a link without a plain mesh.

    Length: `links`.
    """


@dataclass(frozen=True)
class DecompositionMethod:
    """How convex pieces were made."""

    name: str
    """Name of the algorithm."""

    surface_tolerance: float | None
    """How far a point of the link's surface may lie outside the pieces, metres, where the algorithm promises that;
    else null.

    Unit: `m`.
    """


@dataclass(frozen=True)
class ConvexDecompositionMeshesModule:
    """Each link's plain mesh as a union of convex pieces."""

    method: DecompositionMethod
    """How the pieces were made. Any method may be used, as long as `surface_tolerance` holds (7.10)."""

    link_pieces: list[list[MeshFiles]]
    """For each link its pieces; empty for a link without a plain mesh. The place in the list is the piece index.

    Length: `links`, each `pieces`.
    """


@dataclass(frozen=True)
class Obb:
    """An oriented bounding box."""

    half_extents: list[float]
    """Half of each side length, metres, along the box's own axes.

    Unit: `m`. Frame: `shape`.
    """

    offset_xyz: list[float]
    """Centre in the link's frame, metres.

    Unit: `m`. Frame: `link`.
    """

    offset_rpy: list[float]
    """Rotation from the box's axes to the link's: fixed-axis roll, pitch, yaw, radians.

    Unit: `rad`. Frame: `link`.
    """


@dataclass(frozen=True)
class BoundingSphere:
    """A bounding sphere."""

    radius: float
    """Radius, metres.

    Unit: `m`.
    """

    offset_xyz: list[float]
    """Centre in the link's frame, metres.

    Unit: `m`. Frame: `link`.
    """


@dataclass(frozen=True)
class LinkShapesApproximationsModule:
    """Oriented bounding boxes (OBBs) and bounding spheres of each link and of each convex piece, in the link's
    frame."""

    full_obbs: list[Obb | None]
    """For each link, a box that holds its hull; null for a link without a mesh.

    Length: `links`.
    """

    full_bounding_spheres: list[BoundingSphere | None]
    """For each link, a sphere that holds its hull; null for a link without a mesh.

    Length: `links`.
    """

    decomposition_obbs: list[list[Obb]]
    """For each link, a box for each convex piece.

    Length: `links`, each `pieces`.
    """

    decomposition_bounding_spheres: list[list[BoundingSphere]]
    """For each link, a sphere for each convex piece.

    Length: `links`, each `pieces`.
    """


@dataclass(frozen=True)
class LinkShapesMaxDistanceFromOriginModule:
    """The largest distance of any point of a shape from the origin of its link's frame, metres."""

    full_convex_hulls_maximum_distances: list[float | None]
    """For each link, of its convex hull; null for a link without one.

    Unit: `m`. Length: `links`.
    """

    full_obbs_maximum_distances: list[float | None]
    """For each link, of its box; null for a link without one.

    Unit: `m`. Length: `links`.
    """

    full_bounding_spheres_maximum_distances: list[float | None]
    """For each link, of its sphere; null for a link without one.

    Unit: `m`. Length: `links`.
    """

    decomposition_convex_hulls_maximum_distances: list[list[float]]
    """For each link, of each convex piece.

    Unit: `m`. Length: `links`, each `pieces`.
    """

    decomposition_obbs_maximum_distances: list[list[float]]
    """For each link, of the box of each convex piece.

    Unit: `m`. Length: `links`, each `pieces`.
    """

    decomposition_bounding_spheres_maximum_distances: list[list[float]]
    """For each link, of the sphere of each convex piece.

    Unit: `m`. Length: `links`, each `pieces`.
    """


@dataclass(frozen=True)
class PieceShape:
    """A convex piece of a link."""

    link_idx: int
    """The link.

    Index of: `link`.
    """

    piece_idx: int
    """The piece, as in `link_pieces` of `convex_decomposition_meshes_module`.

    Index of: `piece`.
    """


@dataclass(frozen=True)
class DistanceStatistics:
    """Square symmetric matrices over one list of shapes, metres."""

    mean_distances: list[list[float]]
    """Mean distance of each pair.

    Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or decomposition_shapes`.
    """

    min_distances: list[list[float]]
    """Smallest distance of each pair.

    Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or decomposition_shapes`.
    """

    max_distances: list[list[float]]
    """Largest distance of each pair.

    Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or decomposition_shapes`.
    """


@dataclass(frozen=True)
class LinkShapesDistanceStatisticsModule:
    """Mean, smallest and largest distance of each pair of shapes over the specification's sampled configurations,
    metres. A distance is 0 where the shapes touch or overlap."""

    num_samples: int
    """Number of sampled configurations, from the first of the specification's sequence.

    Unit: `1`.
    """

    full_shapes: list[int]
    """What index i of a `full_…` matrix stands for: the links that have a shape, ascending.

    Index of: `link`. Length: `full_shapes`.
    """

    decomposition_shapes: list[PieceShape]
    """What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.

    Length: `decomposition_shapes`.
    """

    full_convex_hulls: DistanceStatistics
    """Between the links' convex hulls."""

    full_obbs: DistanceStatistics
    """Between the links' boxes."""

    full_bounding_spheres: DistanceStatistics
    """Between the links' spheres."""

    decomposition_convex_hulls: DistanceStatistics | None
    """Between convex pieces; null above 500 pieces, unless asked for."""

    decomposition_obbs: DistanceStatistics | None
    """Between the boxes of convex pieces; null above 500 pieces, unless asked for."""

    decomposition_bounding_spheres: DistanceStatistics | None
    """Between the spheres of convex pieces; null above 500 pieces, unless asked for."""


@dataclass(frozen=True)
class SkipReasons:
    """The reason of each pair, for each kind of shape."""

    full_convex_hulls: list[list[SkipReason]]
    """Between the links' convex hulls.

    Length: `full_shapes`, each `full_shapes`.
    """

    full_obbs: list[list[SkipReason]]
    """Between the links' boxes.

    Length: `full_shapes`, each `full_shapes`.
    """

    full_bounding_spheres: list[list[SkipReason]]
    """Between the links' spheres.

    Length: `full_shapes`, each `full_shapes`.
    """

    decomposition_convex_hulls: list[list[SkipReason]] | None
    """Between convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """

    decomposition_obbs: list[list[SkipReason]] | None
    """Between the boxes of convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """

    decomposition_bounding_spheres: list[list[SkipReason]] | None
    """Between the spheres of convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """


@dataclass(frozen=True)
class LinkShapesSimpleSkipsModule:
    """For each pair of shapes, whether the two are always in contact, so that checking them for collision says
    nothing, and the reason of the pair."""

    full_shapes: list[int]
    """What index i of a `full_…` matrix stands for: the links that have a shape, ascending.

    Index of: `link`. Length: `full_shapes`.
    """

    decomposition_shapes: list[PieceShape]
    """What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.

    Length: `decomposition_shapes`.
    """

    full_convex_hulls_simple_skips: list[list[bool]]
    """Skips between the links' convex hulls: true where both shapes are on one link, or where the largest sampled
    distance is at most 0.001 m.

    Length: `full_shapes`, each `full_shapes`.
    """

    full_obbs_simple_skips: list[list[bool]]
    """Skips between the links' boxes.

    Length: `full_shapes`, each `full_shapes`.
    """

    full_bounding_spheres_simple_skips: list[list[bool]]
    """Skips between the links' spheres.

    Length: `full_shapes`, each `full_shapes`.
    """

    decomposition_convex_hulls_simple_skips: list[list[bool]] | None
    """Skips between convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """

    decomposition_obbs_simple_skips: list[list[bool]] | None
    """Skips between the boxes of convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """

    decomposition_bounding_spheres_simple_skips: list[list[bool]] | None
    """Skips between the spheres of convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """

    reasons: SkipReasons
    """The reason of each pair, for each of the matrices above."""


@dataclass(frozen=True)
class SkipEdit:
    """A person's decision on a pair of links, for all their shapes of every kind."""

    link_a: str
    """Name of one link."""

    link_b: str
    """Name of the other link; may be the same."""

    skip: bool
    """Whether checks between the two are skipped."""

    reason: str
    """Why."""


@dataclass(frozen=True)
class LinkShapesSkipsModule:
    """The pairs of shapes that a collision check skips: those with one of the skipped reasons, and then a person's
    edits, applied in order."""

    skipped_reasons: list[SkippedReason]
    """The reasons of `link_shapes_simple_skips_module` for which a pair is skipped, each once, in the order of the
    specification."""

    edits: list[SkipEdit]
    """The edits, applied in order. What a person decides is free; the names must exist."""

    full_shapes: list[int]
    """What index i of a `full_…` matrix stands for: the links that have a shape, ascending.

    Index of: `link`. Length: `full_shapes`.
    """

    decomposition_shapes: list[PieceShape]
    """What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.

    Length: `decomposition_shapes`.
    """

    full_convex_hulls_skips: list[list[bool]]
    """Skips between the links' convex hulls.

    Length: `full_shapes`, each `full_shapes`.
    """

    full_obbs_skips: list[list[bool]]
    """Skips between the links' boxes.

    Length: `full_shapes`, each `full_shapes`.
    """

    full_bounding_spheres_skips: list[list[bool]]
    """Skips between the links' spheres.

    Length: `full_shapes`, each `full_shapes`.
    """

    decomposition_convex_hulls_skips: list[list[bool]] | None
    """Skips between convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """

    decomposition_obbs_skips: list[list[bool]] | None
    """Skips between the boxes of convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """

    decomposition_bounding_spheres_skips: list[list[bool]] | None
    """Skips between the spheres of convex pieces; null where the statistics are.

    Length: `decomposition_shapes`, each `decomposition_shapes`.
    """


@dataclass(frozen=True)
class AngleInput:
    """An angle."""

    dof_idx: int
    """The DOF, which is an angle.

    Index of: `dof`.
    """


@dataclass(frozen=True)
class LengthInput:
    """A length."""

    dof_idx: int
    """The DOF, which is a length.

    Index of: `dof`.
    """

    middle: float
    """What becomes 0, metres.

    Unit: `m`.
    """

    half_range: float
    """How far from that is 1, metres; positive.

    Unit: `m`.
    """


@dataclass(frozen=True)
class RotationVectorInput:
    """A rotation vector."""

    dof_idxs: list[int]
    """Its three DOFs.

    Index of: `dof`.
    """


@dataclass(frozen=True)
class ModelLayer:
    """A layer of a network: its values are `weights` times the values before, plus `biases`."""

    weights: list[list[float]]
    """One row for each value of the layer, with one number for each value before it.

    Unit: `1 or m`.
    """

    biases: list[float]
    """One number for each value of the layer.

    Unit: `1 or m`.
    """


@dataclass(frozen=True)
class ModelPair:
    """A pair of links that the network has an output for."""

    link_a_idx: int
    """One link.

    Index of: `link`.
    """

    link_b_idx: int
    """The other, of a higher index.

    Index of: `link`.
    """

    margin: float
    """The clearance of the pair is the network's output less this, metres. A clearance of 0 or less means that the
    pair may be in contact.

    Unit: `m`.
    """


@dataclass(frozen=True)
class LinkPair:
    """A pair of links."""

    link_a_idx: int
    """One link.

    Index of: `link`.
    """

    link_b_idx: int
    """The other, of a higher index.

    Index of: `link`.
    """


@dataclass(frozen=True)
class SampleRange:
    """Sampled configurations (SPEC 9.3) that follow each other."""

    first_sample_idx: int
    """The first.

    Index of: `sample`.
    """

    num_configurations: int
    """How many.

    Unit: `1`.
    """


@dataclass(frozen=True)
class ModelEvaluation:
    """How often the model is right on the sampled configurations 2^31 to 2^31 + 49,999, which have no part in
    making any model. A configuration is in collision where a pair of links in `pairs` or `other_pairs` is in
    contact, and free otherwise. The model clears a configuration where every clearance is above 0."""

    num_colliding: int
    """Number of configurations in collision.

    Unit: `1`.
    """

    num_missed: int
    """Number of these that the model clears: the misses.

    Unit: `1`.
    """

    num_near_contact: int
    """Number of configurations in collision that are near contact: a step of at most 0.05 rad or 0.05 m in each DOF
    makes them free (SPEC 8.8.10).

    Unit: `1`.
    """

    num_near_contact_missed: int
    """Number of these that the model clears.

    Unit: `1`.
    """

    num_free: int
    """Number of free configurations.

    Unit: `1`.
    """

    num_cleared: int
    """Number of these that the model clears.

    Unit: `1`.
    """


@dataclass(frozen=True)
class ModelTestVector:
    """What the model gives in a configuration."""

    configuration: list[float]
    """One value for each DOF, rad or m.

    Unit: `rad or m`. Length: `dofs`.
    """

    clearances: list[float]
    """One clearance for each entry of `pairs`, metres.

    Unit: `m`. Length: `pairs`.
    """


@dataclass(frozen=True)
class SelfCollisionModelModule:
    """A network that estimates, for a configuration, how near pairs of links are to each other. It is for passing
    over configurations that are far from any contact. It is an estimate, not a guarantee: `evaluation` says how
    often it is wrong."""

    trained_on: str
    """Of the shapes and the kinematics that it was trained on: SHA-256 of the text that SPEC 8.8.7 defines."""

    clip_distance: float
    """Distances from here on were all the same to it, metres.

    Unit: `m`.
    """

    inputs: list[ModelInput]
    """What the network is told of a configuration, in the order of its first layer's columns."""

    layers: list[ModelLayer]
    """The layers of the network, the first one first. After each but the last, every value is replaced by its
    hyperbolic tangent."""

    pairs: list[ModelPair]
    """The pairs of links that the network has an output for, in that order.

    Length: `pairs`.
    """

    other_pairs: list[LinkPair]
    """The pairs of links that are not skipped and have no output: they were never near in training."""

    training: SampleRange
    """The sampled configurations (SPEC 9.3) that it was trained on."""

    calibration: SampleRange
    """The sampled configurations that decided when training ended and what the margins are."""

    evaluation: ModelEvaluation
    """How often it is right on the sampled configurations that SPEC 8.8.9 fixes."""

    test_vectors: list[ModelTestVector]
    """What it gives in some configurations."""


@dataclass(frozen=True)
class SphereLevel:
    """A level: spheres of each link, and what they say."""

    origin: SphereOrigin
    """Where the spheres are from."""

    covers: bool
    """Whether every point of every piece is in a sphere of its link. Such a level never calls a collision free."""

    outer_level_idx: int | None
    """The level before this one whose spheres hold the spheres of this one; null for the first level.

    Index of: `other`.
    """

    spheres: list[list[LinkSphere]]
    """For each link, its spheres; none for a link without a piece.

    Length: `links`.
    """

    fits: list[SphereFit | None]
    """For each link, how far its spheres are from its pieces; null for a link without spheres.

    Length: `links`.
    """

    ignored_pairs: list[LinkPair]
    """Pairs of links that a check by this level leaves out, besides the skipped ones (SPEC 8.8.5): they were in no
    sampled collision, and their spheres touch all the same. None for a level that covers."""

    always_pairs: list[LinkPair]
    """Pairs of links with a sphere of each in contact in every sampled configuration."""

    sometimes_pairs: list[LinkPair]
    """Pairs of links with a sphere of each in contact in some of the sampled configurations, and not in all. All
    other pairs are in contact in none."""

    evaluation: SphereEvaluation
    """How often a check by this level is right in the sampled configurations."""


@dataclass(frozen=True)
class LinkSphere:
    """A sphere of a link."""

    radius: float
    """Radius, metres.

    Unit: `m`.
    """

    offset_xyz: list[float]
    """Centre in the link's frame, metres.

    Unit: `m`. Frame: `link`.
    """

    outer_sphere_idx: int | None
    """The sphere of the same link in the outer level that this one is inside of; null in the first level.

    Index of: `other`.
    """


@dataclass(frozen=True)
class SphereFit:
    """How far the spheres of a link are from its pieces, by the points of SPEC 8.9.5."""

    max_standoff: float
    """The largest distance of a point on the spheres from the pieces, metres.

    Unit: `m`.
    """

    mean_standoff: float
    """The mean distance of points on the spheres from the pieces, metres.

    Unit: `m`.
    """

    uncovered_fraction: float
    """The part of the surface of the pieces that is outside of all spheres, from 0 to 1.

    Unit: `1`.
    """

    max_uncovered: float
    """The largest distance of a point of that surface from the spheres, metres; 0 where all of it is in spheres.

    Unit: `m`.
    """


@dataclass(frozen=True)
class SphereEvaluation:
    """How often a check by a level is right. A configuration is in collision where two pieces are in contact whose
    links are not skipped, and free otherwise; the level touches where spheres are in contact of two links that
    are neither skipped nor ignored."""

    num_colliding: int
    """Number of configurations in collision.

    Unit: `1`.
    """

    num_missed: int
    """Number of these in which the level does not touch.

    Unit: `1`.
    """

    num_free: int
    """Number of free configurations.

    Unit: `1`.
    """

    num_false_contacts: int
    """Number of these in which the level touches.

    Unit: `1`.
    """


@dataclass(frozen=True)
class LinkShapesSpheresModule:
    """Spheres that stand for the convex pieces of links, for programs that check very many configurations."""

    levels: list[SphereLevel]
    """The levels, from coarse to fine. The first has one sphere for each link with a piece."""

    num_samples: int
    """How many sampled configurations (SPEC 9.3), from 2^31 on, pairs and counts of the levels are of.

    Unit: `1`.
    """


@dataclass(frozen=True)
class Loop:
    """What holds two links together besides the joints of the tree."""

    name: str
    """Its name; unique among loops and couplings."""

    kind: LoopKind
    """Which numbers of the pose of frame B in frame A are held."""

    link_a_idx: int
    """The link that frame A is fixed to.

    Index of: `link`.
    """

    frame_a: Pose
    """Frame A, in that link's frame.

    Frame: `link`.
    """

    link_b_idx: int
    """The link that frame B is fixed to: another one.

    Index of: `link`.
    """

    frame_b: Pose
    """Frame B, in that link's frame.

    Frame: `link`.
    """

    position_tolerance: float
    """How far the held position may be off where the loop counts as closed, m: the precision of the source. Not
    negative.

    Unit: `m`.
    """

    rotation_tolerance: float
    """How far the held rotation may be off there, rad. Not negative.

    Unit: `rad`.
    """


@dataclass(frozen=True)
class Coupling:
    """An equation between DOFs: the constant and all terms add up to 0."""

    name: str
    """Its name; unique among loops and couplings."""

    constant: float
    """The constant.

    Unit: `rad or m`.
    """

    terms: list[CouplingTerm]
    """One term for each DOF, in DOF order."""


@dataclass(frozen=True)
class CouplingTerm:
    """What a DOF adds to the sum of a coupling: c1 q + c2 q^2 + c3 q^3 + c4 q^4."""

    dof_idx: int
    """The DOF.

    Index of: `dof`.
    """

    coefficients: list[float]
    """c1, c2, c3 and c4.

    Unit: `1 or rad/m or m/rad or 1/rad or 1/m or rad/m^2 or m/rad^2 or 1/rad^2 or 1/m^2 or rad/m^3 or m/rad^3 or
    1/rad^3 or 1/m^3 or rad/m^4 or m/rad^4`.
    """


@dataclass(frozen=True)
class ClosedSample:
    """A closed configuration whose independent DOFs have the values of a sampled configuration."""

    sample_idx: int
    """The number of the sampled configuration.

    Index of: `sample`.
    """

    configuration: list[float] | None
    """One value per DOF, rad or m; null where none was found that is closed.

    Unit: `rad or m`. Length: `dofs`.
    """


@dataclass(frozen=True)
class LoopsModule:
    """What closes the kinematic loops of a robot, and couplings between its DOFs. The links and joints of the other
    modules are its spanning tree."""

    loops: list[Loop]
    """The loops."""

    couplings: list[Coupling]
    """Equations between DOFs, such as gears between joints of different branches."""

    independent_dof_idxs: list[int]
    """The DOFs that move freely, ascending; the others follow from them. Their number is the mobility at the
    reference configuration.

    Index of: `dof`.
    """

    reference_configuration: list[float]
    """A configuration in which all loops are closed and all couplings hold: one value per DOF, rad or m.

    Unit: `rad or m`. Length: `dofs`.
    """

    closed_samples: list[ClosedSample]
    """Sampled configurations that are closed, numbered from 0 without gaps."""


Source: TypeAlias = FileEntry
"""What a URDD was made from: in JSON an object of one key, here that key's value."""

Geometry: TypeAlias = Mesh | Cuboid | Cylinder | Capsule | Sphere
"""A shape: in JSON an object of one key, here that key's value."""

PartSource: TypeAlias = tuple[Literal["Urdd", "Urdf"], str]
"""The source of a part: in JSON an object of one key, here that key and its value."""

ModelInput: TypeAlias = AngleInput | LengthInput | RotationVectorInput
"""Something that the network is told of a configuration: in JSON an object of one key, here that key's value."""


def _generator(v: Any) -> Generator:
    return Generator(
        name=v["name"],
        version=v["version"],
    )


def _source(v: Any) -> Source:
    (value,) = v.values()
    return _file_entry(value)


def _file_entry(v: Any) -> FileEntry:
    return FileEntry(
        path=v["path"],
        size=int(v["size"]),
        sha256=v["sha256"],
    )


def _module_entry(v: Any) -> ModuleEntry:
    return ModuleEntry(
        name=v["name"],
        version=v["version"],
        path=v["path"],
        depends_on=v["depends_on"],
        files=[_file_entry(x) for x in v["files"]],
    )


def _root_metadata(v: Any) -> RootMetadata:
    return RootMetadata(
        urdd_version=v["urdd_version"],
        robot_name=v["robot_name"],
        conformance_class=v["conformance_class"],
        generator=None if v["generator"] is None else _generator(v["generator"]),
        source=None if v["source"] is None else _source(v["source"]),
        modules=[_module_entry(x) for x in v["modules"]],
    )


def _link(v: Any) -> Link:
    return Link(
        name=v["name"],
        inertial=None if v["inertial"] is None else _inertial(v["inertial"]),
        visual=[_visual(x) for x in v["visual"]],
        collision=[_collision(x) for x in v["collision"]],
        unknown_elements=v["unknown_elements"],
    )


def _inertial(v: Any) -> Inertial:
    return Inertial(
        origin=None if v["origin"] is None else _origin(v["origin"]),
        mass=None if v["mass"] is None else _mass(v["mass"]),
        inertia=None if v["inertia"] is None else _inertia(v["inertia"]),
    )


def _origin(v: Any) -> Origin:
    return Origin(
        xyz=v["xyz"],
        rpy=v["rpy"],
        quat_xyzw=v["quat_xyzw"],
    )


def _mass(v: Any) -> Mass:
    return Mass(
        value=v["value"],
    )


def _inertia(v: Any) -> Inertia:
    return Inertia(
        ixx=v["ixx"],
        ixy=v["ixy"],
        ixz=v["ixz"],
        iyy=v["iyy"],
        iyz=v["iyz"],
        izz=v["izz"],
    )


def _visual(v: Any) -> Visual:
    return Visual(
        name=v["name"],
        origin=None if v["origin"] is None else _origin(v["origin"]),
        geometry=None if v["geometry"] is None else _geometry(v["geometry"]),
        material=None if v["material"] is None else _material(v["material"]),
    )


def _geometry(v: Any) -> Geometry:
    ((kind, value),) = v.items()
    if kind == "Mesh":
        return _mesh(value)
    if kind == "Box":
        return _cuboid(value)
    if kind == "Cylinder":
        return _cylinder(value)
    if kind == "Capsule":
        return _capsule(value)
    return _sphere(value)


def _mesh(v: Any) -> Mesh:
    return Mesh(
        filename=v["filename"],
        scale=v["scale"],
    )


def _cuboid(v: Any) -> Cuboid:
    return Cuboid(
        size=v["size"],
    )


def _cylinder(v: Any) -> Cylinder:
    return Cylinder(
        radius=v["radius"],
        length=v["length"],
    )


def _capsule(v: Any) -> Capsule:
    return Capsule(
        radius=v["radius"],
        length=v["length"],
    )


def _sphere(v: Any) -> Sphere:
    return Sphere(
        radius=v["radius"],
    )


def _material(v: Any) -> Material:
    return Material(
        name=v["name"],
        color=None if v["color"] is None else _color(v["color"]),
        texture=None if v["texture"] is None else _texture(v["texture"]),
    )


def _color(v: Any) -> Color:
    return Color(
        rgba=v["rgba"],
    )


def _texture(v: Any) -> Texture:
    return Texture(
        filename=v["filename"],
    )


def _collision(v: Any) -> Collision:
    return Collision(
        name=v["name"],
        origin=None if v["origin"] is None else _origin(v["origin"]),
        geometry=None if v["geometry"] is None else _geometry(v["geometry"]),
    )


def _joint(v: Any) -> Joint:
    return Joint(
        name=v["name"],
        joint_type=v["joint_type"],
        origin=None if v["origin"] is None else _origin(v["origin"]),
        parent=_link_name(v["parent"]),
        child=_link_name(v["child"]),
        axis=None if v["axis"] is None else _axis(v["axis"]),
        limit=None if v["limit"] is None else _limit(v["limit"]),
        dynamics=None if v["dynamics"] is None else _dynamics(v["dynamics"]),
        mimic=None if v["mimic"] is None else _mimic(v["mimic"]),
        safety_controller=None if v["safety_controller"] is None else _safety_controller(v["safety_controller"]),
        calibration=None if v["calibration"] is None else _calibration(v["calibration"]),
        unknown_elements=v["unknown_elements"],
    )


def _link_name(v: Any) -> LinkName:
    return LinkName(
        link=v["link"],
    )


def _axis(v: Any) -> Axis:
    return Axis(
        xyz=v["xyz"],
    )


def _limit(v: Any) -> Limit:
    return Limit(
        lower=v["lower"],
        upper=v["upper"],
        effort=v["effort"],
        velocity=v["velocity"],
        acceleration=v["acceleration"],
        deceleration=v["deceleration"],
        jerk=v["jerk"],
    )


def _dynamics(v: Any) -> Dynamics:
    return Dynamics(
        damping=v["damping"],
        friction=v["friction"],
    )


def _mimic(v: Any) -> Mimic:
    return Mimic(
        joint=v["joint"],
        multiplier=v["multiplier"],
        offset=v["offset"],
    )


def _safety_controller(v: Any) -> SafetyController:
    return SafetyController(
        soft_lower_limit=v["soft_lower_limit"],
        soft_upper_limit=v["soft_upper_limit"],
        k_position=v["k_position"],
        k_velocity=v["k_velocity"],
    )


def _calibration(v: Any) -> Calibration:
    return Calibration(
        rising=v["rising"],
        falling=v["falling"],
    )


def _urdf_module(v: Any) -> UrdfModule:
    return UrdfModule(
        name=v["name"],
        version=v["version"],
        links=[_link(x) for x in v["links"]],
        joints=[_joint(x) for x in v["joints"]],
        materials=[_material(x) for x in v["materials"]],
        unknown_elements=v["unknown_elements"],
    )


def _resolved_mimic(v: Any) -> ResolvedMimic:
    return ResolvedMimic(
        dof_idx=None if v["dof_idx"] is None else int(v["dof_idx"]),
        multiplier=v["multiplier"],
        offset=v["offset"],
    )


def _dof(v: Any) -> Dof:
    return Dof(
        name=v["name"],
        joint_idx=int(v["joint_idx"]),
        joint_name=v["joint_name"],
        quantity=v["quantity"],
    )


def _dof_module(v: Any) -> DofModule:
    return DofModule(
        num_dofs=int(v["num_dofs"]),
        dof_idx_to_joint_idx_mapping=[int(x) for x in v["dof_idx_to_joint_idx_mapping"]],
        joint_idx_to_dof_idxs_mapping=[[int(y) for y in x] for x in v["joint_idx_to_dof_idxs_mapping"]],
        joint_idx_to_mimic_mapping=[None if x is None else _resolved_mimic(x) for x in v["joint_idx_to_mimic_mapping"]],
        dofs=[_dof(x) for x in v["dofs"]],
    )


def _link_in_chain(v: Any) -> LinkInChain:
    return LinkInChain(
        name=v["name"],
        link_idx=int(v["link_idx"]),
        parent_joint_idx=None if v["parent_joint_idx"] is None else int(v["parent_joint_idx"]),
        parent_link_idx=None if v["parent_link_idx"] is None else int(v["parent_link_idx"]),
        children_joint_idxs=[int(x) for x in v["children_joint_idxs"]],
        children_link_idxs=[int(x) for x in v["children_link_idxs"]],
    )


def _joint_in_chain(v: Any) -> JointInChain:
    return JointInChain(
        joint_name=v["joint_name"],
        joint_idx=int(v["joint_idx"]),
        parent_link_name=v["parent_link_name"],
        parent_link_idx=int(v["parent_link_idx"]),
        child_link_name=v["child_link_name"],
        child_link_idx=int(v["child_link_idx"]),
        joint_type=v["joint_type"],
        origin=_pose(v["origin"]),
        axis=v["axis"],
    )


def _pose(v: Any) -> Pose:
    return Pose(
        position=v["position"],
        quaternion_wxyz=v["quaternion_wxyz"],
    )


def _chain_module(v: Any) -> ChainModule:
    return ChainModule(
        links_in_chain=[_link_in_chain(x) for x in v["links_in_chain"]],
        joints_in_chain=[_joint_in_chain(x) for x in v["joints_in_chain"]],
        kinematic_hierarchy=[[int(y) for y in x] for x in v["kinematic_hierarchy"]],
        root_idx=int(v["root_idx"]),
    )


def _link_path(v: Any) -> LinkPath:
    return LinkPath(
        links=[int(x) for x in v["links"]],
        joints=[int(x) for x in v["joints"]],
    )


def _connections_module(v: Any) -> ConnectionsModule:
    return ConnectionsModule(
        root_paths=[_link_path(x) for x in v["root_paths"]],
        lowest_common_ancestors=[[int(y) for y in x] for x in v["lowest_common_ancestors"]],
        link_to_link_paths=None
        if v["link_to_link_paths"] is None
        else [[_link_path(y) for y in x] for x in v["link_to_link_paths"]],
        link_connection_paths=None
        if v["link_connection_paths"] is None
        else [[None if y is None else [int(z) for z in y] for y in x] for x in v["link_connection_paths"]],
    )


def _bounds_module(v: Any) -> BoundsModule:
    return BoundsModule(
        bounds=v["bounds"],
        dof_lower_bounds=v["dof_lower_bounds"],
        dof_upper_bounds=v["dof_upper_bounds"],
        dof_limited=v["dof_limited"],
        dof_velocity_limits=v["dof_velocity_limits"],
        dof_effort_limits=v["dof_effort_limits"],
    )


def _kinematics_sample(v: Any) -> KinematicsSample:
    return KinematicsSample(
        kind=v["kind"],
        sample_idx=None if v["sample_idx"] is None else int(v["sample_idx"]),
        configuration=v["configuration"],
        link_poses=[_pose(x) for x in v["link_poses"]],
    )


def _kinematics_samples_module(v: Any) -> KinematicsSamplesModule:
    return KinematicsSamplesModule(
        samples=[_kinematics_sample(x) for x in v["samples"]],
    )


def _composition_base(v: Any) -> CompositionBase:
    return CompositionBase(
        link_idx=int(v["link_idx"]),
    )


def _composition_part(v: Any) -> CompositionPart:
    return CompositionPart(
        id=v["id"],
        name=v["name"],
        source=_part_source(v["source"]),
        prefix=v["prefix"],
        links=[_part_link(x) for x in v["links"]],
        joints=[_part_joint(x) for x in v["joints"]],
        dropped_links=v["dropped_links"],
        dropped_joints=v["dropped_joints"],
        frozen_joints=[_frozen_joint(x) for x in v["frozen_joints"]],
        attachment=None if v["attachment"] is None else _part_attachment(v["attachment"]),
        composition=None if v["composition"] is None else _part_composition(v["composition"]),
    )


def _part_source(v: Any) -> PartSource:
    ((kind, value),) = v.items()
    return kind, value


def _part_link(v: Any) -> PartLink:
    return PartLink(
        name=v["name"],
        link_idx=int(v["link_idx"]),
    )


def _part_joint(v: Any) -> PartJoint:
    return PartJoint(
        name=v["name"],
        joint_idx=int(v["joint_idx"]),
    )


def _frozen_joint(v: Any) -> FrozenJoint:
    return FrozenJoint(
        joint_idx=int(v["joint_idx"]),
        position=v["position"],
    )


def _part_attachment(v: Any) -> PartAttachment:
    return PartAttachment(
        part_idx=None if v["part_idx"] is None else int(v["part_idx"]),
        link_idx=int(v["link_idx"]),
        joint_idx=int(v["joint_idx"]),
    )


def _part_composition(v: Any) -> PartComposition:
    return PartComposition(
        base=None if v["base"] is None else _composition_base(v["base"]),
        parts=[_composition_part(x) for x in v["parts"]],
    )


def _composition_module(v: Any) -> CompositionModule:
    return CompositionModule(
        base=None if v["base"] is None else _composition_base(v["base"]),
        parts=[_composition_part(x) for x in v["parts"]],
    )


def _named_configuration(v: Any) -> NamedConfiguration:
    return NamedConfiguration(
        name=v["name"],
        positions=[_dof_position(x) for x in v["positions"]],
        configuration=v["configuration"],
    )


def _dof_position(v: Any) -> DofPosition:
    return DofPosition(
        dof_name=v["dof_name"],
        position=v["position"],
    )


def _named_configurations_module(v: Any) -> NamedConfigurationsModule:
    return NamedConfigurationsModule(
        configurations=[_named_configuration(x) for x in v["configurations"]],
    )


def _mesh_reference(v: Any) -> MeshReference:
    return MeshReference(
        link_idx=int(v["link_idx"]),
        geometry=v["geometry"],
        element_idx=int(v["element_idx"]),
        filename=v["filename"],
        path=v["path"],
    )


def _original_mesh(v: Any) -> OriginalMesh:
    return OriginalMesh(
        path=v["path"],
        side_files=v["side_files"],
        usable=v["usable"],
    )


def _original_meshes_module(v: Any) -> OriginalMeshesModule:
    return OriginalMeshesModule(
        references=[_mesh_reference(x) for x in v["references"]],
        files=[_original_mesh(x) for x in v["files"]],
    )


def _plain_mesh(v: Any) -> PlainMesh:
    return PlainMesh(
        geometry=v["geometry"],
        files=_mesh_files(v["files"]),
    )


def _mesh_files(v: Any) -> MeshFiles:
    return MeshFiles(
        stl=v["stl"],
        obj=v["obj"],
        glb=v["glb"],
    )


def _plain_meshes_module(v: Any) -> PlainMeshesModule:
    return PlainMeshesModule(
        preferred_geometry=v["preferred_geometry"],
        link_meshes=[None if x is None else _plain_mesh(x) for x in v["link_meshes"]],
    )


def _convex_hull_meshes_module(v: Any) -> ConvexHullMeshesModule:
    return ConvexHullMeshesModule(
        link_hulls=[None if x is None else _mesh_files(x) for x in v["link_hulls"]],
    )


def _decomposition_method(v: Any) -> DecompositionMethod:
    return DecompositionMethod(
        name=v["name"],
        surface_tolerance=v["surface_tolerance"],
    )


def _convex_decomposition_meshes_module(v: Any) -> ConvexDecompositionMeshesModule:
    return ConvexDecompositionMeshesModule(
        method=_decomposition_method(v["method"]),
        link_pieces=[[_mesh_files(y) for y in x] for x in v["link_pieces"]],
    )


def _obb(v: Any) -> Obb:
    return Obb(
        half_extents=v["half_extents"],
        offset_xyz=v["offset_xyz"],
        offset_rpy=v["offset_rpy"],
    )


def _bounding_sphere(v: Any) -> BoundingSphere:
    return BoundingSphere(
        radius=v["radius"],
        offset_xyz=v["offset_xyz"],
    )


def _link_shapes_approximations_module(v: Any) -> LinkShapesApproximationsModule:
    return LinkShapesApproximationsModule(
        full_obbs=[None if x is None else _obb(x) for x in v["full_obbs"]],
        full_bounding_spheres=[None if x is None else _bounding_sphere(x) for x in v["full_bounding_spheres"]],
        decomposition_obbs=[[_obb(y) for y in x] for x in v["decomposition_obbs"]],
        decomposition_bounding_spheres=[[_bounding_sphere(y) for y in x] for x in v["decomposition_bounding_spheres"]],
    )


def _link_shapes_max_distance_from_origin_module(v: Any) -> LinkShapesMaxDistanceFromOriginModule:
    return LinkShapesMaxDistanceFromOriginModule(
        full_convex_hulls_maximum_distances=v["full_convex_hulls_maximum_distances"],
        full_obbs_maximum_distances=v["full_obbs_maximum_distances"],
        full_bounding_spheres_maximum_distances=v["full_bounding_spheres_maximum_distances"],
        decomposition_convex_hulls_maximum_distances=v["decomposition_convex_hulls_maximum_distances"],
        decomposition_obbs_maximum_distances=v["decomposition_obbs_maximum_distances"],
        decomposition_bounding_spheres_maximum_distances=v["decomposition_bounding_spheres_maximum_distances"],
    )


def _piece_shape(v: Any) -> PieceShape:
    return PieceShape(
        link_idx=int(v["link_idx"]),
        piece_idx=int(v["piece_idx"]),
    )


def _distance_statistics(v: Any) -> DistanceStatistics:
    return DistanceStatistics(
        mean_distances=v["mean_distances"],
        min_distances=v["min_distances"],
        max_distances=v["max_distances"],
    )


def _link_shapes_distance_statistics_module(v: Any) -> LinkShapesDistanceStatisticsModule:
    return LinkShapesDistanceStatisticsModule(
        num_samples=int(v["num_samples"]),
        full_shapes=[int(x) for x in v["full_shapes"]],
        decomposition_shapes=[_piece_shape(x) for x in v["decomposition_shapes"]],
        full_convex_hulls=_distance_statistics(v["full_convex_hulls"]),
        full_obbs=_distance_statistics(v["full_obbs"]),
        full_bounding_spheres=_distance_statistics(v["full_bounding_spheres"]),
        decomposition_convex_hulls=None
        if v["decomposition_convex_hulls"] is None
        else _distance_statistics(v["decomposition_convex_hulls"]),
        decomposition_obbs=None if v["decomposition_obbs"] is None else _distance_statistics(v["decomposition_obbs"]),
        decomposition_bounding_spheres=None
        if v["decomposition_bounding_spheres"] is None
        else _distance_statistics(v["decomposition_bounding_spheres"]),
    )


def _skip_reasons(v: Any) -> SkipReasons:
    return SkipReasons(
        full_convex_hulls=v["full_convex_hulls"],
        full_obbs=v["full_obbs"],
        full_bounding_spheres=v["full_bounding_spheres"],
        decomposition_convex_hulls=v["decomposition_convex_hulls"],
        decomposition_obbs=v["decomposition_obbs"],
        decomposition_bounding_spheres=v["decomposition_bounding_spheres"],
    )


def _link_shapes_simple_skips_module(v: Any) -> LinkShapesSimpleSkipsModule:
    return LinkShapesSimpleSkipsModule(
        full_shapes=[int(x) for x in v["full_shapes"]],
        decomposition_shapes=[_piece_shape(x) for x in v["decomposition_shapes"]],
        full_convex_hulls_simple_skips=v["full_convex_hulls_simple_skips"],
        full_obbs_simple_skips=v["full_obbs_simple_skips"],
        full_bounding_spheres_simple_skips=v["full_bounding_spheres_simple_skips"],
        decomposition_convex_hulls_simple_skips=v["decomposition_convex_hulls_simple_skips"],
        decomposition_obbs_simple_skips=v["decomposition_obbs_simple_skips"],
        decomposition_bounding_spheres_simple_skips=v["decomposition_bounding_spheres_simple_skips"],
        reasons=_skip_reasons(v["reasons"]),
    )


def _skip_edit(v: Any) -> SkipEdit:
    return SkipEdit(
        link_a=v["link_a"],
        link_b=v["link_b"],
        skip=v["skip"],
        reason=v["reason"],
    )


def _link_shapes_skips_module(v: Any) -> LinkShapesSkipsModule:
    return LinkShapesSkipsModule(
        skipped_reasons=v["skipped_reasons"],
        edits=[_skip_edit(x) for x in v["edits"]],
        full_shapes=[int(x) for x in v["full_shapes"]],
        decomposition_shapes=[_piece_shape(x) for x in v["decomposition_shapes"]],
        full_convex_hulls_skips=v["full_convex_hulls_skips"],
        full_obbs_skips=v["full_obbs_skips"],
        full_bounding_spheres_skips=v["full_bounding_spheres_skips"],
        decomposition_convex_hulls_skips=v["decomposition_convex_hulls_skips"],
        decomposition_obbs_skips=v["decomposition_obbs_skips"],
        decomposition_bounding_spheres_skips=v["decomposition_bounding_spheres_skips"],
    )


def _model_input(v: Any) -> ModelInput:
    ((kind, value),) = v.items()
    if kind == "Angle":
        return _angle_input(value)
    if kind == "Length":
        return _length_input(value)
    return _rotation_vector_input(value)


def _angle_input(v: Any) -> AngleInput:
    return AngleInput(
        dof_idx=int(v["dof_idx"]),
    )


def _length_input(v: Any) -> LengthInput:
    return LengthInput(
        dof_idx=int(v["dof_idx"]),
        middle=v["middle"],
        half_range=v["half_range"],
    )


def _rotation_vector_input(v: Any) -> RotationVectorInput:
    return RotationVectorInput(
        dof_idxs=[int(x) for x in v["dof_idxs"]],
    )


def _model_layer(v: Any) -> ModelLayer:
    return ModelLayer(
        weights=v["weights"],
        biases=v["biases"],
    )


def _model_pair(v: Any) -> ModelPair:
    return ModelPair(
        link_a_idx=int(v["link_a_idx"]),
        link_b_idx=int(v["link_b_idx"]),
        margin=v["margin"],
    )


def _link_pair(v: Any) -> LinkPair:
    return LinkPair(
        link_a_idx=int(v["link_a_idx"]),
        link_b_idx=int(v["link_b_idx"]),
    )


def _sample_range(v: Any) -> SampleRange:
    return SampleRange(
        first_sample_idx=int(v["first_sample_idx"]),
        num_configurations=int(v["num_configurations"]),
    )


def _model_evaluation(v: Any) -> ModelEvaluation:
    return ModelEvaluation(
        num_colliding=int(v["num_colliding"]),
        num_missed=int(v["num_missed"]),
        num_near_contact=int(v["num_near_contact"]),
        num_near_contact_missed=int(v["num_near_contact_missed"]),
        num_free=int(v["num_free"]),
        num_cleared=int(v["num_cleared"]),
    )


def _model_test_vector(v: Any) -> ModelTestVector:
    return ModelTestVector(
        configuration=v["configuration"],
        clearances=v["clearances"],
    )


def _self_collision_model_module(v: Any) -> SelfCollisionModelModule:
    return SelfCollisionModelModule(
        trained_on=v["trained_on"],
        clip_distance=v["clip_distance"],
        inputs=[_model_input(x) for x in v["inputs"]],
        layers=[_model_layer(x) for x in v["layers"]],
        pairs=[_model_pair(x) for x in v["pairs"]],
        other_pairs=[_link_pair(x) for x in v["other_pairs"]],
        training=_sample_range(v["training"]),
        calibration=_sample_range(v["calibration"]),
        evaluation=_model_evaluation(v["evaluation"]),
        test_vectors=[_model_test_vector(x) for x in v["test_vectors"]],
    )


def _sphere_level(v: Any) -> SphereLevel:
    return SphereLevel(
        origin=v["origin"],
        covers=v["covers"],
        outer_level_idx=None if v["outer_level_idx"] is None else int(v["outer_level_idx"]),
        spheres=[[_link_sphere(y) for y in x] for x in v["spheres"]],
        fits=[None if x is None else _sphere_fit(x) for x in v["fits"]],
        ignored_pairs=[_link_pair(x) for x in v["ignored_pairs"]],
        always_pairs=[_link_pair(x) for x in v["always_pairs"]],
        sometimes_pairs=[_link_pair(x) for x in v["sometimes_pairs"]],
        evaluation=_sphere_evaluation(v["evaluation"]),
    )


def _link_sphere(v: Any) -> LinkSphere:
    return LinkSphere(
        radius=v["radius"],
        offset_xyz=v["offset_xyz"],
        outer_sphere_idx=None if v["outer_sphere_idx"] is None else int(v["outer_sphere_idx"]),
    )


def _sphere_fit(v: Any) -> SphereFit:
    return SphereFit(
        max_standoff=v["max_standoff"],
        mean_standoff=v["mean_standoff"],
        uncovered_fraction=v["uncovered_fraction"],
        max_uncovered=v["max_uncovered"],
    )


def _sphere_evaluation(v: Any) -> SphereEvaluation:
    return SphereEvaluation(
        num_colliding=int(v["num_colliding"]),
        num_missed=int(v["num_missed"]),
        num_free=int(v["num_free"]),
        num_false_contacts=int(v["num_false_contacts"]),
    )


def _link_shapes_spheres_module(v: Any) -> LinkShapesSpheresModule:
    return LinkShapesSpheresModule(
        levels=[_sphere_level(x) for x in v["levels"]],
        num_samples=int(v["num_samples"]),
    )


def _loop(v: Any) -> Loop:
    return Loop(
        name=v["name"],
        kind=v["kind"],
        link_a_idx=int(v["link_a_idx"]),
        frame_a=_pose(v["frame_a"]),
        link_b_idx=int(v["link_b_idx"]),
        frame_b=_pose(v["frame_b"]),
        position_tolerance=v["position_tolerance"],
        rotation_tolerance=v["rotation_tolerance"],
    )


def _coupling(v: Any) -> Coupling:
    return Coupling(
        name=v["name"],
        constant=v["constant"],
        terms=[_coupling_term(x) for x in v["terms"]],
    )


def _coupling_term(v: Any) -> CouplingTerm:
    return CouplingTerm(
        dof_idx=int(v["dof_idx"]),
        coefficients=v["coefficients"],
    )


def _closed_sample(v: Any) -> ClosedSample:
    return ClosedSample(
        sample_idx=int(v["sample_idx"]),
        configuration=v["configuration"],
    )


def _loops_module(v: Any) -> LoopsModule:
    return LoopsModule(
        loops=[_loop(x) for x in v["loops"]],
        couplings=[_coupling(x) for x in v["couplings"]],
        independent_dof_idxs=[int(x) for x in v["independent_dof_idxs"]],
        reference_configuration=v["reference_configuration"],
        closed_samples=[_closed_sample(x) for x in v["closed_samples"]],
    )


class Modules(Reading):
    """The modules of a URDD, as typed objects. Each is read when it is first asked for, and then kept.

    Each property raises `ModuleMissingError` where the module is not there, and `ModuleUnusableError` where it is of no
    use, or of before version 1: `json` reads those too.
    """

    @property
    def urdf(self) -> UrdfModule:
        """The source URDF as data. What the URDF leaves out is null (or an empty list), never a default. Lengths
        are metres, angles radians, masses kilograms; rotations are the URDF's own fixed-axis roll, pitch, yaw.
        Numbers that are not finite in the URDF are written as null."""
        return self._read("urdf_module", _urdf_module)

    @property
    def dof(self) -> DofModule:
        """The robot's degrees of freedom (DOFs), in joint order, and the position of every joint as a function of
        them."""
        return self._read("dof_module", _dof_module)

    @property
    def chain(self) -> ChainModule:
        """The kinematic tree: who is whose parent, and where each joint sits and how it moves. With `dof_module`,
        this is all that forward kinematics needs."""
        return self._read("chain_module", _chain_module)

    @property
    def connections(self) -> ConnectionsModule:
        """Paths through the kinematic tree. The path from link i to link j climbs from i to their lowest common
        ancestor and goes down to j, so two slices of `root_paths` give it."""
        return self._read("connections_module", _connections_module)

    @property
    def bounds(self) -> BoundsModule:
        """Bounds of the configuration space, per DOF: rad or m as `dofs` of `dof_module` says. Every bound is
        finite."""
        return self._read("bounds_module", _bounds_module)

    @property
    def kinematics_samples(self) -> KinematicsSamplesModule:
        """Configurations, and the pose of every link in each: values by which a consumer in any language proves its
        forward kinematics right."""
        return self._read("kinematics_samples_module", _kinematics_samples_module)

    @property
    def composition(self) -> CompositionModule:
        """How this robot was combined from others, its parts. The robot itself is defined by the URDF that the URDD
        carries; this module says which part each of its links and joints came from."""
        return self._read("composition_module", _composition_module)

    @property
    def named_configurations(self) -> NamedConfigurationsModule:
        """Configurations that a person named: `home`, `ready`, `retract`."""
        return self._read("named_configurations_module", _named_configurations_module)

    @property
    def original_meshes(self) -> OriginalMeshesModule:
        """Every mesh that the URDF names, carried unchanged."""
        return self._read("original_meshes_module", _original_meshes_module)

    @property
    def plain_meshes(self) -> PlainMeshesModule:
        """One mesh per link: all its geometry of one kind, with origin, rotation and scale applied and primitives
        tessellated."""
        return self._read("plain_meshes_module", _plain_meshes_module)

    @property
    def convex_hull_meshes(self) -> ConvexHullMeshesModule:
        """The convex hull of each link's plain mesh."""
        return self._read("convex_hull_meshes_module", _convex_hull_meshes_module)

    @property
    def convex_decomposition_meshes(self) -> ConvexDecompositionMeshesModule:
        """Each link's plain mesh as a union of convex pieces."""
        return self._read("convex_decomposition_meshes_module", _convex_decomposition_meshes_module)

    @property
    def link_shapes_approximations(self) -> LinkShapesApproximationsModule:
        """Oriented bounding boxes (OBBs) and bounding spheres of each link and of each convex piece, in the link's
        frame."""
        return self._read("link_shapes_approximations_module", _link_shapes_approximations_module)

    @property
    def link_shapes_max_distance_from_origin(self) -> LinkShapesMaxDistanceFromOriginModule:
        """The largest distance of any point of a shape from the origin of its link's frame, metres."""
        return self._read("link_shapes_max_distance_from_origin_module", _link_shapes_max_distance_from_origin_module)

    @property
    def link_shapes_distance_statistics(self) -> LinkShapesDistanceStatisticsModule:
        """Mean, smallest and largest distance of each pair of shapes over the specification's sampled
        configurations, metres. A distance is 0 where the shapes touch or overlap."""
        return self._read("link_shapes_distance_statistics_module", _link_shapes_distance_statistics_module)

    @property
    def link_shapes_simple_skips(self) -> LinkShapesSimpleSkipsModule:
        """For each pair of shapes, whether the two are always in contact, so that checking them for collision says
        nothing, and the reason of the pair."""
        return self._read("link_shapes_simple_skips_module", _link_shapes_simple_skips_module)

    @property
    def link_shapes_skips(self) -> LinkShapesSkipsModule:
        """The pairs of shapes that a collision check skips: those with one of the skipped reasons, and then a
        person's edits, applied in order."""
        return self._read("link_shapes_skips_module", _link_shapes_skips_module)

    @property
    def self_collision_model(self) -> SelfCollisionModelModule:
        """A network that estimates, for a configuration, how near pairs of links are to each other. It is for
        passing over configurations that are far from any contact. It is an estimate, not a guarantee:
        `evaluation` says how often it is wrong."""
        return self._read("self_collision_model_module", _self_collision_model_module)

    @property
    def link_shapes_spheres(self) -> LinkShapesSpheresModule:
        """Spheres that stand for the convex pieces of links, for programs that check very many configurations."""
        return self._read("link_shapes_spheres_module", _link_shapes_spheres_module)

    @property
    def loops(self) -> LoopsModule:
        """What closes the kinematic loops of a robot, and couplings between its DOFs. The links and joints of the
        other modules are its spanning tree."""
        return self._read("loops_module", _loops_module)


def read_root_metadata(text: str) -> RootMetadata:
    """`urdd.json`."""
    return _root_metadata(json.loads(text))
