//! Shared by commands that query a robot: opening it, and the kind of shapes.

use std::path::Path;

use clap::ValueEnum;

use super::foreign;
use urdd_directory::discover::DiscoverError;
use urdd_directory::source::is_archive;
use urdd_format::escape;
use urdd_robot::{Robot, ShapeKind};

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Shapes {
    /// The convex pieces of links.
    Pieces,
    /// The convex hulls of links.
    Hulls,
    /// The bounding boxes of hulls.
    Boxes,
    /// The bounding spheres of hulls.
    Spheres,
    /// The bounding boxes of pieces.
    PieceBoxes,
    /// The bounding spheres of pieces.
    PieceSpheres,
}

impl Shapes {
    pub fn kind(self) -> ShapeKind {
        match self {
            Shapes::Pieces => ShapeKind::Pieces,
            Shapes::Hulls => ShapeKind::Hulls,
            Shapes::Boxes => ShapeKind::Boxes,
            Shapes::Spheres => ShapeKind::Spheres,
            Shapes::PieceBoxes => ShapeKind::PieceBoxes,
            Shapes::PieceSpheres => ShapeKind::PieceSpheres,
        }
    }
}

/// Opens the robot of a URDD.
///
/// # Errors
/// A message with advice if it cannot be opened.
pub fn open(path: &Path) -> Result<Robot, String> {
    if path.is_file() && !is_archive(path) {
        let path = path.display().to_string();
        if path.ends_with(".urdf") {
            let shown = escape::line(&path);
            return Err(format!(
                "{shown}: this is a URDF; generate a URDD from it first: urdd generate {} -o DIR",
                escape::shell(&path)
            ));
        }
        return Err(foreign::advice(&DiscoverError::NotAFolder { path }));
    }
    Robot::open(path).map_err(|error| escape::line(&error.to_string()).into_owned())
}
