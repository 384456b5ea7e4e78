//! Groups of needs with names. A need of parts is met part by part: a rule leaves out unsound parts and judges the others.

use super::rule::Need::{self, *};
use urdd_document::meshes::DERIVED;
use urdd_document::shape_matrices::{MATRIX_MODULES, V1_MATRIX_MODULES};
use urdd_document::shapes::LIST_MODULES;
use urdd_findings::code::Code::*;
use urdd_format::registry::ModuleKind;

/// Every mesh module.
pub const MESH_MODULES: &[ModuleKind] = &[
    ModuleKind::OriginalMeshes,
    ModuleKind::PlainMeshes,
    ModuleKind::ConvexHullMeshes,
    ModuleKind::ConvexDecompositionMeshes,
];

/// At least one module of meshes per link.
pub const DERIVED_MESHES: Need = AnyModule(DERIVED);

/// At least one module of meshes, original ones included.
pub const MESHES: Need = AnyModule(MESH_MODULES);

/// The hulls or the pieces.
pub const HULLS_OR_PIECES: Need =
    AnyModule(&[ModuleKind::ConvexHullMeshes, ModuleKind::ConvexDecompositionMeshes]);

/// At least one module with lists of shapes per link.
pub const SHAPE_LISTS: Need = AnyModule(LIST_MODULES);

/// At least one module with matrices over shapes.
pub const SHAPE_MATRICES: Need = AnyModule(V1_MATRIX_MODULES);

/// The same, including the legacy error models.
pub const SHAPE_MATRICES_OR_MODELS: Need = AnyModule(MATRIX_MODULES);

/// No file of the part belongs to another part too.
pub const OWN_FILES: Need = Each(&[MSH005]);

/// The same, in a URDD of version 1.
pub const OWN_FILES_IN_VERSION_1: Need = EachInV1(&[MSH005]);

/// The hull is convex.
pub const CONVEX_HULL: Need = Each(&[MSH017]);

/// The hull is convex and contains the mesh.
pub const HULL_ABOUT_MESH: Need = Each(&[MSH017, MSH018]);

/// The hull is that of the mesh.
pub const SOUND_HULL: Need = Each(&[MSH017, MSH018, MSH019]);

/// The piece is convex.
pub const CONVEX_PIECE: Need = Each(&[MSH020]);

/// The hull is that of the mesh; the pieces are convex, inside the hull, and cover the surface. Boxes, spheres and
/// distances are compared with them.
pub const SOUND_SHAPES: Need = EachInV1(&[MSH017, MSH018, MSH019, MSH020, MSH021, MSH022]);

/// The robot is a tree of links.
pub const ROBOT_SOUND: Need = All(&[Passed(URD004), Passed(URD006)]);

/// Link names are unique, and joints name existing links.
pub const LINKS_NAMED: Need = NoneFailed(&[URD002, URD004, URD007]);

/// The modules define the pose of every link.
pub const POSES_KNOWN: Need = All(&[
    ROBOT_SOUND,
    NoneFailed(&[
        DOF003, DOF004, DOF005, DOF007, CHN001, CHN002, CHN003, CHN006, CHN007, CHN008, CHN009,
        CHN010, KIN001, BND001,
    ]),
]);

/// The bounds are those of the URDF, so that configurations can be sampled within them.
pub const BOUNDS_SOUND: Need = NoneFailed(&[BND002, BND003, BND006]);

/// The same, in a URDD of version 1.
pub const BOUNDS_SOUND_IN_VERSION_1: Need =
    All(&[NotFailedInV1(BND002), NotFailedInV1(BND003), NotFailedInV1(BND006)]);

/// The mesh modules list every link, in the same formats, and agree on which links have a mesh.
pub const MESHES_LISTED: Need = NoneFailed(&[MSH001, MSH003, MSH007]);

/// The mesh modules list every link, and as many pieces as the shape modules.
pub const PIECES_LISTED: Need = NoneFailed(&[MSH001, MSH004, MSH007]);

/// The lists of shapes have one entry per link, empty exactly for links without a hull.
pub const SHAPES_LISTED: Need = NoneFailed(&[SHP001, SHP002]);

/// In a URDD of version 1: no piece is listed twice.
pub const NO_PIECE_TWICE: Need = NoPieceInV1(MSH005);

/// Boxes, spheres, and the hulls and pieces that they contain.
pub const ENCLOSURES: Need = All(&[
    Module(ModuleKind::LinkShapesApproximations),
    HULLS_OR_PIECES,
    PIECES_LISTED,
    OWN_FILES,
    SOUND_SHAPES,
    SHAPES_LISTED,
    NotFailed(SHP003),
]);

/// The distance statistics, and everything that is needed to recompute them.
pub const STATISTICS: Need = All(&[
    Module(ModuleKind::Urdf),
    Module(ModuleKind::Dof),
    Module(ModuleKind::Chain),
    Module(ModuleKind::Bounds),
    Module(ModuleKind::ConvexHullMeshes),
    Module(ModuleKind::ConvexDecompositionMeshes),
    Module(ModuleKind::LinkShapesApproximations),
    Module(ModuleKind::LinkShapesDistanceStatistics),
    POSES_KNOWN,
    BOUNDS_SOUND,
    PIECES_LISTED,
    OWN_FILES,
    SOUND_SHAPES,
    SHAPES_LISTED,
    NotFailed(SHP003),
    Passed(SHP005),
    NoneFailed(&[SHP010, SHP016]),
]);

/// For the spheres of a link and its pieces: both as they should be.
pub const SPHERES_AND_PIECES: Need = All(&[
    Module(ModuleKind::ConvexDecompositionMeshes),
    PIECES_LISTED,
    OWN_FILES,
    CONVEX_PIECE,
    Passed(SPH001),
    Passed(SPH002),
    Passed(SPH003),
    Passed(SPH004),
]);
