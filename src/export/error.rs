//! Why a robot cannot be exported, and what was said in another way.

use thiserror::Error;

use super::Format;
use crate::geometry::write::WriteError;
use crate::robot::{RobotError, ShapeKind};

/// Why a robot cannot be exported.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The URDD does not say what the format needs.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The joints of the robot form no tree.
    #[error("the joints form no tree with one root: `urdd validate` says more")]
    NoTree,
    /// A name that the format cannot hold.
    #[error("{} cannot hold the name `{}` of a {what}: {reason}; give it another name in the URDF, and generate the URDD again", .format.name(), .name.escape_debug())]
    Name {
        /// The format.
        format: Format,
        /// What has the name: `link`, `joint`, `robot`.
        what: &'static str,
        /// The name.
        name: String,
        /// Why it cannot be held.
        reason: &'static str,
    },
    /// The URDD has no shapes of the kind asked for.
    #[error("no link has {0}: ask for other shapes, or for a format without any")]
    NoShapes(ShapeKind),
    /// A mesh that cannot be written.
    #[error("the mesh of link `{}` cannot be written: {error}", .link.escape_debug())]
    Mesh {
        /// Its link.
        link: String,
        /// Why.
        error: WriteError,
    },
}

/// What a format could not say, or says in another way.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Error)]
#[non_exhaustive]
pub enum Note {
    /// Pairs of links are disabled though some of their pieces are checked in the URDD.
    #[error(
        "{count} {} disabled as a whole, though the URDD checks some of their pieces: the format knows links only", match .count { 1 => "pair of links is", _ => "pairs of links are" }
    )]
    Whole {
        /// How many pairs.
        count: usize,
    },
    /// A link's mass or inertia that the format refuses is left out.
    #[error("link `{}`: {reason}; its inertia is left out", .link.escape_debug())]
    Inertia {
        /// The link.
        link: String,
        /// Why.
        reason: &'static str,
    },
    /// A joint that cannot be said as it is.
    #[error("joint `{}`: {what}", .joint.escape_debug())]
    Joint {
        /// The joint.
        joint: String,
        /// What is said instead.
        what: &'static str,
    },
    /// Elements that URDF does not define and that cannot stand alone.
    #[error(
        "{0} elements that URDF does not define are left out: they use prefixes that only the source file declares, or are no XML by themselves"
    )]
    Elements(usize),
    /// A flat shape where the format wants thickness.
    #[error("link `{}`: a flat piece is a box of {thickness} m", .link.escape_debug())]
    Flat {
        /// The link.
        link: String,
        /// How thick it became.
        thickness: &'static str,
    },
}
