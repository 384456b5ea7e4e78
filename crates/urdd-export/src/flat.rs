//! Boxes in the place of meshes without volume, which programs refuse.

use nalgebra::{Isometry3, Translation3};

use super::error::{ExportError, Note};
use super::shapes::{Shape, Shapes, Solid};
use super::subject::Subject;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::oriented_box::OrientedBox;
use urdd_geometry::primitives::Primitive;
use urdd_robot::ShapeKind;

/// The bounding boxes of a robot's shapes, if these are meshes.
pub(super) struct FlatShapes {
    boxes: Vec<Vec<Shape>>,
    links: Vec<String>,
}

impl FlatShapes {
    pub fn new(subject: &Subject) -> Result<Self, ExportError> {
        let boxes = match subject.shapes {
            Shapes::Kind(ShapeKind::Pieces) => subject.shapes_of(ShapeKind::PieceBoxes)?,
            Shapes::Kind(ShapeKind::Hulls) => subject.shapes_of(ShapeKind::Boxes)?,
            _ => Vec::new(),
        };
        Ok(FlatShapes { boxes, links: subject.links.clone() })
    }

    /// The box of a flat mesh, the link's piece of this number or another, and a note.
    pub fn cuboid(
        &self,
        mesh: &Mesh,
        piece: usize,
        link: usize,
        notes: &mut Vec<Note>,
    ) -> (Isometry3<f64>, Primitive) {
        let thickness = "0.000002";
        notes.push(Note::Flat { link: self.links[link].clone(), thickness });
        let mut boxes = self.boxes.get(link).into_iter().flatten();
        match boxes.find(|of| of.number == piece).map(|found| &found.solid) {
            Some(Solid::Primitive(pose, primitive)) => (*pose, *primitive),
            _ => around(mesh),
        }
    }
}

/// The smallest box around a mesh; along the axes where its points are on a line.
fn around(mesh: &Mesh) -> (Isometry3<f64>, Primitive) {
    match ConvexHull::new(&mesh.vertices) {
        Ok(hull) => {
            let of = OrientedBox::around(&hull);
            let pose = Isometry3::from_parts(Translation3::from(of.centre), of.rotation);
            (pose, Primitive::Box(of.half_extents))
        }
        Err(_) => {
            let (centre, half) = mesh.bounds().map_or(([0.0; 3], [0.0; 3]), |of| {
                let half = of.size().map(|side| side / 2.0);
                ([0, 1, 2].map(|k| of.min[k] + half[k]), half)
            });
            (Isometry3::from(Translation3::from(centre)), Primitive::Box(half))
        }
    }
}
