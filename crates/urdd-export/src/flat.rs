//! Boxes in the place of convex meshes without volume, which programs refuse.

use nalgebra::Isometry3;

use super::error::{ExportError, Note};
use super::subject::Subject;
use urdd_robot::{LinkShape, ShapeKind, Solid};

/// The bounding boxes of a robot's shapes, if these are meshes.
pub(super) struct FlatShapes {
    boxes: Vec<LinkShape>,
    links: Vec<String>,
}

impl FlatShapes {
    pub fn new(subject: &Subject) -> Result<Self, ExportError> {
        let boxes = match subject.shapes {
            ShapeKind::Pieces => subject.shapes(ShapeKind::PieceBoxes)?,
            ShapeKind::Hulls => subject.shapes(ShapeKind::Boxes)?,
            _ => Vec::new(),
        };
        Ok(FlatShapes { boxes, links: subject.links.clone() })
    }

    /// The box of a flat piece, as pose and half extents, and a note.
    pub fn cuboid(
        &self,
        piece: usize,
        link: usize,
        notes: &mut Vec<Note>,
    ) -> Result<(Isometry3<f64>, [f64; 3]), ExportError> {
        let thickness = "0.000002";
        notes.push(Note::Flat { link: self.links[link].clone(), thickness });
        let mut boxes = self.boxes.iter();
        match boxes.find(|of| of.link == link && of.piece == piece).map(|found| &found.solid) {
            Some(Solid::Box { pose, half_extents }) => Ok((*pose, *half_extents)),
            _ => Err(ExportError::NoShapes(ShapeKind::PieceBoxes)),
        }
    }
}
