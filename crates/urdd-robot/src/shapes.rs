//! Shapes of links: convex hulls, convex pieces, and their bounding boxes and spheres.

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

/// A kind of shapes that approximate links.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ShapeKind {
    /// The convex hull of each link.
    Hulls,
    /// The bounding box of each hull.
    Boxes,
    /// The bounding sphere of each hull.
    Spheres,
    /// The convex pieces of each link.
    Pieces,
    /// The bounding box of each piece.
    PieceBoxes,
    /// The bounding sphere of each piece.
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

    /// Its short name, as used on command lines.
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

    /// Whether a link can have several shapes of this kind.
    pub fn is_of_pieces(self) -> bool {
        !self.of_document().full
    }

    /// The corresponding kind in documents.
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
    /// Index of the link's piece that it is or bounds; 0 for a hull and its bounding volumes.
    pub piece: usize,
    /// The shape.
    pub solid: Solid,
}

/// A solid in the link's frame, in metres.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// A convex mesh, each vertex once.
    Mesh(Mesh),
    /// An oriented box.
    Box {
        /// The pose of its centre and axes.
        pose: Isometry3<f64>,
        /// Half extents along its axes.
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
    /// The shapes of one kind, by link and piece. Links without geometry have none. Every call reads the mesh files.
    ///
    /// # Errors
    /// If their module is missing or unusable, or a mesh cannot be read.
    pub fn shapes(&self, kind: ShapeKind) -> Result<Vec<LinkShape>, RobotError> {
        let part = self.part(&[kind.module()])?;
        if matches!(kind, ShapeKind::Hulls | ShapeKind::Pieces) {
            let meshes = Meshes::new(&part, kind.module())?.all()?.into_iter();
            let shape = |(link, piece, mesh)| LinkShape {
                link,
                piece,
                solid: Solid::Mesh(mesh),
            };
            return Ok(meshes.map(shape).collect());
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
