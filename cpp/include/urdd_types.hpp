// Types of the documents of a URDD of version 1, over nlohmann-json. Written from `schema/` by
// crates/urdd-format/tests/format/cpp_types.rs. Do not edit.
//
// Members are called as the keys are; those of objects of one key, and the values of enumerations, in lower case. What
// may be null or absent is a std::optional. Keys of extensions and of later minor versions are in `extra`, and are
// written again. Reading is in <urdd/json.hpp>, the text of files in <urdd/text.hpp>. Neither needs the library.

#ifndef URDD_TYPES_HPP
#define URDD_TYPES_HPP

#include "urdd/json.hpp"
#include "urdd/text.hpp"

namespace urdd::types {

struct Generator;
struct FileEntry;
struct UrdfSource;
struct ModuleEntry;
struct RootMetadata;
struct Link;
struct Inertial;
struct Origin;
struct Mass;
struct Inertia;
struct Visual;
struct Mesh;
struct MeshGeometry;
struct Cuboid;
struct BoxGeometry;
struct Cylinder;
struct CylinderGeometry;
struct Capsule;
struct CapsuleGeometry;
struct Sphere;
struct SphereGeometry;
struct Material;
struct Color;
struct Texture;
struct Collision;
struct Joint;
struct LinkName;
struct Axis;
struct Limit;
struct Dynamics;
struct Mimic;
struct SafetyController;
struct Calibration;
struct UrdfModule;
struct ResolvedMimic;
struct Dof;
struct DofModule;
struct LinkInChain;
struct JointInChain;
struct Pose;
struct ChainModule;
struct LinkPath;
struct ConnectionsModule;
struct BoundsModule;
struct KinematicsSample;
struct KinematicsSamplesModule;
struct CompositionBase;
struct CompositionPart;
struct UrddPartSource;
struct UrdfPartSource;
struct PartLink;
struct PartJoint;
struct FrozenJoint;
struct PartAttachment;
struct PartComposition;
struct CompositionModule;
struct NamedConfiguration;
struct DofPosition;
struct NamedConfigurationsModule;
struct MeshReference;
struct OriginalMesh;
struct OriginalMeshesModule;
struct PlainMesh;
struct MeshFiles;
struct PlainMeshesModule;
struct ConvexHullMeshesModule;
struct DecompositionMethod;
struct ConvexDecompositionMeshesModule;
struct Obb;
struct BoundingSphere;
struct LinkShapesApproximationsModule;
struct LinkShapesMaxDistanceFromOriginModule;
struct PieceShape;
struct DistanceStatistics;
struct LinkShapesDistanceStatisticsModule;
struct SkipReasons;
struct LinkShapesSimpleSkipsModule;
struct SkipEdit;
struct LinkShapesSkipsModule;
struct AngleInput;
struct AngleModelInput;
struct LengthInput;
struct LengthModelInput;
struct RotationVectorInput;
struct RotationVectorModelInput;
struct ModelLayer;
struct ModelPair;
struct LinkPair;
struct SampleRange;
struct ModelEvaluation;
struct ModelTestVector;
struct SelfCollisionModelModule;
struct SphereLevel;
struct LinkSphere;
struct SphereFit;
struct SphereEvaluation;
struct LinkShapesSpheresModule;
struct Loop;
struct Coupling;
struct CouplingTerm;
struct ClosedSample;
struct LoopsModule;

/// How much of the specification a URDD carries and fulfils; each class holds those before it.
/// - `Core`: Kinematics: urdf, dof, chain, connections, bounds (and kinematics samples, recommended).
/// - `Geometry`: Core, and the four mesh modules.
/// - `Shapes`: Geometry, and the link shape modules.
enum class ConformanceClass { core, geometry, shapes };

template <> struct detail::Words<ConformanceClass> {
    static constexpr std::array<std::string_view, 3> words{"Core", "Geometry", "Shapes"};
};

/// The program that wrote a URDD.
struct Generator {
    /// Name of the program.
    std::string name;
    /// Its version, in its own numbering.
    std::string version;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("version", self.version);
        visitor.extra(self.extra);
    }
};

/// A file of the directory, with what is needed to see that it is unchanged.
struct FileEntry {
    /// Path relative to the URDD's root, with forward slashes.
    std::string path;
    /// Size in bytes.
    ///
    /// Unit: `byte`.
    std::size_t size{};
    /// SHA-256 of the bytes.
    std::string sha256;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("path", self.path);
        visitor.required("size", self.size);
        visitor.required("sha256", self.sha256);
        visitor.extra(self.extra);
    }
};

/// A URDF, carried verbatim in the URDD's root.
struct UrdfSource {
    FileEntry urdf;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Urdf", self.urdf);
        visitor.extra(self.extra);
    }
};

/// What a URDD was made from: one key, which says of what kind the source is.
using Source = std::variant<UrdfSource>;

/// One module of the directory.
struct ModuleEntry {
    /// Name of the module, such as `dof_module`: the last part of its path.
    std::string name;
    /// Version of the module's format; equal to the module's `VERSION` file.
    std::string version;
    /// Folder of the module, relative to the URDD's root, with forward slashes.
    std::string path;
    /// Names of the modules that this one was derived from.
    std::vector<std::string> depends_on;
    /// Every file of the module, sorted by path (byte order).
    std::vector<FileEntry> files;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("version", self.version);
        visitor.required("path", self.path);
        visitor.required("depends_on", self.depends_on);
        visitor.required("files", self.files);
        visitor.extra(self.extra);
    }
};

/// Root metadata of a URDD (`urdd.json`): names the robot, the specification's version, the source, and every module
/// with its files.
struct RootMetadata {
    /// Version of the URDD specification that this directory follows.
    std::string urdd_version;
    /// Name of the robot; equal to `name` of `urdf_module`.
    std::string robot_name;
    /// The conformance class that the directory claims to fulfil.
    ConformanceClass conformance_class{};
    /// The program that wrote the directory; null when written by hand. Free: not checked.
    std::optional<Generator> generator;
    /// What the directory was made from; null when from nothing that can be named.
    std::optional<Source> source;
    /// Every module, in the order of the specification's table of modules, extensions last.
    std::vector<ModuleEntry> modules;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("urdd_version", self.urdd_version);
        visitor.required("robot_name", self.robot_name);
        visitor.required("conformance_class", self.conformance_class);
        visitor.required("generator", self.generator);
        visitor.required("source", self.source);
        visitor.required("modules", self.modules);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// A pose as the URDF writes it.
struct Origin {
    /// Position, metres: x, y, z.
    ///
    /// Unit: `m`.
    std::optional<std::array<double, 3>> xyz;
    /// Fixed-axis roll, pitch, yaw, radians: turn about x, then y, then z of the outer frame.
    ///
    /// Unit: `rad`.
    std::optional<std::array<double, 3>> rpy;
    /// Rotation as a quaternion x, y, z, w of any length but zero, instead of `rpy`. It counts from URDF version 1.1
    /// on; before, it has no meaning.
    ///
    /// Unit: `1`.
    std::optional<std::array<double, 4>> quat_xyzw;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("xyz", self.xyz);
        visitor.required("rpy", self.rpy);
        visitor.required("quat_xyzw", self.quat_xyzw);
        visitor.extra(self.extra);
    }
};

/// Mass of a link.
struct Mass {
    /// Kilograms.
    ///
    /// Unit: `kg`.
    double value{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("value", self.value);
        visitor.extra(self.extra);
    }
};

/// The six independent elements of a symmetric inertia tensor, kg m².
struct Inertia {
    /// Element xx.
    ///
    /// Unit: `kg*m^2`.
    std::optional<double> ixx;
    /// Element xy.
    ///
    /// Unit: `kg*m^2`.
    std::optional<double> ixy;
    /// Element xz.
    ///
    /// Unit: `kg*m^2`.
    std::optional<double> ixz;
    /// Element yy.
    ///
    /// Unit: `kg*m^2`.
    std::optional<double> iyy;
    /// Element yz.
    ///
    /// Unit: `kg*m^2`.
    std::optional<double> iyz;
    /// Element zz.
    ///
    /// Unit: `kg*m^2`.
    std::optional<double> izz;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("ixx", self.ixx);
        visitor.required("ixy", self.ixy);
        visitor.required("ixz", self.ixz);
        visitor.required("iyy", self.iyy);
        visitor.required("iyz", self.iyz);
        visitor.required("izz", self.izz);
        visitor.extra(self.extra);
    }
};

/// Mass properties of a link.
struct Inertial {
    /// Centre of mass, and the axes of `inertia`, in the link's frame.
    ///
    /// Frame: `link`.
    std::optional<Origin> origin;
    /// Mass.
    std::optional<Mass> mass;
    /// Inertia tensor about the centre of mass, in the axes of `origin`.
    ///
    /// Frame: `inertial`.
    std::optional<Inertia> inertia;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("origin", self.origin);
        visitor.required("mass", self.mass);
        visitor.required("inertia", self.inertia);
        visitor.extra(self.extra);
    }
};

/// A mesh file.
struct Mesh {
    /// File name as the URDF has it (`package://…`, `file://…`, relative or absolute).
    std::string filename;
    /// Factors along x, y, z; null means 1, 1, 1.
    ///
    /// Unit: `1`.
    std::optional<std::array<double, 3>> scale;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("filename", self.filename);
        visitor.required("scale", self.scale);
        visitor.extra(self.extra);
    }
};

/// A mesh file.
struct MeshGeometry {
    Mesh mesh;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Mesh", self.mesh);
        visitor.extra(self.extra);
    }
};

/// A box about the origin.
struct Cuboid {
    /// Full side lengths along x, y, z, metres.
    ///
    /// Unit: `m`.
    std::array<double, 3> size;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("size", self.size);
        visitor.extra(self.extra);
    }
};

/// A box about the origin.
struct BoxGeometry {
    Cuboid box;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Box", self.box);
        visitor.extra(self.extra);
    }
};

/// A cylinder about the origin, along z.
struct Cylinder {
    /// Radius, metres.
    ///
    /// Unit: `m`.
    double radius{};
    /// Full length, metres.
    ///
    /// Unit: `m`.
    double length{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("radius", self.radius);
        visitor.required("length", self.length);
        visitor.extra(self.extra);
    }
};

/// A cylinder about the origin, along z.
struct CylinderGeometry {
    Cylinder cylinder;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Cylinder", self.cylinder);
        visitor.extra(self.extra);
    }
};

/// A capsule about the origin, along z: a cylinder with half a sphere on each end.
struct Capsule {
    /// Radius, metres.
    ///
    /// Unit: `m`.
    double radius{};
    /// Length of the cylinder without the half spheres, metres.
    ///
    /// Unit: `m`.
    double length{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("radius", self.radius);
        visitor.required("length", self.length);
        visitor.extra(self.extra);
    }
};

/// A capsule about the origin, along z.
struct CapsuleGeometry {
    Capsule capsule;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Capsule", self.capsule);
        visitor.extra(self.extra);
    }
};

/// A sphere about the origin.
struct Sphere {
    /// Radius, metres.
    ///
    /// Unit: `m`.
    double radius{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("radius", self.radius);
        visitor.extra(self.extra);
    }
};

/// A sphere about the origin.
struct SphereGeometry {
    Sphere sphere;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Sphere", self.sphere);
        visitor.extra(self.extra);
    }
};

/// A shape: an object of one key, which says of what kind it is.
using Geometry = std::variant<MeshGeometry, BoxGeometry, CylinderGeometry, CapsuleGeometry, SphereGeometry>;

/// A colour.
struct Color {
    /// Red, green, blue, opacity, each from 0 to 1.
    ///
    /// Unit: `1`.
    std::array<double, 4> rgba;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("rgba", self.rgba);
        visitor.extra(self.extra);
    }
};

/// A texture.
struct Texture {
    /// File name as the URDF has it.
    std::string filename;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("filename", self.filename);
        visitor.extra(self.extra);
    }
};

/// A material, or a reference to one by its name.
struct Material {
    /// Name.
    std::optional<std::string> name;
    /// Colour.
    std::optional<Color> color;
    /// Texture.
    std::optional<Texture> texture;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("color", self.color);
        visitor.required("texture", self.texture);
        visitor.extra(self.extra);
    }
};

/// What a link looks like, or a part of it.
struct Visual {
    /// Name of the element.
    std::optional<std::string> name;
    /// Pose of the geometry in the link's frame.
    ///
    /// Frame: `link`.
    std::optional<Origin> origin;
    /// Its shape.
    ///
    /// Frame: `shape`.
    std::optional<Geometry> geometry;
    /// Its material.
    std::optional<Material> material;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("origin", self.origin);
        visitor.required("geometry", self.geometry);
        visitor.required("material", self.material);
        visitor.extra(self.extra);
    }
};

/// What a link collides with, or a part of it.
struct Collision {
    /// Name of the element.
    std::optional<std::string> name;
    /// Pose of the geometry in the link's frame.
    ///
    /// Frame: `link`.
    std::optional<Origin> origin;
    /// Its shape.
    ///
    /// Frame: `shape`.
    std::optional<Geometry> geometry;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("origin", self.origin);
        visitor.required("geometry", self.geometry);
        visitor.extra(self.extra);
    }
};

/// A link: a rigid body.
struct Link {
    /// Name, unique among the links.
    std::string name;
    /// Mass, centre of mass and inertia.
    std::optional<Inertial> inertial;
    /// Visual elements in the order of the file.
    std::vector<Visual> visual;
    /// Collision elements in the order of the file.
    std::vector<Collision> collision;
    /// Other elements directly under `<link>`, each as its own XML text.
    std::vector<std::string> unknown_elements;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("inertial", self.inertial);
        visitor.required("visual", self.visual);
        visitor.required("collision", self.collision);
        visitor.required("unknown_elements", self.unknown_elements);
        visitor.extra(self.extra);
    }
};

/// How a joint moves.
/// - `Revolute`: Turns about its axis, within limits. One DOF, rad.
/// - `Continuous`: Turns about its axis, without limits. One DOF, rad.
/// - `Prismatic`: Slides along its axis. One DOF, m.
/// - `Fixed`: Does not move. No DOF.
/// - `Floating`: Moves freely. Six DOFs: x, y, z (m), then a rotation vector (rad).
/// - `Planar`: Slides in the plane normal to its axis and turns about it. Three DOFs: x, y (m), angle (rad).
/// - `Spherical`: Turns freely. Three DOFs: a rotation vector (rad). Not in URDF's own list; accepted by many readers.
enum class JointType { revolute, continuous, prismatic, fixed, floating, planar, spherical };

template <> struct detail::Words<JointType> {
    static constexpr std::array<std::string_view, 7> words{"Revolute", "Continuous", "Prismatic", "Fixed", "Floating", "Planar", "Spherical"};
};

/// A link, by name.
struct LinkName {
    /// Name of the link.
    std::string link;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link", self.link);
        visitor.extra(self.extra);
    }
};

/// The axis of a joint.
struct Axis {
    /// Direction in the joint's frame, of any length but zero.
    ///
    /// Unit: `1`.
    std::optional<std::array<double, 3>> xyz;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("xyz", self.xyz);
        visitor.extra(self.extra);
    }
};

/// Limits of a joint: rad, rad/s, N m for turning joints; m, m/s, N for sliding ones.
struct Limit {
    /// Smallest position.
    ///
    /// Unit: `rad or m`.
    std::optional<double> lower;
    /// Largest position.
    ///
    /// Unit: `rad or m`.
    std::optional<double> upper;
    /// Largest effort.
    ///
    /// Unit: `N*m or N`.
    std::optional<double> effort;
    /// Largest speed.
    ///
    /// Unit: `rad/s or m/s`.
    std::optional<double> velocity;
    /// Largest acceleration, rad/s² or m/s². This and the next two: from URDF version 1.2 on.
    ///
    /// Unit: `rad/s^2 or m/s^2`.
    std::optional<double> acceleration;
    /// Largest deceleration, rad/s² or m/s²; where it is absent, that of `acceleration`.
    ///
    /// Unit: `rad/s^2 or m/s^2`.
    std::optional<double> deceleration;
    /// Largest rate of change of acceleration, rad/s³ or m/s³.
    ///
    /// Unit: `rad/s^3 or m/s^3`.
    std::optional<double> jerk;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("lower", self.lower);
        visitor.required("upper", self.upper);
        visitor.required("effort", self.effort);
        visitor.required("velocity", self.velocity);
        visitor.required("acceleration", self.acceleration);
        visitor.required("deceleration", self.deceleration);
        visitor.required("jerk", self.jerk);
        visitor.extra(self.extra);
    }
};

/// Dynamics of a joint.
struct Dynamics {
    /// Damping: N m s/rad, or N s/m.
    ///
    /// Unit: `N*m*s/rad or N*s/m`.
    std::optional<double> damping;
    /// Static friction: N m, or N.
    ///
    /// Unit: `N*m or N`.
    std::optional<double> friction;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("damping", self.damping);
        visitor.required("friction", self.friction);
        visitor.extra(self.extra);
    }
};

/// Follows another joint: `position = multiplier * position of joint + offset`.
struct Mimic {
    /// Name of the joint that is followed.
    std::string joint;
    /// Factor; null means 1.
    ///
    /// Unit: `1 or rad/m or m/rad`.
    std::optional<double> multiplier;
    /// Offset, rad or m; null means 0.
    ///
    /// Unit: `rad or m`.
    std::optional<double> offset;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("joint", self.joint);
        visitor.required("multiplier", self.multiplier);
        visitor.required("offset", self.offset);
        visitor.extra(self.extra);
    }
};

/// Soft limits of a joint.
struct SafetyController {
    /// Where the controller begins to limit the position, below.
    ///
    /// Unit: `rad or m`.
    std::optional<double> soft_lower_limit;
    /// Where the controller begins to limit the position, above.
    ///
    /// Unit: `rad or m`.
    std::optional<double> soft_upper_limit;
    /// Relation between position and velocity limits.
    ///
    /// Unit: `1/s`.
    std::optional<double> k_position;
    /// Relation between effort and velocity limits.
    ///
    /// Unit: `N*m*s/rad or N*s/m`.
    std::optional<double> k_velocity;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("soft_lower_limit", self.soft_lower_limit);
        visitor.required("soft_upper_limit", self.soft_upper_limit);
        visitor.required("k_position", self.k_position);
        visitor.required("k_velocity", self.k_velocity);
        visitor.extra(self.extra);
    }
};

/// Reference positions of a joint.
struct Calibration {
    /// Position at which a rising edge is seen.
    ///
    /// Unit: `rad or m`.
    std::optional<double> rising;
    /// Position at which a falling edge is seen.
    ///
    /// Unit: `rad or m`.
    std::optional<double> falling;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("rising", self.rising);
        visitor.required("falling", self.falling);
        visitor.extra(self.extra);
    }
};

/// A joint: how one link moves on another.
struct Joint {
    /// Name, unique among the joints.
    std::string name;
    /// How it moves.
    JointType joint_type{};
    /// Pose of the joint's frame (which is the child link's frame at zero) in the parent link's frame.
    ///
    /// Frame: `parent_link`.
    std::optional<Origin> origin;
    /// The link that carries the joint.
    LinkName parent;
    /// The link that the joint moves.
    LinkName child;
    /// Axis in the joint's frame, as written: not normalised. Null means (1, 0, 0).
    ///
    /// Frame: `joint`.
    std::optional<Axis> axis;
    /// Limits.
    std::optional<Limit> limit;
    /// Damping and friction.
    std::optional<Dynamics> dynamics;
    /// The joint that this one follows.
    std::optional<Mimic> mimic;
    /// Soft limits.
    std::optional<SafetyController> safety_controller;
    /// Reference positions.
    std::optional<Calibration> calibration;
    /// Other elements directly under `<joint>`, each as its own XML text.
    std::vector<std::string> unknown_elements;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("joint_type", self.joint_type);
        visitor.required("origin", self.origin);
        visitor.required("parent", self.parent);
        visitor.required("child", self.child);
        visitor.required("axis", self.axis);
        visitor.required("limit", self.limit);
        visitor.required("dynamics", self.dynamics);
        visitor.required("mimic", self.mimic);
        visitor.required("safety_controller", self.safety_controller);
        visitor.required("calibration", self.calibration);
        visitor.required("unknown_elements", self.unknown_elements);
        visitor.extra(self.extra);
    }
};

/// The source URDF as data. What the URDF leaves out is null (or an empty list), never a default. Lengths are metres,
/// angles radians, masses kilograms; rotations are the URDF's own fixed-axis roll, pitch, yaw. Numbers that are not
/// finite in the URDF are written as null.
struct UrdfModule {
    /// Name of the robot (`<robot name>`).
    std::string name;
    /// The URDF format version that the file states (`<robot version>`).
    std::optional<std::string> version;
    /// Links in the order of the file. The place in this list is the link index.
    ///
    /// Length: `links`.
    std::vector<Link> links;
    /// Joints in the order of the file. The place in this list is the joint index.
    ///
    /// Length: `joints`.
    std::vector<Joint> joints;
    /// Materials declared at the top of the file, in its order.
    std::vector<Material> materials;
    /// Other elements directly under `<robot>` (transmission, gazebo, ros2_control, …), each as its own XML text, in
    /// the order of the file.
    std::vector<std::string> unknown_elements;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"urdf_module"};
    static constexpr const char *module_folder{"urdf_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 0> depends_on{};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("version", self.version);
        visitor.required("links", self.links);
        visitor.required("joints", self.joints);
        visitor.required("materials", self.materials);
        visitor.required("unknown_elements", self.unknown_elements);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// What a mimic joint's position is: `multiplier * q[dof_idx] + offset`.
struct ResolvedMimic {
    /// The DOF that drives the joint; null where the chain of mimics ends in a fixed joint, and the position is
    /// `offset` at all times.
    ///
    /// Index of: `dof`.
    std::optional<std::size_t> dof_idx;
    /// Factor: the product of the factors along the chain of mimics.
    ///
    /// Unit: `1 or rad/m or m/rad`.
    double multiplier{};
    /// Offset, rad or m, accumulated along the chain of mimics.
    ///
    /// Unit: `rad or m`.
    double offset{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("dof_idx", self.dof_idx);
        visitor.required("multiplier", self.multiplier);
        visitor.required("offset", self.offset);
        visitor.extra(self.extra);
    }
};

/// What a DOF measures.
/// - `Angle`: An angle, or a component of a rotation vector: radians.
/// - `Length`: A length: metres.
enum class Quantity { angle, length };

template <> struct detail::Words<Quantity> {
    static constexpr std::array<std::string_view, 2> words{"Angle", "Length"};
};

/// A degree of freedom.
struct Dof {
    /// Name: the joint's name where the joint has one DOF; else that name, a slash, and `trans_x`, `trans_y`,
    /// `trans_z`, `rot_x`, `rot_y`, `rot_z` or (planar) `rot`.
    std::string name;
    /// The joint that it moves.
    ///
    /// Index of: `joint`.
    std::size_t joint_idx{};
    /// Name of that joint.
    std::string joint_name;
    /// What it measures.
    Quantity quantity{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("joint_idx", self.joint_idx);
        visitor.required("joint_name", self.joint_name);
        visitor.required("quantity", self.quantity);
        visitor.extra(self.extra);
    }
};

/// The robot's degrees of freedom (DOFs), in joint order, and the position of every joint as a function of them.
struct DofModule {
    /// Number of DOFs: the length of a configuration vector.
    ///
    /// Unit: `1`.
    std::size_t num_dofs{};
    /// For each DOF, its joint.
    ///
    /// Index of: `joint`. Length: `dofs`.
    std::vector<std::size_t> dof_idx_to_joint_idx_mapping;
    /// For each joint, its DOFs, ascending; empty for fixed and for mimic joints.
    ///
    /// Index of: `dof`. Length: `joints`.
    std::vector<std::vector<std::size_t>> joint_idx_to_dof_idxs_mapping;
    /// For each joint, how it follows a DOF if it is a mimic joint, else null. Chains of mimics are resolved.
    ///
    /// Length: `joints`.
    std::vector<std::optional<ResolvedMimic>> joint_idx_to_mimic_mapping;
    /// What each DOF is.
    ///
    /// Length: `dofs`.
    std::vector<Dof> dofs;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"dof_module"};
    static constexpr const char *module_folder{"dof_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 1> depends_on{"urdf_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("num_dofs", self.num_dofs);
        visitor.required("dof_idx_to_joint_idx_mapping", self.dof_idx_to_joint_idx_mapping);
        visitor.required("joint_idx_to_dof_idxs_mapping", self.joint_idx_to_dof_idxs_mapping);
        visitor.required("joint_idx_to_mimic_mapping", self.joint_idx_to_mimic_mapping);
        visitor.required("dofs", self.dofs);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// A link, with its neighbours.
struct LinkInChain {
    /// Name of the link.
    std::string name;
    /// Its own index: its place in this list.
    ///
    /// Index of: `link`.
    std::size_t link_idx{};
    /// The joint that moves it; null for the root.
    ///
    /// Index of: `joint`.
    std::optional<std::size_t> parent_joint_idx;
    /// The link that this joint sits on; null for the root.
    ///
    /// Index of: `link`.
    std::optional<std::size_t> parent_link_idx;
    /// The joints that sit on this link, ascending.
    ///
    /// Index of: `joint`.
    std::vector<std::size_t> children_joint_idxs;
    /// The links that these joints move, ascending.
    ///
    /// Index of: `link`.
    std::vector<std::size_t> children_link_idxs;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("link_idx", self.link_idx);
        visitor.required("parent_joint_idx", self.parent_joint_idx);
        visitor.required("parent_link_idx", self.parent_link_idx);
        visitor.required("children_joint_idxs", self.children_joint_idxs);
        visitor.required("children_link_idxs", self.children_link_idxs);
        visitor.extra(self.extra);
    }
};

/// A rigid transform: where a frame lies, and how it is turned, seen from another frame. It takes coordinates of the
/// inner frame to the outer one: `p_outer = R * p_inner + position`.
struct Pose {
    /// Origin of the inner frame in the outer frame, metres: x, y, z.
    ///
    /// Unit: `m`.
    std::array<double, 3> position;
    /// Rotation from the inner to the outer frame as a unit quaternion: w, x, y, z, with `w >= 0`.
    ///
    /// Unit: `1`.
    std::array<double, 4> quaternion_wxyz;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("position", self.position);
        visitor.required("quaternion_wxyz", self.quaternion_wxyz);
        visitor.extra(self.extra);
    }
};

/// A joint, with its two links and its motion.
struct JointInChain {
    /// Name of the joint.
    std::string joint_name;
    /// Its own index: its place in this list.
    ///
    /// Index of: `joint`.
    std::size_t joint_idx{};
    /// Name of the link that carries it.
    std::string parent_link_name;
    /// That link.
    ///
    /// Index of: `link`.
    std::size_t parent_link_idx{};
    /// Name of the link that it moves.
    std::string child_link_name;
    /// That link.
    ///
    /// Index of: `link`.
    std::size_t child_link_idx{};
    /// How it moves.
    JointType joint_type{};
    /// Pose of the joint's frame in the parent link's frame. At the zero position the child link's frame is the joint's
    /// frame.
    ///
    /// Frame: `parent_link`.
    Pose origin;
    /// Unit axis in the joint's frame; for a planar joint the plane's normal. Null for fixed, floating and spherical
    /// joints, which have none.
    ///
    /// Unit: `1`. Frame: `joint`.
    std::optional<std::array<double, 3>> axis;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("joint_name", self.joint_name);
        visitor.required("joint_idx", self.joint_idx);
        visitor.required("parent_link_name", self.parent_link_name);
        visitor.required("parent_link_idx", self.parent_link_idx);
        visitor.required("child_link_name", self.child_link_name);
        visitor.required("child_link_idx", self.child_link_idx);
        visitor.required("joint_type", self.joint_type);
        visitor.required("origin", self.origin);
        visitor.required("axis", self.axis);
        visitor.extra(self.extra);
    }
};

/// The kinematic tree: who is whose parent, and where each joint sits and how it moves. With `dof_module`, this is all
/// that forward kinematics needs.
struct ChainModule {
    /// Every link, in link order.
    ///
    /// Length: `links`.
    std::vector<LinkInChain> links_in_chain;
    /// Every joint, in joint order.
    ///
    /// Length: `joints`.
    std::vector<JointInChain> joints_in_chain;
    /// Links by their depth below the root: level 0 is the root alone; each level ascending.
    ///
    /// Index of: `link`.
    std::vector<std::vector<std::size_t>> kinematic_hierarchy;
    /// The one link without a parent.
    ///
    /// Index of: `link`.
    std::size_t root_idx{};
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"chain_module"};
    static constexpr const char *module_folder{"chain_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 1> depends_on{"urdf_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("links_in_chain", self.links_in_chain);
        visitor.required("joints_in_chain", self.joints_in_chain);
        visitor.required("kinematic_hierarchy", self.kinematic_hierarchy);
        visitor.required("root_idx", self.root_idx);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// A path through the kinematic tree.
struct LinkPath {
    /// The links along the path, both ends included.
    ///
    /// Index of: `link`.
    std::vector<std::size_t> links;
    /// The joints between them: one fewer than `links`.
    ///
    /// Index of: `joint`.
    std::vector<std::size_t> joints;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("links", self.links);
        visitor.required("joints", self.joints);
        visitor.extra(self.extra);
    }
};

/// Paths through the kinematic tree. The path from link i to link j climbs from i to their lowest common ancestor and
/// goes down to j, so two slices of `root_paths` give it.
struct ConnectionsModule {
    /// For each link, the path to it from the root.
    ///
    /// Length: `links`.
    std::vector<LinkPath> root_paths;
    /// Element (i, j) is the lowest link that lies above (or is) both i and j.
    ///
    /// Index of: `link`. Length: `links`, each `links`.
    std::vector<std::vector<std::size_t>> lowest_common_ancestors;
    /// Element (i, j) is the path from link i to link j. May be null above 300 links, and where the paths hold more
    /// than 2,000,000 links together.
    ///
    /// Length: `links`, each `links`.
    std::optional<std::vector<std::vector<LinkPath>>> link_to_link_paths;
    /// Element (i, j), where j is a descendant of i: the links from i (exclusive) to j (inclusive); where i is j:
    /// `[i]`; else null. The whole may be null where `link_to_link_paths` may.
    ///
    /// Index of: `link`. Length: `links`, each `links`.
    std::optional<std::vector<std::vector<std::optional<std::vector<std::size_t>>>>> link_connection_paths;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"connections_module"};
    static constexpr const char *module_folder{"connections_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 1> depends_on{"chain_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("root_paths", self.root_paths);
        visitor.required("lowest_common_ancestors", self.lowest_common_ancestors);
        visitor.required("link_to_link_paths", self.link_to_link_paths);
        visitor.required("link_connection_paths", self.link_connection_paths);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// Bounds of the configuration space, per DOF: rad or m as `dofs` of `dof_module` says. Every bound is finite.
struct BoundsModule {
    /// Lower and upper bound of each DOF.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::vector<std::array<double, 2>> bounds;
    /// Lower bound of each DOF: the first elements of `bounds`.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::vector<double> dof_lower_bounds;
    /// Upper bound of each DOF: the second elements of `bounds`.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::vector<double> dof_upper_bounds;
    /// For each DOF, whether the source limits it. A DOF without limits has the bounds [-pi, pi] if it is an angle and
    /// [-1, 1] if it is a length; a rotation vector's norm is at most pi.
    ///
    /// Length: `dofs`.
    std::vector<bool> dof_limited;
    /// For each DOF, the largest speed (rad/s or m/s); null where the source has none.
    ///
    /// Unit: `rad/s or m/s`. Length: `dofs`.
    std::vector<std::optional<double>> dof_velocity_limits;
    /// For each DOF, the largest effort (N m or N); null where the source has none.
    ///
    /// Unit: `N*m or N`. Length: `dofs`.
    std::vector<std::optional<double>> dof_effort_limits;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"bounds_module"};
    static constexpr const char *module_folder{"bounds_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 2> depends_on{"urdf_module", "dof_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("bounds", self.bounds);
        visitor.required("dof_lower_bounds", self.dof_lower_bounds);
        visitor.required("dof_upper_bounds", self.dof_upper_bounds);
        visitor.required("dof_limited", self.dof_limited);
        visitor.required("dof_velocity_limits", self.dof_velocity_limits);
        visitor.required("dof_effort_limits", self.dof_effort_limits);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// A configuration that the specification defines.
/// - `Zero`: Every DOF 0, even where 0 is out of bounds.
/// - `Middle`: Every DOF half-way between its bounds; a rotation vector 0.
/// - `Lower`: Every DOF at its lower bound; a rotation vector (-pi, 0, 0).
/// - `Upper`: Every DOF at its upper bound; a rotation vector (pi, 0, 0).
/// - `Sampled`: Number `sample_idx` of the sequence of sampled configurations.
enum class ConfigurationKind { zero, middle, lower, upper, sampled };

template <> struct detail::Words<ConfigurationKind> {
    static constexpr std::array<std::string_view, 5> words{"Zero", "Middle", "Lower", "Upper", "Sampled"};
};

/// A configuration, and where every link is then.
struct KinematicsSample {
    /// Which configuration it is.
    ConfigurationKind kind{};
    /// The number of a sampled configuration; null for the other kinds.
    ///
    /// Index of: `sample`.
    std::optional<std::size_t> sample_idx;
    /// One value per DOF, rad or m.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::vector<double> configuration;
    /// For each link, its frame's pose in the root link's frame.
    ///
    /// Frame: `root`. Length: `links`.
    std::vector<Pose> link_poses;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("kind", self.kind);
        visitor.required("sample_idx", self.sample_idx);
        visitor.required("configuration", self.configuration);
        visitor.required("link_poses", self.link_poses);
        visitor.extra(self.extra);
    }
};

/// Configurations, and the pose of every link in each: values by which a consumer in any language proves its forward
/// kinematics right.
struct KinematicsSamplesModule {
    /// The samples: zero, middle, lower, upper, then sampled ones in order.
    std::vector<KinematicsSample> samples;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"kinematics_samples_module"};
    static constexpr const char *module_folder{"kinematics_samples_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 3> depends_on{"dof_module", "chain_module", "bounds_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("samples", self.samples);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// A link that carries all parts and belongs to none of them.
struct CompositionBase {
    /// The link.
    ///
    /// Index of: `link or other`.
    std::size_t link_idx{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link_idx", self.link_idx);
        visitor.extra(self.extra);
    }
};

/// A URDD: of its `urdd.json`, which has the hashes of all its files.
struct UrddPartSource {
    /// SHA-256 of a file's bytes, as 64 lower-case hexadecimal digits.
    std::string urdd;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Urdd", self.urdd);
        visitor.extra(self.extra);
    }
};

/// A URDF, or a file that makes one: of the file.
struct UrdfPartSource {
    /// SHA-256 of a file's bytes, as 64 lower-case hexadecimal digits.
    std::string urdf;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Urdf", self.urdf);
        visitor.extra(self.extra);
    }
};

/// The source of a part: the SHA-256 of the file that identifies it.
using PartSource = std::variant<UrddPartSource, UrdfPartSource>;

/// A link of a part.
struct PartLink {
    /// Its name in the part.
    std::string name;
    /// The link of this robot.
    ///
    /// Index of: `link or other`.
    std::size_t link_idx{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("link_idx", self.link_idx);
        visitor.extra(self.extra);
    }
};

/// A joint of a part.
struct PartJoint {
    /// Its name in the part.
    std::string name;
    /// The joint of this robot.
    ///
    /// Index of: `joint or other`.
    std::size_t joint_idx{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("joint_idx", self.joint_idx);
        visitor.extra(self.extra);
    }
};

/// A joint that moved in the part, and is fixed in this robot.
struct FrozenJoint {
    /// The joint.
    ///
    /// Index of: `joint or other`.
    std::size_t joint_idx{};
    /// Where it was made fixed: a value for each DOF that it had, rad or m.
    ///
    /// Unit: `rad or m`.
    std::vector<double> position;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("joint_idx", self.joint_idx);
        visitor.required("position", self.position);
        visitor.extra(self.extra);
    }
};

/// What a part hangs on.
struct PartAttachment {
    /// The part that carries it; null for the base.
    ///
    /// Index of: `part or other`.
    std::optional<std::size_t> part_idx;
    /// The link that carries it.
    ///
    /// Index of: `link or other`.
    std::size_t link_idx{};
    /// The joint between that link and the part's root link.
    ///
    /// Index of: `joint or other`.
    std::size_t joint_idx{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("part_idx", self.part_idx);
        visitor.required("link_idx", self.link_idx);
        visitor.required("joint_idx", self.joint_idx);
        visitor.extra(self.extra);
    }
};

/// How a part itself was combined, as the part's own `composition_module` says. Its indices are those of the part's own
/// modules.
struct PartComposition {
    /// The link that carries all parts and belongs to none of them; null where a part is the root.
    std::optional<CompositionBase> base;
    /// The parts.
    std::vector<CompositionPart> parts;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("base", self.base);
        visitor.required("parts", self.parts);
        visitor.extra(self.extra);
    }
};

/// A robot that became a part of another.
struct CompositionPart {
    /// By what name the recipe knows it; unique among the parts.
    std::string id;
    /// Name of the robot that the part was.
    std::string name;
    /// What it was taken from, with a digest.
    PartSource source;
    /// What stands before the part's names of links and joints in this robot; empty for nothing.
    std::string prefix;
    /// The part's links that are in this robot, in link order.
    std::vector<PartLink> links;
    /// The part's joints that are in this robot, in joint order.
    std::vector<PartJoint> joints;
    /// Names of the part's links that were left out, in the part's order.
    std::vector<std::string> dropped_links;
    /// Names of the part's joints that were left out, in the part's order.
    std::vector<std::string> dropped_joints;
    /// The part's joints that were made fixed, in joint order.
    std::vector<FrozenJoint> frozen_joints;
    /// What it hangs on; null for the part that is the root.
    std::optional<PartAttachment> attachment;
    /// How the part itself was combined; null where it was not combined, or where this is not known.
    std::optional<PartComposition> composition;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("id", self.id);
        visitor.required("name", self.name);
        visitor.required("source", self.source);
        visitor.required("prefix", self.prefix);
        visitor.required("links", self.links);
        visitor.required("joints", self.joints);
        visitor.required("dropped_links", self.dropped_links);
        visitor.required("dropped_joints", self.dropped_joints);
        visitor.required("frozen_joints", self.frozen_joints);
        visitor.required("attachment", self.attachment);
        visitor.required("composition", self.composition);
        visitor.extra(self.extra);
    }
};

/// How this robot was combined from others, its parts. The robot itself is defined by the URDF that the URDD carries;
/// this module says which part each of its links and joints came from.
struct CompositionModule {
    /// The link that carries all parts and belongs to none of them; null where a part is the root.
    std::optional<CompositionBase> base;
    /// The parts, in the order in which they stand in the URDF. The place in this list is the part's index.
    ///
    /// Length: `parts`.
    std::vector<CompositionPart> parts;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"composition_module"};
    static constexpr const char *module_folder{"composition_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 1> depends_on{"urdf_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("base", self.base);
        visitor.required("parts", self.parts);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// The position of a DOF.
struct DofPosition {
    /// Name of the DOF, as in `dofs` of `dof_module`.
    std::string dof_name;
    /// Its position, rad or m.
    ///
    /// Unit: `rad or m`.
    double position{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("dof_name", self.dof_name);
        visitor.required("position", self.position);
        visitor.extra(self.extra);
    }
};

/// A configuration that a person named.
struct NamedConfiguration {
    /// Its name; unique in the module, and not empty.
    std::string name;
    /// The positions that the person set, in DOF order. What a person decides is free; the names must exist.
    std::vector<DofPosition> positions;
    /// What follows: one value per DOF, rad or m. A DOF without an entry in `positions` has its value in the default
    /// configuration.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::vector<double> configuration;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("positions", self.positions);
        visitor.required("configuration", self.configuration);
        visitor.extra(self.extra);
    }
};

/// Configurations that a person named: `home`, `ready`, `retract`.
struct NamedConfigurationsModule {
    /// The configurations, in the order in which the person added them.
    std::vector<NamedConfiguration> configurations;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"named_configurations_module"};
    static constexpr const char *module_folder{"named_configurations_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 2> depends_on{"dof_module", "bounds_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("configurations", self.configurations);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// Which of a link's two geometries a mesh was made from.
/// - `Visual`: The `visual` elements.
/// - `Collision`: The `collision` elements.
enum class GeometryKind { visual, collision };

template <> struct detail::Words<GeometryKind> {
    static constexpr std::array<std::string_view, 2> words{"Visual", "Collision"};
};

/// A place in the URDF that names a mesh.
struct MeshReference {
    /// The link.
    ///
    /// Index of: `link`.
    std::size_t link_idx{};
    /// Whether a visual or a collision element names it.
    GeometryKind geometry{};
    /// Which of the link's elements of that kind.
    ///
    /// Index of: `visual or collision`.
    std::size_t element_idx{};
    /// File name as the URDF has it.
    std::string filename;
    /// The carried file, relative to the URDD's root; null where the mesh could not be found.
    std::optional<std::string> path;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link_idx", self.link_idx);
        visitor.required("geometry", self.geometry);
        visitor.required("element_idx", self.element_idx);
        visitor.required("filename", self.filename);
        visitor.required("path", self.path);
        visitor.extra(self.extra);
    }
};

/// A carried mesh file.
struct OriginalMesh {
    /// Path relative to the URDD's root, with forward slashes.
    std::string path;
    /// Files that the mesh names in turn (`.mtl`, `.bin`, textures), relative to the URDD's root, sorted. They lie
    /// where the mesh expects them.
    std::vector<std::string> side_files;
    /// Whether the file can be read as a mesh, and has a triangle with an area. Where not, elements that name it have
    /// no surface.
    bool usable{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("path", self.path);
        visitor.required("side_files", self.side_files);
        visitor.required("usable", self.usable);
        visitor.extra(self.extra);
    }
};

/// Every mesh that the URDF names, carried unchanged.
struct OriginalMeshesModule {
    /// Every mesh reference of the URDF: links in order, visual before collision, elements in order.
    std::vector<MeshReference> references;
    /// Every carried mesh file once, sorted by path (byte order).
    std::vector<OriginalMesh> files;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"original_meshes_module"};
    static constexpr const char *module_folder{"mesh_modules/original_meshes_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 1> depends_on{"urdf_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("references", self.references);
        visitor.required("files", self.files);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// One mesh in up to three formats, the same triangles in each: vertices in metres, in the link's frame, binary32.
/// Paths are relative to the URDD's root, with forward slashes.
struct MeshFiles {
    /// Binary STL; null where the module has none.
    std::optional<std::string> stl;
    /// Wavefront OBJ; null where the module has none.
    std::optional<std::string> obj;
    /// Binary glTF 2.0, no node with a transform, vertices in link axes, with the source's colours.
    std::string glb;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("stl", self.stl);
        visitor.required("obj", self.obj);
        visitor.required("glb", self.glb);
        visitor.extra(self.extra);
    }
};

/// The mesh of a link.
struct PlainMesh {
    /// Which geometry it was made from.
    GeometryKind geometry{};
    /// Its files.
    MeshFiles files;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("geometry", self.geometry);
        visitor.required("files", self.files);
        visitor.extra(self.extra);
    }
};

/// One mesh per link: all its geometry of one kind, with origin, rotation and scale applied and primitives tessellated.
struct PlainMeshesModule {
    /// Which geometry is preferred; the other is used for a link that has none of it.
    GeometryKind preferred_geometry{};
    /// For each link its mesh, or null for a link without geometry.
    ///
    /// Length: `links`.
    std::vector<std::optional<PlainMesh>> link_meshes;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"plain_meshes_module"};
    static constexpr const char *module_folder{"mesh_modules/plain_meshes_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 2> depends_on{"urdf_module", "original_meshes_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("preferred_geometry", self.preferred_geometry);
        visitor.required("link_meshes", self.link_meshes);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// The convex hull of each link's plain mesh.
struct ConvexHullMeshesModule {
    /// For each link its hull, or null for a link without a plain mesh.
    ///
    /// Length: `links`.
    std::vector<std::optional<MeshFiles>> link_hulls;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"convex_hull_meshes_module"};
    static constexpr const char *module_folder{"mesh_modules/convex_hull_meshes_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 1> depends_on{"plain_meshes_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link_hulls", self.link_hulls);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// How convex pieces were made.
struct DecompositionMethod {
    /// Name of the algorithm.
    std::string name;
    /// How far a point of the link's surface may lie outside the pieces, metres, where the algorithm promises that;
    /// else null.
    ///
    /// Unit: `m`.
    std::optional<double> surface_tolerance;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("surface_tolerance", self.surface_tolerance);
        visitor.extra(self.extra);
    }
};

/// Each link's plain mesh as a union of convex pieces.
struct ConvexDecompositionMeshesModule {
    /// How the pieces were made. Any method may be used, as long as `surface_tolerance` holds (7.10).
    DecompositionMethod method;
    /// For each link its pieces; empty for a link without a plain mesh. The place in the list is the piece index.
    ///
    /// Length: `links`, each `pieces`.
    std::vector<std::vector<MeshFiles>> link_pieces;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"convex_decomposition_meshes_module"};
    static constexpr const char *module_folder{"mesh_modules/convex_decomposition_meshes_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 1> depends_on{"plain_meshes_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("method", self.method);
        visitor.required("link_pieces", self.link_pieces);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// An oriented bounding box.
struct Obb {
    /// Half of each side length, metres, along the box's own axes.
    ///
    /// Unit: `m`. Frame: `shape`.
    std::array<double, 3> half_extents;
    /// Centre in the link's frame, metres.
    ///
    /// Unit: `m`. Frame: `link`.
    std::array<double, 3> offset_xyz;
    /// Rotation from the box's axes to the link's: fixed-axis roll, pitch, yaw, radians.
    ///
    /// Unit: `rad`. Frame: `link`.
    std::array<double, 3> offset_rpy;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("half_extents", self.half_extents);
        visitor.required("offset_xyz", self.offset_xyz);
        visitor.required("offset_rpy", self.offset_rpy);
        visitor.extra(self.extra);
    }
};

/// A bounding sphere.
struct BoundingSphere {
    /// Radius, metres.
    ///
    /// Unit: `m`.
    double radius{};
    /// Centre in the link's frame, metres.
    ///
    /// Unit: `m`. Frame: `link`.
    std::array<double, 3> offset_xyz;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("radius", self.radius);
        visitor.required("offset_xyz", self.offset_xyz);
        visitor.extra(self.extra);
    }
};

/// Oriented bounding boxes (OBBs) and bounding spheres of each link and of each convex piece, in the link's frame.
struct LinkShapesApproximationsModule {
    /// For each link, a box that holds its hull; null for a link without a mesh.
    ///
    /// Length: `links`.
    std::vector<std::optional<Obb>> full_obbs;
    /// For each link, a sphere that holds its hull; null for a link without a mesh.
    ///
    /// Length: `links`.
    std::vector<std::optional<BoundingSphere>> full_bounding_spheres;
    /// For each link, a box for each convex piece.
    ///
    /// Length: `links`, each `pieces`.
    std::vector<std::vector<Obb>> decomposition_obbs;
    /// For each link, a sphere for each convex piece.
    ///
    /// Length: `links`, each `pieces`.
    std::vector<std::vector<BoundingSphere>> decomposition_bounding_spheres;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"link_shapes_approximations_module"};
    static constexpr const char *module_folder{"link_shapes_modules/link_shapes_approximations_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 2> depends_on{"convex_hull_meshes_module", "convex_decomposition_meshes_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("full_obbs", self.full_obbs);
        visitor.required("full_bounding_spheres", self.full_bounding_spheres);
        visitor.required("decomposition_obbs", self.decomposition_obbs);
        visitor.required("decomposition_bounding_spheres", self.decomposition_bounding_spheres);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// The largest distance of any point of a shape from the origin of its link's frame, metres.
struct LinkShapesMaxDistanceFromOriginModule {
    /// For each link, of its convex hull; null for a link without one.
    ///
    /// Unit: `m`. Length: `links`.
    std::vector<std::optional<double>> full_convex_hulls_maximum_distances;
    /// For each link, of its box; null for a link without one.
    ///
    /// Unit: `m`. Length: `links`.
    std::vector<std::optional<double>> full_obbs_maximum_distances;
    /// For each link, of its sphere; null for a link without one.
    ///
    /// Unit: `m`. Length: `links`.
    std::vector<std::optional<double>> full_bounding_spheres_maximum_distances;
    /// For each link, of each convex piece.
    ///
    /// Unit: `m`. Length: `links`, each `pieces`.
    std::vector<std::vector<double>> decomposition_convex_hulls_maximum_distances;
    /// For each link, of the box of each convex piece.
    ///
    /// Unit: `m`. Length: `links`, each `pieces`.
    std::vector<std::vector<double>> decomposition_obbs_maximum_distances;
    /// For each link, of the sphere of each convex piece.
    ///
    /// Unit: `m`. Length: `links`, each `pieces`.
    std::vector<std::vector<double>> decomposition_bounding_spheres_maximum_distances;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"link_shapes_max_distance_from_origin_module"};
    static constexpr const char *module_folder{"link_shapes_modules/link_shapes_max_distance_from_origin_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 3> depends_on{"convex_hull_meshes_module", "convex_decomposition_meshes_module", "link_shapes_approximations_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("full_convex_hulls_maximum_distances", self.full_convex_hulls_maximum_distances);
        visitor.required("full_obbs_maximum_distances", self.full_obbs_maximum_distances);
        visitor.required("full_bounding_spheres_maximum_distances", self.full_bounding_spheres_maximum_distances);
        visitor.required("decomposition_convex_hulls_maximum_distances", self.decomposition_convex_hulls_maximum_distances);
        visitor.required("decomposition_obbs_maximum_distances", self.decomposition_obbs_maximum_distances);
        visitor.required("decomposition_bounding_spheres_maximum_distances", self.decomposition_bounding_spheres_maximum_distances);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// A convex piece of a link.
struct PieceShape {
    /// The link.
    ///
    /// Index of: `link`.
    std::size_t link_idx{};
    /// The piece, as in `link_pieces` of `convex_decomposition_meshes_module`.
    ///
    /// Index of: `piece`.
    std::size_t piece_idx{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link_idx", self.link_idx);
        visitor.required("piece_idx", self.piece_idx);
        visitor.extra(self.extra);
    }
};

/// Square symmetric matrices over one list of shapes, metres.
struct DistanceStatistics {
    /// Mean distance of each pair.
    ///
    /// Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or decomposition_shapes`.
    std::vector<std::vector<double>> mean_distances;
    /// Smallest distance of each pair.
    ///
    /// Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or decomposition_shapes`.
    std::vector<std::vector<double>> min_distances;
    /// Largest distance of each pair.
    ///
    /// Unit: `m`. Length: `full_shapes or decomposition_shapes`, each `full_shapes or decomposition_shapes`.
    std::vector<std::vector<double>> max_distances;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("mean_distances", self.mean_distances);
        visitor.required("min_distances", self.min_distances);
        visitor.required("max_distances", self.max_distances);
        visitor.extra(self.extra);
    }
};

/// Mean, smallest and largest distance of each pair of shapes over the specification's sampled configurations, metres.
/// A distance is 0 where the shapes touch or overlap.
struct LinkShapesDistanceStatisticsModule {
    /// Number of sampled configurations, from the first of the specification's sequence.
    ///
    /// Unit: `1`.
    std::size_t num_samples{};
    /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
    ///
    /// Index of: `link`. Length: `full_shapes`.
    std::vector<std::size_t> full_shapes;
    /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
    ///
    /// Length: `decomposition_shapes`.
    std::vector<PieceShape> decomposition_shapes;
    /// Between the links' convex hulls.
    DistanceStatistics full_convex_hulls;
    /// Between the links' boxes.
    DistanceStatistics full_obbs;
    /// Between the links' spheres.
    DistanceStatistics full_bounding_spheres;
    /// Between convex pieces; null above 500 pieces, unless asked for.
    std::optional<DistanceStatistics> decomposition_convex_hulls;
    /// Between the boxes of convex pieces; null above 500 pieces, unless asked for.
    std::optional<DistanceStatistics> decomposition_obbs;
    /// Between the spheres of convex pieces; null above 500 pieces, unless asked for.
    std::optional<DistanceStatistics> decomposition_bounding_spheres;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"link_shapes_distance_statistics_module"};
    static constexpr const char *module_folder{"link_shapes_modules/link_shapes_distance_statistics_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 6> depends_on{"dof_module", "chain_module", "bounds_module", "convex_hull_meshes_module", "convex_decomposition_meshes_module", "link_shapes_approximations_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("num_samples", self.num_samples);
        visitor.required("full_shapes", self.full_shapes);
        visitor.required("decomposition_shapes", self.decomposition_shapes);
        visitor.required("full_convex_hulls", self.full_convex_hulls);
        visitor.required("full_obbs", self.full_obbs);
        visitor.required("full_bounding_spheres", self.full_bounding_spheres);
        visitor.required("decomposition_convex_hulls", self.decomposition_convex_hulls);
        visitor.required("decomposition_obbs", self.decomposition_obbs);
        visitor.required("decomposition_bounding_spheres", self.decomposition_bounding_spheres);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// The reason of a pair of shapes: the first of these that applies.
/// - `SameLink`: Both shapes are on one link. A simple skip.
/// - `Always`: The largest sampled distance is at most 0.001 m: always in contact. A simple skip.
/// - `Adjacent`: A joint connects the two links. Not a simple skip.
/// - `Default`: The distance in the default configuration is at most 0.001 m: in contact when the robot stands still at
/// zero. Not a simple skip.
/// - `Never`: The smallest sampled distance is more than 0.001 m: never in contact, as far as the samples show. Not a
/// simple skip.
/// - `None`: None of these: in contact in some of the sampled configurations and not in others.
enum class SkipReason { same_link, always, adjacent, default_, never, none };

template <> struct detail::Words<SkipReason> {
    static constexpr std::array<std::string_view, 6> words{"SameLink", "Always", "Adjacent", "Default", "Never", "None"};
};

/// The reason of each pair, for each kind of shape.
struct SkipReasons {
    /// Between the links' convex hulls.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<SkipReason>> full_convex_hulls;
    /// Between the links' boxes.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<SkipReason>> full_obbs;
    /// Between the links' spheres.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<SkipReason>> full_bounding_spheres;
    /// Between convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<SkipReason>>> decomposition_convex_hulls;
    /// Between the boxes of convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<SkipReason>>> decomposition_obbs;
    /// Between the spheres of convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<SkipReason>>> decomposition_bounding_spheres;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("full_convex_hulls", self.full_convex_hulls);
        visitor.required("full_obbs", self.full_obbs);
        visitor.required("full_bounding_spheres", self.full_bounding_spheres);
        visitor.required("decomposition_convex_hulls", self.decomposition_convex_hulls);
        visitor.required("decomposition_obbs", self.decomposition_obbs);
        visitor.required("decomposition_bounding_spheres", self.decomposition_bounding_spheres);
        visitor.extra(self.extra);
    }
};

/// For each pair of shapes, whether the two are always in contact, so that checking them for collision says nothing,
/// and the reason of the pair.
struct LinkShapesSimpleSkipsModule {
    /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
    ///
    /// Index of: `link`. Length: `full_shapes`.
    std::vector<std::size_t> full_shapes;
    /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
    ///
    /// Length: `decomposition_shapes`.
    std::vector<PieceShape> decomposition_shapes;
    /// Skips between the links' convex hulls: true where both shapes are on one link, or where the largest sampled
    /// distance is at most 0.001 m.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<bool>> full_convex_hulls_simple_skips;
    /// Skips between the links' boxes.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<bool>> full_obbs_simple_skips;
    /// Skips between the links' spheres.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<bool>> full_bounding_spheres_simple_skips;
    /// Skips between convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<bool>>> decomposition_convex_hulls_simple_skips;
    /// Skips between the boxes of convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<bool>>> decomposition_obbs_simple_skips;
    /// Skips between the spheres of convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<bool>>> decomposition_bounding_spheres_simple_skips;
    /// The reason of each pair, for each of the matrices above.
    SkipReasons reasons;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"link_shapes_simple_skips_module"};
    static constexpr const char *module_folder{"link_shapes_modules/link_shapes_simple_skips_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 7> depends_on{"dof_module", "chain_module", "bounds_module", "convex_hull_meshes_module", "convex_decomposition_meshes_module", "link_shapes_approximations_module", "link_shapes_distance_statistics_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("full_shapes", self.full_shapes);
        visitor.required("decomposition_shapes", self.decomposition_shapes);
        visitor.required("full_convex_hulls_simple_skips", self.full_convex_hulls_simple_skips);
        visitor.required("full_obbs_simple_skips", self.full_obbs_simple_skips);
        visitor.required("full_bounding_spheres_simple_skips", self.full_bounding_spheres_simple_skips);
        visitor.required("decomposition_convex_hulls_simple_skips", self.decomposition_convex_hulls_simple_skips);
        visitor.required("decomposition_obbs_simple_skips", self.decomposition_obbs_simple_skips);
        visitor.required("decomposition_bounding_spheres_simple_skips", self.decomposition_bounding_spheres_simple_skips);
        visitor.required("reasons", self.reasons);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// A reason of `link_shapes_simple_skips_module` for which pairs can be skipped: all but `None`.
/// - `SameLink`: Both shapes are on one link.
/// - `Always`: Always in contact, as far as the samples show.
/// - `Adjacent`: A joint connects the two links.
/// - `Default`: In contact in the default configuration.
/// - `Never`: Never in contact, as far as the samples show: the number of samples is `num_samples` of
/// `link_shapes_distance_statistics_module`.
enum class SkippedReason { same_link, always, adjacent, default_, never };

template <> struct detail::Words<SkippedReason> {
    static constexpr std::array<std::string_view, 5> words{"SameLink", "Always", "Adjacent", "Default", "Never"};
};

/// A person's decision on a pair of links, for all their shapes of every kind.
struct SkipEdit {
    /// Name of one link.
    std::string link_a;
    /// Name of the other link; may be the same.
    std::string link_b;
    /// Whether checks between the two are skipped.
    bool skip{};
    /// Why.
    std::string reason;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link_a", self.link_a);
        visitor.required("link_b", self.link_b);
        visitor.required("skip", self.skip);
        visitor.required("reason", self.reason);
        visitor.extra(self.extra);
    }
};

/// The pairs of shapes that a collision check skips: those with one of the skipped reasons, and then a person's edits,
/// applied in order.
struct LinkShapesSkipsModule {
    /// The reasons of `link_shapes_simple_skips_module` for which a pair is skipped, each once, in the order of the
    /// specification.
    std::vector<SkippedReason> skipped_reasons;
    /// The edits, applied in order. What a person decides is free; the names must exist.
    std::vector<SkipEdit> edits;
    /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
    ///
    /// Index of: `link`. Length: `full_shapes`.
    std::vector<std::size_t> full_shapes;
    /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
    ///
    /// Length: `decomposition_shapes`.
    std::vector<PieceShape> decomposition_shapes;
    /// Skips between the links' convex hulls.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<bool>> full_convex_hulls_skips;
    /// Skips between the links' boxes.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<bool>> full_obbs_skips;
    /// Skips between the links' spheres.
    ///
    /// Length: `full_shapes`, each `full_shapes`.
    std::vector<std::vector<bool>> full_bounding_spheres_skips;
    /// Skips between convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<bool>>> decomposition_convex_hulls_skips;
    /// Skips between the boxes of convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<bool>>> decomposition_obbs_skips;
    /// Skips between the spheres of convex pieces; null where the statistics are.
    ///
    /// Length: `decomposition_shapes`, each `decomposition_shapes`.
    std::optional<std::vector<std::vector<bool>>> decomposition_bounding_spheres_skips;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"link_shapes_skips_module"};
    static constexpr const char *module_folder{"link_shapes_modules/link_shapes_skips_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 2> depends_on{"urdf_module", "link_shapes_simple_skips_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("skipped_reasons", self.skipped_reasons);
        visitor.required("edits", self.edits);
        visitor.required("full_shapes", self.full_shapes);
        visitor.required("decomposition_shapes", self.decomposition_shapes);
        visitor.required("full_convex_hulls_skips", self.full_convex_hulls_skips);
        visitor.required("full_obbs_skips", self.full_obbs_skips);
        visitor.required("full_bounding_spheres_skips", self.full_bounding_spheres_skips);
        visitor.required("decomposition_convex_hulls_skips", self.decomposition_convex_hulls_skips);
        visitor.required("decomposition_obbs_skips", self.decomposition_obbs_skips);
        visitor.required("decomposition_bounding_spheres_skips", self.decomposition_bounding_spheres_skips);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// An angle.
struct AngleInput {
    /// The DOF, which is an angle.
    ///
    /// Index of: `dof`.
    std::size_t dof_idx{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("dof_idx", self.dof_idx);
        visitor.extra(self.extra);
    }
};

/// Four numbers of an angle q: sin q, cos q, sin 2q, cos 2q.
struct AngleModelInput {
    AngleInput angle;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Angle", self.angle);
        visitor.extra(self.extra);
    }
};

/// A length.
struct LengthInput {
    /// The DOF, which is a length.
    ///
    /// Index of: `dof`.
    std::size_t dof_idx{};
    /// What becomes 0, metres.
    ///
    /// Unit: `m`.
    double middle{};
    /// How far from that is 1, metres; positive.
    ///
    /// Unit: `m`.
    double half_range{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("dof_idx", self.dof_idx);
        visitor.required("middle", self.middle);
        visitor.required("half_range", self.half_range);
        visitor.extra(self.extra);
    }
};

/// One number of a length q: (q - middle) / half_range.
struct LengthModelInput {
    LengthInput length;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("Length", self.length);
        visitor.extra(self.extra);
    }
};

/// A rotation vector.
struct RotationVectorInput {
    /// Its three DOFs.
    ///
    /// Index of: `dof`.
    std::array<std::size_t, 3> dof_idxs;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("dof_idxs", self.dof_idxs);
        visitor.extra(self.extra);
    }
};

/// Nine numbers of a rotation vector: its rotation matrix, row by row.
struct RotationVectorModelInput {
    RotationVectorInput rotation_vector;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("RotationVector", self.rotation_vector);
        visitor.extra(self.extra);
    }
};

/// Something that the network is told of a configuration.
using ModelInput = std::variant<AngleModelInput, LengthModelInput, RotationVectorModelInput>;

/// A layer of a network: its values are `weights` times the values before, plus `biases`.
struct ModelLayer {
    /// One row for each value of the layer, with one number for each value before it.
    ///
    /// Unit: `1 or m`.
    std::vector<std::vector<double>> weights;
    /// One number for each value of the layer.
    ///
    /// Unit: `1 or m`.
    std::vector<double> biases;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("weights", self.weights);
        visitor.required("biases", self.biases);
        visitor.extra(self.extra);
    }
};

/// A pair of links that the network has an output for.
struct ModelPair {
    /// One link.
    ///
    /// Index of: `link`.
    std::size_t link_a_idx{};
    /// The other, of a higher index.
    ///
    /// Index of: `link`.
    std::size_t link_b_idx{};
    /// The clearance of the pair is the network's output less this, metres. A clearance of 0 or less means that the
    /// pair may be in contact.
    ///
    /// Unit: `m`.
    double margin{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link_a_idx", self.link_a_idx);
        visitor.required("link_b_idx", self.link_b_idx);
        visitor.required("margin", self.margin);
        visitor.extra(self.extra);
    }
};

/// A pair of links.
struct LinkPair {
    /// One link.
    ///
    /// Index of: `link`.
    std::size_t link_a_idx{};
    /// The other, of a higher index.
    ///
    /// Index of: `link`.
    std::size_t link_b_idx{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("link_a_idx", self.link_a_idx);
        visitor.required("link_b_idx", self.link_b_idx);
        visitor.extra(self.extra);
    }
};

/// Sampled configurations (SPEC 9.3) that follow each other.
struct SampleRange {
    /// The first.
    ///
    /// Index of: `sample`.
    std::size_t first_sample_idx{};
    /// How many.
    ///
    /// Unit: `1`.
    std::size_t num_configurations{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("first_sample_idx", self.first_sample_idx);
        visitor.required("num_configurations", self.num_configurations);
        visitor.extra(self.extra);
    }
};

/// How often the model is right on the sampled configurations 2^31 to 2^31 + 49,999, which have no part in making any
/// model. A configuration is in collision where a pair of links in `pairs` or `other_pairs` is in contact, and free
/// otherwise. The model clears a configuration where every clearance is above 0.
struct ModelEvaluation {
    /// Number of configurations in collision.
    ///
    /// Unit: `1`.
    std::size_t num_colliding{};
    /// Number of these that the model clears: the misses.
    ///
    /// Unit: `1`.
    std::size_t num_missed{};
    /// Number of configurations in collision that are near contact: a step of at most 0.05 rad or 0.05 m in each DOF
    /// makes them free (SPEC 8.8.10).
    ///
    /// Unit: `1`.
    std::size_t num_near_contact{};
    /// Number of these that the model clears.
    ///
    /// Unit: `1`.
    std::size_t num_near_contact_missed{};
    /// Number of free configurations.
    ///
    /// Unit: `1`.
    std::size_t num_free{};
    /// Number of these that the model clears.
    ///
    /// Unit: `1`.
    std::size_t num_cleared{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("num_colliding", self.num_colliding);
        visitor.required("num_missed", self.num_missed);
        visitor.required("num_near_contact", self.num_near_contact);
        visitor.required("num_near_contact_missed", self.num_near_contact_missed);
        visitor.required("num_free", self.num_free);
        visitor.required("num_cleared", self.num_cleared);
        visitor.extra(self.extra);
    }
};

/// What the model gives in a configuration.
struct ModelTestVector {
    /// One value for each DOF, rad or m.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::vector<double> configuration;
    /// One clearance for each entry of `pairs`, metres.
    ///
    /// Unit: `m`. Length: `pairs`.
    std::vector<double> clearances;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("configuration", self.configuration);
        visitor.required("clearances", self.clearances);
        visitor.extra(self.extra);
    }
};

/// A network that estimates, for a configuration, how near pairs of links are to each other. It is for passing over
/// configurations that are far from any contact. It is an estimate, not a guarantee: `evaluation` says how often it is
/// wrong.
struct SelfCollisionModelModule {
    /// Of the shapes and the kinematics that it was trained on: SHA-256 of the text that SPEC 8.8.7 defines.
    std::string trained_on;
    /// Distances from here on were all the same to it, metres.
    ///
    /// Unit: `m`.
    double clip_distance{};
    /// What the network is told of a configuration, in the order of its first layer's columns.
    std::vector<ModelInput> inputs;
    /// The layers of the network, the first one first. After each but the last, every value is replaced by its
    /// hyperbolic tangent.
    std::vector<ModelLayer> layers;
    /// The pairs of links that the network has an output for, in that order.
    ///
    /// Length: `pairs`.
    std::vector<ModelPair> pairs;
    /// The pairs of links that are not skipped and have no output: they were never near in training.
    std::vector<LinkPair> other_pairs;
    /// The sampled configurations (SPEC 9.3) that it was trained on.
    SampleRange training;
    /// The sampled configurations that decided when training ended and what the margins are.
    SampleRange calibration;
    /// How often it is right on the sampled configurations that SPEC 8.8.9 fixes.
    ModelEvaluation evaluation;
    /// What it gives in some configurations.
    std::vector<ModelTestVector> test_vectors;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"self_collision_model_module"};
    static constexpr const char *module_folder{"link_shapes_modules/self_collision_model_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 5> depends_on{"dof_module", "chain_module", "bounds_module", "convex_decomposition_meshes_module", "link_shapes_skips_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("trained_on", self.trained_on);
        visitor.required("clip_distance", self.clip_distance);
        visitor.required("inputs", self.inputs);
        visitor.required("layers", self.layers);
        visitor.required("pairs", self.pairs);
        visitor.required("other_pairs", self.other_pairs);
        visitor.required("training", self.training);
        visitor.required("calibration", self.calibration);
        visitor.required("evaluation", self.evaluation);
        visitor.required("test_vectors", self.test_vectors);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// Where the spheres of a level are from.
/// - `Computed`: A program made them from the pieces.
/// - `Given`: A person gave them. A producer that makes the module again keeps them.
enum class SphereOrigin { computed, given };

template <> struct detail::Words<SphereOrigin> {
    static constexpr std::array<std::string_view, 2> words{"Computed", "Given"};
};

/// A sphere of a link.
struct LinkSphere {
    /// Radius, metres.
    ///
    /// Unit: `m`.
    double radius{};
    /// Centre in the link's frame, metres.
    ///
    /// Unit: `m`. Frame: `link`.
    std::array<double, 3> offset_xyz;
    /// The sphere of the same link in the outer level that this one is inside of; null in the first level.
    ///
    /// Index of: `other`.
    std::optional<std::size_t> outer_sphere_idx;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("radius", self.radius);
        visitor.required("offset_xyz", self.offset_xyz);
        visitor.required("outer_sphere_idx", self.outer_sphere_idx);
        visitor.extra(self.extra);
    }
};

/// How far the spheres of a link are from its pieces, by the points of SPEC 8.9.5.
struct SphereFit {
    /// The largest distance of a point on the spheres from the pieces, metres.
    ///
    /// Unit: `m`.
    double max_standoff{};
    /// The mean distance of points on the spheres from the pieces, metres.
    ///
    /// Unit: `m`.
    double mean_standoff{};
    /// The part of the surface of the pieces that is outside of all spheres, from 0 to 1.
    ///
    /// Unit: `1`.
    double uncovered_fraction{};
    /// The largest distance of a point of that surface from the spheres, metres; 0 where all of it is in spheres.
    ///
    /// Unit: `m`.
    double max_uncovered{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("max_standoff", self.max_standoff);
        visitor.required("mean_standoff", self.mean_standoff);
        visitor.required("uncovered_fraction", self.uncovered_fraction);
        visitor.required("max_uncovered", self.max_uncovered);
        visitor.extra(self.extra);
    }
};

/// How often a check by a level is right. A configuration is in collision where two pieces are in contact whose links
/// are not skipped, and free otherwise; the level touches where spheres are in contact of two links that are neither
/// skipped nor ignored.
struct SphereEvaluation {
    /// Number of configurations in collision.
    ///
    /// Unit: `1`.
    std::size_t num_colliding{};
    /// Number of these in which the level does not touch.
    ///
    /// Unit: `1`.
    std::size_t num_missed{};
    /// Number of free configurations.
    ///
    /// Unit: `1`.
    std::size_t num_free{};
    /// Number of these in which the level touches.
    ///
    /// Unit: `1`.
    std::size_t num_false_contacts{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("num_colliding", self.num_colliding);
        visitor.required("num_missed", self.num_missed);
        visitor.required("num_free", self.num_free);
        visitor.required("num_false_contacts", self.num_false_contacts);
        visitor.extra(self.extra);
    }
};

/// A level: spheres of each link, and what they say.
struct SphereLevel {
    /// Where the spheres are from.
    SphereOrigin origin{};
    /// Whether every point of every piece is in a sphere of its link. Such a level never calls a collision free.
    bool covers{};
    /// The level before this one whose spheres hold the spheres of this one; null for the first level.
    ///
    /// Index of: `other`.
    std::optional<std::size_t> outer_level_idx;
    /// For each link, its spheres; none for a link without a piece.
    ///
    /// Length: `links`.
    std::vector<std::vector<LinkSphere>> spheres;
    /// For each link, how far its spheres are from its pieces; null for a link without spheres.
    ///
    /// Length: `links`.
    std::vector<std::optional<SphereFit>> fits;
    /// Pairs of links that a check by this level leaves out, besides the skipped ones (SPEC 8.8.5): they were in no
    /// sampled collision, and their spheres touch all the same. None for a level that covers.
    std::vector<LinkPair> ignored_pairs;
    /// Pairs of links with a sphere of each in contact in every sampled configuration.
    std::vector<LinkPair> always_pairs;
    /// Pairs of links with a sphere of each in contact in some of the sampled configurations, and not in all. All other
    /// pairs are in contact in none.
    std::vector<LinkPair> sometimes_pairs;
    /// How often a check by this level is right in the sampled configurations.
    SphereEvaluation evaluation;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("origin", self.origin);
        visitor.required("covers", self.covers);
        visitor.required("outer_level_idx", self.outer_level_idx);
        visitor.required("spheres", self.spheres);
        visitor.required("fits", self.fits);
        visitor.required("ignored_pairs", self.ignored_pairs);
        visitor.required("always_pairs", self.always_pairs);
        visitor.required("sometimes_pairs", self.sometimes_pairs);
        visitor.required("evaluation", self.evaluation);
        visitor.extra(self.extra);
    }
};

/// Spheres that stand for the convex pieces of links, for programs that check very many configurations.
struct LinkShapesSpheresModule {
    /// The levels, from coarse to fine. The first has one sphere for each link with a piece.
    std::vector<SphereLevel> levels;
    /// How many sampled configurations (SPEC 9.3), from 2^31 on, pairs and counts of the levels are of.
    ///
    /// Unit: `1`.
    std::size_t num_samples{};
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"link_shapes_spheres_module"};
    static constexpr const char *module_folder{"link_shapes_modules/link_shapes_spheres_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 5> depends_on{"dof_module", "chain_module", "bounds_module", "convex_decomposition_meshes_module", "link_shapes_skips_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("levels", self.levels);
        visitor.required("num_samples", self.num_samples);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

/// What a loop holds. The axes are those of its frames: z is the axis of a hinge, slide or plane.
/// - `Fixed`: Position and rotation: a weld.
/// - `Revolute`: The position, and the direction of z: a hinge about z.
/// - `Prismatic`: The position along x and y, and the rotation: a slide along z.
/// - `Cylindrical`: The position along x and y, and the direction of z: a hinge about z that slides along it.
/// - `Universal`: The position, and the right angle between z of both frames: a universal joint.
/// - `Spherical`: The position: a ball.
/// - `Planar`: The position along z, and the direction of z: frame B moves in the x-y plane of frame A.
enum class LoopKind { fixed, revolute, prismatic, cylindrical, universal, spherical, planar };

template <> struct detail::Words<LoopKind> {
    static constexpr std::array<std::string_view, 7> words{"Fixed", "Revolute", "Prismatic", "Cylindrical", "Universal", "Spherical", "Planar"};
};

/// What holds two links together besides the joints of the tree.
struct Loop {
    /// Its name; unique among loops and couplings.
    std::string name;
    /// Which numbers of the pose of frame B in frame A are held.
    LoopKind kind{};
    /// The link that frame A is fixed to.
    ///
    /// Index of: `link`.
    std::size_t link_a_idx{};
    /// Frame A, in that link's frame.
    ///
    /// Frame: `link`.
    Pose frame_a;
    /// The link that frame B is fixed to: another one.
    ///
    /// Index of: `link`.
    std::size_t link_b_idx{};
    /// Frame B, in that link's frame.
    ///
    /// Frame: `link`.
    Pose frame_b;
    /// How far the held position may be off where the loop counts as closed, m: the precision of the source. Not
    /// negative.
    ///
    /// Unit: `m`.
    double position_tolerance{};
    /// How far the held rotation may be off there, rad. Not negative.
    ///
    /// Unit: `rad`.
    double rotation_tolerance{};
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("kind", self.kind);
        visitor.required("link_a_idx", self.link_a_idx);
        visitor.required("frame_a", self.frame_a);
        visitor.required("link_b_idx", self.link_b_idx);
        visitor.required("frame_b", self.frame_b);
        visitor.required("position_tolerance", self.position_tolerance);
        visitor.required("rotation_tolerance", self.rotation_tolerance);
        visitor.extra(self.extra);
    }
};

/// What a DOF adds to the sum of a coupling: c1 q + c2 q^2 + c3 q^3 + c4 q^4.
struct CouplingTerm {
    /// The DOF.
    ///
    /// Index of: `dof`.
    std::size_t dof_idx{};
    /// c1, c2, c3 and c4.
    ///
    /// Unit: `1 or rad/m or m/rad or 1/rad or 1/m or rad/m^2 or m/rad^2 or 1/rad^2 or 1/m^2 or rad/m^3 or m/rad^3 or
    /// 1/rad^3 or 1/m^3 or rad/m^4 or m/rad^4`.
    std::array<double, 4> coefficients;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("dof_idx", self.dof_idx);
        visitor.required("coefficients", self.coefficients);
        visitor.extra(self.extra);
    }
};

/// An equation between DOFs: the constant and all terms add up to 0.
struct Coupling {
    /// Its name; unique among loops and couplings.
    std::string name;
    /// The constant.
    ///
    /// Unit: `rad or m`.
    double constant{};
    /// One term for each DOF, in DOF order.
    std::vector<CouplingTerm> terms;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("name", self.name);
        visitor.required("constant", self.constant);
        visitor.required("terms", self.terms);
        visitor.extra(self.extra);
    }
};

/// A closed configuration whose independent DOFs have the values of a sampled configuration.
struct ClosedSample {
    /// The number of the sampled configuration.
    ///
    /// Index of: `sample`.
    std::size_t sample_idx{};
    /// One value per DOF, rad or m; null where none was found that is closed.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::optional<std::vector<double>> configuration;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("sample_idx", self.sample_idx);
        visitor.required("configuration", self.configuration);
        visitor.extra(self.extra);
    }
};

/// What closes the kinematic loops of a robot, and couplings between its DOFs. The links and joints of the other
/// modules are its spanning tree.
struct LoopsModule {
    /// The loops.
    std::vector<Loop> loops;
    /// Equations between DOFs, such as gears between joints of different branches.
    std::vector<Coupling> couplings;
    /// The DOFs that move freely, ascending; the others follow from them. Their number is the mobility at the reference
    /// configuration.
    ///
    /// Index of: `dof`.
    std::vector<std::size_t> independent_dof_idxs;
    /// A configuration in which all loops are closed and all couplings hold: one value per DOF, rad or m.
    ///
    /// Unit: `rad or m`. Length: `dofs`.
    std::vector<double> reference_configuration;
    /// Sampled configurations that are closed, numbered from 0 without gaps.
    std::vector<ClosedSample> closed_samples;
    /// The JSON Schema that this document follows, for editors.
    std::optional<std::string> schema;
    /// Other keys: `x_` and those of later minor versions. An object, or null.
    Json extra;

    static constexpr const char *module_name{"loops_module"};
    static constexpr const char *module_folder{"loops_module"};
    static constexpr const char *module_version{"1.0.0"};
    static constexpr std::array<const char *, 4> depends_on{"urdf_module", "dof_module", "chain_module", "bounds_module"};

    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {
        visitor.required("loops", self.loops);
        visitor.required("couplings", self.couplings);
        visitor.required("independent_dof_idxs", self.independent_dof_idxs);
        visitor.required("reference_configuration", self.reference_configuration);
        visitor.required("closed_samples", self.closed_samples);
        visitor.optional("$schema", self.schema);
        visitor.extra(self.extra);
    }
};

} // namespace urdd::types

#endif
