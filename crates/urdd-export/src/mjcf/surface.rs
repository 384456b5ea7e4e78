//! Meshes that MuJoCo's compiler accepts.

use nalgebra::{Isometry3, Translation3};

use crate::{ExportError, Note, Shape, Shapes, Solid, Subject};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::oriented_box::OrientedBox;
use urdd_geometry::primitives::Primitive;
use urdd_robot::ShapeKind;

/// Smaller areas vanish, m²: well above MuJoCo's mjMINVAL of 1e-15.
const SMALLEST_AREA: f64 = 1e-14;

/// Smaller volumes are treated as flat, m³: well above mjMINVAL too.
const SMALLEST_VOLUME: f64 = 1e-13;

/// A shape that is thinner than this part of its greatest coordinate is treated as flat: binary32 has 24 bits.
const THINNEST: f64 = 1.0 / 1_048_576.0;

/// The least number of vertices of a mesh.
const VERTICES: usize = 4;

/// The most faces, and the largest coordinate, of an STL. An OBJ has no such limits.
const STL_FACES: usize = 200_000;
const STL_REACH: f64 = 1_073_741_824.0;

/// Completes a visual mesh, in binary32: one of fewer than four vertices gets another that no triangle uses, in its
/// middle. False if it has no area.
pub fn complete(mesh: &mut Mesh) -> bool {
    mesh.round_to_f32();
    if mesh.area() < SMALLEST_AREA {
        return false;
    }
    if let [first, .., last] = mesh.vertices[..] {
        let middle = [0, 1, 2].map(|k| f64::midpoint(first[k], last[k]));
        mesh.vertices.resize(mesh.vertices.len().max(VERTICES), middle);
    }
    true
}

/// Whether a convex mesh has no volume, once its coordinates are binary32.
pub fn is_flat(mesh: &Mesh) -> bool {
    let mut rounded = mesh.clone();
    rounded.round_to_f32();
    let Ok(hull) = ConvexHull::new(&rounded.vertices) else {
        return true;
    };
    let (volume, area) = (hull.mesh().signed_volume(), hull.mesh().area());
    hull.is_flat() || volume < SMALLEST_VOLUME || 2.0 * volume < THINNEST * reach(mesh) * area
}

/// Whether MuJoCo reads a mesh from an STL.
pub fn fits_stl(mesh: &Mesh) -> bool {
    mesh.triangles.len() <= STL_FACES && reach(mesh) <= STL_REACH
}

/// The greatest coordinate, m.
fn reach(mesh: &Mesh) -> f64 {
    mesh.vertices.as_flattened().iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// The bounding boxes of a robot's shapes, if these are meshes.
pub(crate) struct FlatShapes {
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
