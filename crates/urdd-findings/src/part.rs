//! Parts of a robot's geometry that rules judge one by one, so that a fault in one part leaves the others judged.

use super::code::Code;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

/// A mesh of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The plain mesh of a link.
    Plain(usize),
    /// The convex hull of a link.
    Hull(usize),
    /// A convex piece of a link.
    Piece {
        /// The link.
        link: usize,
        /// Its index among the link's pieces.
        piece: usize,
    },
}

/// Why a part was not verified by a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Why {
    /// This rule found a fault in it, or in something it is compared with.
    Failed(Code),
    /// Its files, or files it is compared with, cannot be read or differ.
    Unreadable,
    /// A mesh that the URDF names for it is not carried or cannot be read.
    SourceMissing,
    /// A mesh that the URDF names is outside of the robot's folder and packages, and was not read.
    Outside,
    /// A mesh that the URDF names is in a package that is not found.
    NoPackage,
    /// A mesh that the URDF names is in a format that this program does not read.
    OtherFormat,
}

/// A part that a rule did not verify.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NotVerified {
    /// The part.
    pub part: Part,
    /// The reason.
    pub why: Why,
}

impl Part {
    /// A part of a module of derived meshes.
    pub fn of(module: ModuleKind, link: usize, piece: usize) -> Option<Part> {
        match module {
            ModuleKind::PlainMeshes => Some(Part::Plain(link)),
            ModuleKind::ConvexHullMeshes => Some(Part::Hull(link)),
            ModuleKind::ConvexDecompositionMeshes => Some(Part::Piece { link, piece }),
            _ => None,
        }
    }

    /// The hull or piece that a shape is or bounds.
    pub fn of_shape(kind: ShapeKind, link: usize, piece: usize) -> Part {
        if kind.is_of_links() { Part::Hull(link) } else { Part::Piece { link, piece } }
    }

    /// Its module, link and piece (0 if links have one mesh).
    pub fn place(self) -> (ModuleKind, usize, usize) {
        match self {
            Part::Plain(link) => (ModuleKind::PlainMeshes, link, 0),
            Part::Hull(link) => (ModuleKind::ConvexHullMeshes, link, 0),
            Part::Piece { link, piece } => (ModuleKind::ConvexDecompositionMeshes, link, piece),
        }
    }

    /// The link.
    pub fn link(self) -> usize {
        match self {
            Part::Plain(link) | Part::Hull(link) | Part::Piece { link, .. } => link,
        }
    }
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Part::Plain(link) => write!(f, "the mesh of link {link}"),
            Part::Hull(link) => write!(f, "the hull of link {link}"),
            Part::Piece { link, piece } => write!(f, "piece {piece} of link {link}"),
        }
    }
}

impl std::fmt::Display for Why {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Why::Failed(code) => write!(f, "{code} found a fault"),
            Why::Unreadable => f.write_str("a mesh file cannot be read, or its formats differ"),
            Why::SourceMissing => {
                f.write_str("a mesh that the URDF names is not carried, or cannot be read")
            }
            Why::Outside => f.write_str(
                "a mesh is outside of the robot's folder and packages; --allow-folder reads it",
            ),
            Why::NoPackage => {
                f.write_str("a mesh is in a package that is not found; --package says where it is")
            }
            Why::OtherFormat => f.write_str("a mesh is in a format that is not read here"),
        }
    }
}
