//! The registry of every (module, version): its folder, its type and schema, the modules that it is
//! derived from, and the conformance class that requires it.

use schemars::Schema;
use serde_json::Value;

use super::root_metadata::ConformanceClass;
use super::*;

/// Version of the specification that this crate implements.
pub const SPEC_VERSION: &str = "1.1.0";

/// The first version of the specification, which each URDD states that has no module of a later one.
pub const FIRST_SPEC_VERSION: &str = "1.0.0";

/// Version of the program and the packages `urdd`, as they state it in what they write. Crates have another.
pub const PROGRAM_VERSION: &str = "1.4.0";

/// Format family of a (module, version).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Profile {
    /// Version 1 of the specification.
    V1,
    /// Versions published before the specification.
    Legacy,
}

impl Profile {
    /// The word in reports: `1.0` or `legacy`.
    pub fn as_str(self) -> &'static str {
        match self {
            Profile::V1 => "1.0",
            Profile::Legacy => "legacy",
        }
    }
}

macro_rules! kinds {
    ($($(#[$meta:meta])* $kind:ident = $name:literal in $folder:literal, $class:expr, needs [$($needs:ident),*];)*) => {
        /// A module of the format, in any version.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum ModuleKind { $($(#[$meta])* $kind,)* }

        impl ModuleKind {
            /// Every module, in the order of the specification's table. A module follows those that
            /// it is derived from.
            pub const ALL: &[ModuleKind] = &[$(ModuleKind::$kind),*];

            /// Name of the module, the last part of its folder.
            pub fn name(self) -> &'static str {
                match self { $(ModuleKind::$kind => $name,)* }
            }

            /// Its name as `--modules` accepts it: without `_module`.
            pub fn short_name(self) -> &'static str {
                self.name().strip_suffix("_module").unwrap_or(self.name())
            }

            /// Folder of the module, relative to the URDD's root.
            pub fn folder(self) -> &'static str {
                match self { $(ModuleKind::$kind => concat!($folder, $name),)* }
            }

            /// The version of the specification that has it first; what `urdd_version` is at least.
            pub fn since(self) -> &'static str {
                match self {
                    ModuleKind::LinkShapesSpheres | ModuleKind::Loops => "1.1.0",
                    _ => FIRST_SPEC_VERSION,
                }
            }

            /// The lowest conformance class that requires the module; `None` if none does.
            pub fn class(self) -> Option<ConformanceClass> {
                match self { $(ModuleKind::$kind => $class,)* }
            }

            /// Whether no conformance class requires the module, so that its absence is normal.
            pub fn is_optional(self) -> bool {
                self.class().is_none()
            }

            /// The modules that this one is derived from, in version 1.
            pub fn depends_on(self) -> &'static [ModuleKind] {
                match self { $(ModuleKind::$kind => &[$(ModuleKind::$needs),*],)* }
            }
        }
    };
}

use ConformanceClass::{Core, Geometry, Shapes};

kinds! {
    /// The source URDF as data.
    Urdf = "urdf_module" in "", Some(Core), needs [];
    /// Degrees of freedom.
    Dof = "dof_module" in "", Some(Core), needs [Urdf];
    /// The kinematic tree.
    Chain = "chain_module" in "", Some(Core), needs [Urdf];
    /// Paths between links.
    Connections = "connections_module" in "", Some(Core), needs [Chain];
    /// Bounds of the DOFs.
    Bounds = "bounds_module" in "", Some(Core), needs [Urdf, Dof];
    /// Reference values for forward kinematics. Recommended.
    KinematicsSamples = "kinematics_samples_module" in "", None, needs [Dof, Chain, Bounds];
    /// How the robot was composed of others. Composed robots only.
    Composition = "composition_module" in "", None, needs [Urdf];
    /// Configurations that a person named. Optional.
    NamedConfigurations = "named_configurations_module" in "", None, needs [Dof, Bounds];
    /// Mesh files as the URDF names them.
    OriginalMeshes = "original_meshes_module" in "mesh_modules/", Some(Geometry), needs [Urdf];
    /// One mesh per link.
    PlainMeshes = "plain_meshes_module" in "mesh_modules/", Some(Geometry), needs [Urdf, OriginalMeshes];
    /// Convex hulls.
    ConvexHullMeshes = "convex_hull_meshes_module" in "mesh_modules/", Some(Geometry), needs [PlainMeshes];
    /// Convex pieces.
    ConvexDecompositionMeshes = "convex_decomposition_meshes_module" in "mesh_modules/", Some(Geometry), needs [PlainMeshes];
    /// Boxes and spheres.
    LinkShapesApproximations = "link_shapes_approximations_module" in "link_shapes_modules/", Some(Shapes), needs [ConvexHullMeshes, ConvexDecompositionMeshes];
    /// Maximum distance of shapes from their link's origin.
    LinkShapesMaxDistanceFromOrigin = "link_shapes_max_distance_from_origin_module" in "link_shapes_modules/", Some(Shapes), needs [ConvexHullMeshes, ConvexDecompositionMeshes, LinkShapesApproximations];
    /// Sampled distances between pairs of shapes.
    LinkShapesDistanceStatistics = "link_shapes_distance_statistics_module" in "link_shapes_modules/", Some(Shapes), needs [Dof, Chain, Bounds, ConvexHullMeshes, ConvexDecompositionMeshes, LinkShapesApproximations];
    /// Pairs that are always in contact, and the reason for every pair.
    LinkShapesSimpleSkips = "link_shapes_simple_skips_module" in "link_shapes_modules/", Some(Shapes), needs [Dof, Chain, Bounds, ConvexHullMeshes, ConvexDecompositionMeshes, LinkShapesApproximations, LinkShapesDistanceStatistics];
    /// Pairs to skip, by reason and by manual edits.
    LinkShapesSkips = "link_shapes_skips_module" in "link_shapes_modules/", Some(Shapes), needs [Urdf, LinkShapesSimpleSkips];
    /// A network that estimates distances between links. Optional.
    SelfCollisionModel = "self_collision_model_module" in "link_shapes_modules/", None, needs [Dof, Chain, Bounds, ConvexDecompositionMeshes, LinkShapesSkips];
    /// Spheres of links, in levels. Optional.
    LinkShapesSpheres = "link_shapes_spheres_module" in "link_shapes_modules/", None, needs [Dof, Chain, Bounds, ConvexDecompositionMeshes, LinkShapesSkips];
    /// What closes the loops of a robot that is no tree. Robots with loops only.
    Loops = "loops_module" in "", None, needs [Urdf, Dof, Chain, Bounds];
    /// Error of linearised distances. Legacy only.
    LinkShapesLieAlgErrorModels = "link_shapes_lie_alg_error_models_module" in "link_shapes_modules/", None, needs [];
    /// A viewer's state. Legacy only.
    FirstLookVis = "first_look_vis_module" in "bevy_modules/", None, needs [];
    /// How a robot was composed of others. Legacy only.
    CombinedRobot = "combined_robot_module" in "", None, needs [];
    /// How a robot was trimmed from another. Legacy only.
    AdjustedRobot = "adjusted_robot_module" in "", None, needs [];
    /// How a chain was assembled from mesh files. Legacy only.
    Creator = "creator_module" in "", None, needs [];
}

macro_rules! modules {
    ($($variant:ident($ty:ty): $kind:ident @ $($version:literal)|+, $profile:ident;)*) => {
        /// A parsed module document. Versions of the same structure share a variant.
        #[derive(Debug, Clone, PartialEq, serde::Serialize)]
        #[serde(untagged)]
        pub enum ModuleDocument {
            $(#[doc = concat!("`", stringify!($kind), "` at version ", stringify!($($version)|+), ".")] $variant(Box<$ty>),)*
        }

        /// Every (module, version): version 1 in the order of the specification's table, then legacy
        /// versions in that order, newest first.
        // A `static` would be compiled into whatever does not use it, too.
        pub fn modules() -> &'static [ModuleSpec] {
            const {
                &[$($(ModuleSpec {
                    kind: ModuleKind::$kind,
                    version: $version,
                    profile: Profile::$profile,
                    schema: || schemars::schema_for!($ty),
                    read: |value| serde::Deserialize::deserialize(value).map(|m| ModuleDocument::$variant(Box::new(m))),
                },)+)*]
            }
        }
    };
}

/// One (module, version).
pub struct ModuleSpec {
    /// The module.
    pub kind: ModuleKind,
    /// Version of its format; empty if the published module has no `VERSION` file.
    pub version: &'static str,
    /// Its format family.
    pub profile: Profile,
    schema: fn() -> Schema,
    read: fn(&Value) -> Result<ModuleDocument, serde_json::Error>,
}

modules! {
    Urdf(urdf::UrdfModule): Urdf @ "1.0.0", V1;
    Dof(dof::DofModule): Dof @ "1.0.0", V1;
    Chain(chain::ChainModule): Chain @ "1.0.0", V1;
    Connections(connections::ConnectionsModule): Connections @ "1.0.0", V1;
    Bounds(bounds::BoundsModule): Bounds @ "1.0.0", V1;
    KinematicsSamples(kinematics_samples::KinematicsSamplesModule): KinematicsSamples @ "1.0.0", V1;
    Composition(composition::CompositionModule): Composition @ "1.0.0", V1;
    NamedConfigurations(named_configurations::NamedConfigurationsModule): NamedConfigurations @ "1.0.0", V1;
    OriginalMeshes(original_meshes::OriginalMeshesModule): OriginalMeshes @ "1.0.0", V1;
    PlainMeshes(plain_meshes::PlainMeshesModule): PlainMeshes @ "1.0.0", V1;
    ConvexHullMeshes(convex_hull_meshes::ConvexHullMeshesModule): ConvexHullMeshes @ "1.0.0", V1;
    ConvexDecompositionMeshes(convex_decomposition_meshes::ConvexDecompositionMeshesModule): ConvexDecompositionMeshes @ "1.0.0", V1;
    LinkShapesApproximations(link_shapes_approximations::LinkShapesApproximationsModule): LinkShapesApproximations @ "1.0.0", V1;
    LinkShapesMaxDistanceFromOrigin(link_shapes_approximations::LinkShapesMaxDistanceFromOriginModule): LinkShapesMaxDistanceFromOrigin @ "1.0.0", V1;
    LinkShapesDistanceStatistics(link_shapes_distance_statistics::LinkShapesDistanceStatisticsModule): LinkShapesDistanceStatistics @ "1.0.0", V1;
    LinkShapesSimpleSkips(link_shapes_simple_skips::LinkShapesSimpleSkipsModule): LinkShapesSimpleSkips @ "1.0.0", V1;
    LinkShapesSkips(link_shapes_skips::LinkShapesSkipsModule): LinkShapesSkips @ "1.0.0", V1;
    SelfCollisionModel(self_collision_model::SelfCollisionModelModule): SelfCollisionModel @ "1.0.0", V1;
    LinkShapesSpheres(link_shapes_spheres::LinkShapesSpheresModule): LinkShapesSpheres @ "1.0.0", V1;
    Loops(loops::LoopsModule): Loops @ "1.0.0", V1;
    LegacyUrdf(legacy::urdf::UrdfModule): Urdf @ "0.0.3" | "0.0.1", Legacy;
    LegacyDof(legacy::kinematics::DofModule): Dof @ "0.0.2" | "0.0.1", Legacy;
    LegacyChain(legacy::kinematics::ChainModule): Chain @ "0.0.1", Legacy;
    LegacyConnections(legacy::kinematics::ConnectionsModule): Connections @ "0.0.1", Legacy;
    LegacyBounds(legacy::kinematics::BoundsModule): Bounds @ "0.0.1", Legacy;
    LegacyOriginalMeshLists(legacy::meshes::OriginalMeshListsModule): OriginalMeshes @ "0.0.2", Legacy;
    LegacyOriginalMeshes(legacy::meshes::OriginalMeshesModule): OriginalMeshes @ "0.0.1", Legacy;
    LegacyPlainMeshes(legacy::meshes::PlainMeshesModule): PlainMeshes @ "0.0.2" | "0.0.1", Legacy;
    LegacyConvexHullMeshes(legacy::meshes::ConvexHullMeshesModule): ConvexHullMeshes @ "0.0.1", Legacy;
    LegacyConvexDecompositionMeshes(legacy::meshes::ConvexDecompositionMeshesModule): ConvexDecompositionMeshes @ "0.0.1", Legacy;
    LegacyLinkShapesApproximations(legacy::shapes::LinkShapesApproximationsModule): LinkShapesApproximations @ "0.0.3", Legacy;
    LegacyLinkShapesMaxDistanceFromOrigin(link_shapes_approximations::LinkShapesMaxDistanceFromOriginModule): LinkShapesMaxDistanceFromOrigin @ "0.0.3", Legacy;
    LegacyLinkShapesDistanceStatistics(legacy::shapes::LinkShapesDistanceStatisticsModule): LinkShapesDistanceStatistics @ "0.0.3", Legacy;
    LegacyLinkShapesSimpleSkips(legacy::shapes::LinkShapesSimpleSkipsModule): LinkShapesSimpleSkips @ "0.0.5", Legacy;
    LegacyLinkShapesSkips(legacy::shapes::LinkShapesSkipsModule): LinkShapesSkips @ "0.0.2" | "0.0.1", Legacy;
    LegacyLinkShapesLieAlgErrorModels(legacy::shapes::LinkShapesLieAlgErrorModelsModule): LinkShapesLieAlgErrorModels @ "0.0.2" | "0.0.1", Legacy;
    LegacyFirstLookVis(legacy::FirstLookVisModule): FirstLookVis @ "0.0.1", Legacy;
    LegacyCombinedRobot(legacy::composition::CombinedRobotModule): CombinedRobot @ "", Legacy;
    LegacyAdjustedRobot(legacy::composition::AdjustedRobotModule): AdjustedRobot @ "", Legacy;
    LegacyCreator(legacy::composition::CreatorModule): Creator @ "", Legacy;
}

impl ModuleSpec {
    /// Its strict JSON Schema.
    pub fn schema(&self) -> Schema {
        (self.schema)()
    }

    /// Reads a document of this module.
    ///
    /// # Errors
    /// If the document breaks the schema. serde's message names the fault, not its position.
    pub fn read(&self, document: &Value) -> Result<ModuleDocument, serde_json::Error> {
        (self.read)(document)
    }

    /// Reads the text of a document of this module without building a [`Value`]. `None` unless the module grows with
    /// the square of the number of links and the text fits the schema. Ignores faults of the text alone, such as
    /// duplicate extension keys.
    pub fn read_text(&self, text: &str) -> Option<ModuleDocument> {
        fn read<T: serde::de::DeserializeOwned>(text: &str) -> Option<Box<T>> {
            serde_json::from_str(text).ok().map(Box::new)
        }
        if self.profile != Profile::V1 {
            return None;
        }
        match self.kind {
            ModuleKind::Connections => read(text).map(ModuleDocument::Connections),
            ModuleKind::LinkShapesDistanceStatistics => {
                read(text).map(ModuleDocument::LinkShapesDistanceStatistics)
            }
            ModuleKind::LinkShapesSimpleSkips => {
                read(text).map(ModuleDocument::LinkShapesSimpleSkips)
            }
            ModuleKind::LinkShapesSkips => read(text).map(ModuleDocument::LinkShapesSkips),
            _ => None,
        }
    }
}

/// The entry of a (module, version). An empty version selects a published module without one.
pub fn find(kind: ModuleKind, version: &str) -> Option<&'static ModuleSpec> {
    modules().iter().find(|spec| spec.kind == kind && spec.version == version)
}
