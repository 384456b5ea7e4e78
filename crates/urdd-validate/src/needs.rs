//! Groups of needs with names. A need of parts is met part by part: a rule leaves out unsound parts and judges the others.

use super::rule::{Need, Parts};
use urdd_findings::code::Code;
use urdd_findings::part::PartKind;
use urdd_format::registry::ModuleKind as Kind;

/// Each part passed these rules.
const fn each(codes: &'static [Code]) -> Need {
    Need::Each(Parts { codes, in_version_1_only: false })
}

/// The same, in a URDD of version 1.
const fn each_in_version_1(codes: &'static [Code]) -> Need {
    Need::Each(Parts { codes, in_version_1_only: true })
}

/// At least one module of meshes per link.
pub const DERIVED_MESHES: Need =
    Need::AnyModule(&[Kind::PlainMeshes, Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]);

/// At least one module of meshes, original ones included.
pub const MESHES: Need = Need::AnyModule(&[
    Kind::OriginalMeshes,
    Kind::PlainMeshes,
    Kind::ConvexHullMeshes,
    Kind::ConvexDecompositionMeshes,
]);

/// The hulls or the pieces.
pub const HULLS_OR_PIECES: Need =
    Need::AnyModule(&[Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]);

/// At least one module with lists of shapes per link.
pub const SHAPE_LISTS: Need =
    Need::AnyModule(&[Kind::LinkShapesApproximations, Kind::LinkShapesMaxDistanceFromOrigin]);

/// At least one module with matrices over shapes.
pub const SHAPE_MATRICES: Need = Need::AnyModule(&[
    Kind::LinkShapesDistanceStatistics,
    Kind::LinkShapesSimpleSkips,
    Kind::LinkShapesSkips,
]);

/// The same, including the legacy error models.
pub const SHAPE_MATRICES_OR_MODELS: Need = Need::AnyModule(&[
    Kind::LinkShapesDistanceStatistics,
    Kind::LinkShapesSimpleSkips,
    Kind::LinkShapesSkips,
    Kind::LinkShapesLieAlgErrorModels,
]);

/// No file of the part belongs to another part too.
pub const OWN_FILES: Need = each(&[Code::MSH005]);

/// The same, in a URDD of version 1.
pub const OWN_FILES_IN_VERSION_1: Need = each_in_version_1(&[Code::MSH005]);

/// The hull is convex.
pub const CONVEX_HULL: Need = each(&[Code::MSH017]);

/// The hull is convex and contains the mesh.
pub const HULL_ABOUT_MESH: Need = each(&[Code::MSH017, Code::MSH018]);

/// The hull is that of the mesh.
pub const SOUND_HULL: Need = each(&[Code::MSH017, Code::MSH018, Code::MSH019]);

/// The piece is convex.
pub const CONVEX_PIECE: Need = each(&[Code::MSH020]);

/// The hull is that of the mesh; the pieces are convex, inside the hull, and cover the surface. Boxes, spheres and
/// distances are compared with them.
pub const SOUND_SHAPES: Need = each_in_version_1(&[
    Code::MSH017,
    Code::MSH018,
    Code::MSH019,
    Code::MSH020,
    Code::MSH021,
    Code::MSH022,
]);

/// The robot is a tree of links.
pub const ROBOT_SOUND: Need = Need::All(&[Need::Passed(Code::URD004), Need::Passed(Code::URD006)]);

/// Link names are unique, and joints name existing links.
pub const LINKS_NAMED: Need = Need::All(&[
    Need::NotFailed(Code::URD002),
    Need::NotFailed(Code::URD004),
    Need::NotFailed(Code::URD007),
]);

/// The modules define the pose of every link.
pub const POSES_KNOWN: Need = Need::All(&[
    ROBOT_SOUND,
    Need::NotFailed(Code::DOF003),
    Need::NotFailed(Code::DOF004),
    Need::NotFailed(Code::DOF005),
    Need::NotFailed(Code::DOF007),
    Need::NotFailed(Code::CHN001),
    Need::NotFailed(Code::CHN002),
    Need::NotFailed(Code::CHN003),
    Need::NotFailed(Code::CHN006),
    Need::NotFailed(Code::CHN007),
    Need::NotFailed(Code::CHN008),
    Need::NotFailed(Code::CHN009),
    Need::NotFailed(Code::CHN010),
    Need::NotFailed(Code::KIN001),
    Need::NotFailed(Code::BND001),
]);

/// The bounds are those of the URDF, so that configurations can be sampled within them.
pub const BOUNDS_SOUND: Need = Need::All(&[
    Need::NotFailed(Code::BND002),
    Need::NotFailed(Code::BND003),
    Need::NotFailed(Code::BND006),
]);

/// The same, in a URDD of version 1.
pub const BOUNDS_SOUND_IN_VERSION_1: Need = Need::All(&[
    Need::NotFailedInV1(Code::BND002),
    Need::NotFailedInV1(Code::BND003),
    Need::NotFailedInV1(Code::BND006),
]);

/// The mesh modules list every link, in the same formats, and agree on which links have a mesh.
pub const MESHES_LISTED: Need = Need::All(&[
    Need::NotFailed(Code::MSH001),
    Need::NotFailed(Code::MSH003),
    Need::NotFailed(Code::MSH007),
]);

/// The mesh modules list every link, and as many pieces as the shape modules.
pub const PIECES_LISTED: Need = Need::All(&[
    Need::NotFailed(Code::MSH001),
    Need::NotFailed(Code::MSH004),
    Need::NotFailed(Code::MSH007),
]);

/// The lists of shapes have one entry per link, empty exactly for links without a hull.
pub const SHAPES_LISTED: Need =
    Need::All(&[Need::NotFailed(Code::SHP001), Need::NotFailed(Code::SHP002)]);

/// In a URDD of version 1: no piece is listed twice.
pub const NO_PIECE_TWICE: Need = Need::NoPartInV1(Code::MSH005, PartKind::Piece);

/// Boxes, spheres, and the hulls and pieces that they contain.
pub const ENCLOSURES: Need = Need::All(&[
    Need::Module(Kind::LinkShapesApproximations),
    HULLS_OR_PIECES,
    PIECES_LISTED,
    OWN_FILES,
    SOUND_SHAPES,
    SHAPES_LISTED,
    Need::NotFailed(Code::SHP003),
]);

/// The distance statistics, and everything that is needed to recompute them.
pub const STATISTICS: Need = Need::All(&[
    Need::Module(Kind::Urdf),
    Need::Module(Kind::Dof),
    Need::Module(Kind::Chain),
    Need::Module(Kind::Bounds),
    Need::Module(Kind::ConvexHullMeshes),
    Need::Module(Kind::ConvexDecompositionMeshes),
    Need::Module(Kind::LinkShapesApproximations),
    Need::Module(Kind::LinkShapesDistanceStatistics),
    POSES_KNOWN,
    BOUNDS_SOUND,
    PIECES_LISTED,
    OWN_FILES,
    SOUND_SHAPES,
    SHAPES_LISTED,
    Need::NotFailed(Code::SHP003),
    Need::Passed(Code::SHP005),
    Need::NotFailed(Code::SHP010),
    Need::NotFailed(Code::SHP016),
]);
