//! Shapes of links: hulls, pieces, and the boxes and spheres about them.

use std::fmt;
use std::str::FromStr;

use nalgebra::{Isometry3, Translation3};

use super::Robot;
use super::error::RobotError;
use super::mesh::Meshes;
use urdd_document::shapes::{self, KINDS, Volume, approximations};
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;
use urdd_kinematics::rotation::from_rpy;

/// A kind of shapes that stand for links.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ShapeKind {
    /// The convex hull of each link.
    Hulls,
    /// The box about each hull.
    Boxes,
    /// The sphere about each hull.
    Spheres,
    /// The convex pieces of each link.
    Pieces,
    /// The box about each piece.
    PieceBoxes,
    /// The sphere about each piece.
    PieceSpheres,
}

impl ShapeKind {
    /// Every kind, in the order of the specification (8.1).
    pub const ALL: [ShapeKind; 6] = [
        ShapeKind::Hulls,
        ShapeKind::Boxes,
        ShapeKind::Spheres,
        ShapeKind::Pieces,
        ShapeKind::PieceBoxes,
        ShapeKind::PieceSpheres,
    ];

    /// Its short name, as command lines take it.
    pub fn name(self) -> &'static str {
        match self {
            ShapeKind::Hulls => "hulls",
            ShapeKind::Boxes => "boxes",
            ShapeKind::Spheres => "spheres",
            ShapeKind::Pieces => "pieces",
            ShapeKind::PieceBoxes => "piece-boxes",
            ShapeKind::PieceSpheres => "piece-spheres",
        }
    }

    /// Whether each link has several shapes of it.
    pub fn is_of_pieces(self) -> bool {
        !self.of_document().full
    }

    /// As documents have it.
    pub(super) fn of_document(self) -> shapes::ShapeKind {
        KINDS[self as usize]
    }

    /// The module that has the shapes.
    pub(super) fn module(self) -> ModuleKind {
        match self {
            ShapeKind::Hulls => ModuleKind::ConvexHullMeshes,
            ShapeKind::Pieces => ModuleKind::ConvexDecompositionMeshes,
            _ => ModuleKind::LinkShapesApproximations,
        }
    }
}

impl fmt::Display for ShapeKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for ShapeKind {
    type Err = RobotError;

    fn from_str(name: &str) -> Result<Self, RobotError> {
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| RobotError::Unknown {
            what: "kind of shapes",
            name: name.to_owned(),
            nearest: None,
        })
    }
}

/// A shape in its link's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkShape {
    /// The link.
    pub link: usize,
    /// Which of the link's pieces it is or is about; 0 for a hull and what is about it.
    pub piece: usize,
    /// The shape.
    pub solid: Solid,
}

/// A body. Lengths are metres, in the link's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// A convex mesh, each vertex once.
    Mesh(Mesh),
    /// A box: the pose of its centre and axes, and half of each side.
    Box {
        /// The pose of the box's own frame.
        pose: Isometry3<f64>,
        /// Half of each side, along its own axes.
        half_extents: [f64; 3],
    },
    /// A sphere.
    Sphere {
        /// The centre.
        centre: [f64; 3],
        /// The radius.
        radius: f64,
    },
}

impl Robot {
    /// The shapes of one kind, by link and piece. Links without geometry have none. Meshes are read from their files,
    /// each time.
    ///
    /// # Errors
    /// Where the module that has them is missing or of no use, or a mesh cannot be read.
    pub fn shapes(&self, kind: ShapeKind) -> Result<Vec<LinkShape>, RobotError> {
        let part = self.part(&[kind.module()])?;
        if matches!(kind, ShapeKind::Hulls | ShapeKind::Pieces) {
            return Meshes::new(&part, kind.module())?.all();
        }
        let lists = part
            .document(ModuleKind::LinkShapesApproximations)
            .and_then(approximations)
            .ok_or(RobotError::Missing(ModuleKind::LinkShapesApproximations))?;
        let list = lists
            .into_iter()
            .find(|list| list.kind == kind.of_document());
        let links = list.map_or_else(Vec::new, |list| list.links);
        let one = |(link, volumes): (usize, Vec<Volume>)| {
            let shapes = volumes.into_iter().enumerate();
            shapes.map(move |(piece, volume)| LinkShape {
                link,
                piece,
                solid: solid(volume),
            })
        };
        Ok(links.into_iter().enumerate().flat_map(one).collect())
    }
}

fn solid(volume: Volume) -> Solid {
    match volume {
        Volume::Box {
            half_extents,
            offset,
            rpy,
        } => Solid::Box {
            pose: Isometry3::from_parts(Translation3::from(offset), from_rpy(rpy)),
            half_extents,
        },
        Volume::Sphere { radius, offset } => Solid::Sphere {
            centre: offset,
            radius,
        },
    }
}
