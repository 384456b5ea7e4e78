//! What rules need, by name. A need of parts is met part by part: a rule leaves out those that are
//! unsound, and judges the others.

use super::code::Code;
use super::part::{PartKind, Parts};
use super::rule::Need;

/// No file of the part is also another part's.
pub const OWN_FILES: Need = Need::Each(Parts {
    codes: &[Code::MSH005],
    in_version_1_only: false,
});

/// The same, in a URDD of version 1.
pub const OWN_FILES_IN_VERSION_1: Need = Need::Each(Parts {
    codes: &[Code::MSH005],
    in_version_1_only: true,
});

/// The hull is convex.
pub const CONVEX_HULL: Need = Need::Each(Parts {
    codes: &[Code::MSH017],
    in_version_1_only: false,
});

/// The hull is convex, and holds the mesh.
pub const HULL_ABOUT_MESH: Need = Need::Each(Parts {
    codes: &[Code::MSH017, Code::MSH018],
    in_version_1_only: false,
});

/// The hull is that of the mesh.
pub const SOUND_HULL: Need = Need::Each(Parts {
    codes: &[Code::MSH017, Code::MSH018, Code::MSH019],
    in_version_1_only: false,
});

/// The piece is convex.
pub const CONVEX_PIECE: Need = Need::Each(Parts {
    codes: &[Code::MSH020],
    in_version_1_only: false,
});

/// The hull is that of the mesh, and the pieces are convex, in the hull, and cover the surface: what
/// boxes, spheres and distances are judged by.
pub const SOUND_SHAPES: Need = Need::Each(Parts {
    codes: &[
        Code::MSH017,
        Code::MSH018,
        Code::MSH019,
        Code::MSH020,
        Code::MSH021,
        Code::MSH022,
    ],
    in_version_1_only: true,
});

/// The robot is a tree of links.
pub const ROBOT_SOUND: Need = Need::All(&[Need::Passed(Code::URD004), Need::Passed(Code::URD006)]);

/// Links have names of their own, and joints name links that are there.
pub const LINKS_NAMED: Need = Need::All(&[
    Need::NotFailed(Code::URD002),
    Need::NotFailed(Code::URD004),
    Need::NotFailed(Code::URD007),
]);

/// The modules give every link a pose.
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

/// The bounds are those of the URDF, so that configurations are sampled in them.
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

/// The mesh modules list every link, in every format, and none where there is nothing.
pub const MESHES_LISTED: Need = Need::All(&[
    Need::NotFailed(Code::MSH001),
    Need::NotFailed(Code::MSH003),
    Need::NotFailed(Code::MSH007),
]);

/// The mesh modules list every link and as many pieces as the shapes have.
pub const PIECES_LISTED: Need = Need::All(&[
    Need::NotFailed(Code::MSH001),
    Need::NotFailed(Code::MSH004),
    Need::NotFailed(Code::MSH007),
]);

/// The lists of shapes have an entry for every link, and only where there is a hull.
pub const SHAPES_LISTED: Need =
    Need::All(&[Need::NotFailed(Code::SHP001), Need::NotFailed(Code::SHP002)]);

/// In a URDD of version 1: no piece is there twice, which is one too many.
pub const NO_PIECE_TWICE: Need = Need::NoPartInV1(Code::MSH005, PartKind::Piece);
