//! Primitives that are fitted to meshes: their sizes and frames.

use nalgebra::{Isometry3, Point3, Translation3};
use urdd_geometry::mesh::Bounds;

use super::super::refusal::{Fallible, at};
use super::assets::Assets;
use super::compiler::Compiler;
use super::fault::MjcfFault;
use super::geom::{Geom, GeomKind};
use super::mesh::Meshes;
use super::principal::principal;

/// A shape with its size: its frame in its body's, radius and half lengths.
#[derive(Debug, Clone, Copy)]
pub struct Fitted {
    pub pose: Isometry3<f64>,
    pub size: [f64; 3],
}

/// The size and the frame of a shape.
pub fn fitted(
    geom: &Geom<'_>,
    compiler: &Compiler,
    meshes: &mut Meshes<'_>,
    assets: &Assets<'_>,
) -> Fallible<Fitted> {
    let mesh = match geom.mesh {
        Some(mesh) if geom.kind.sizes() > 0 => mesh,
        _ => return Ok(Fitted { pose: geom.pose, size: geom.size }),
    };
    let measures = meshes.measures(mesh, geom.place, assets)?;
    let (moments, axes) = principal(&measures.inertia);
    let mut frame = Isometry3::from_parts(measures.centre.coords.into(), axes);
    let [a, b, c] = match compiler.fits_boxes {
        false => {
            // The half lengths of the box that has these moments.
            let sum: f64 = moments.iter().sum();
            moments.map(|moment| (1.5 * (sum - 2.0 * moment).max(0.0) / measures.mass).sqrt())
        }
        true => {
            let placed = meshes.placed(mesh, geom.place, assets)?;
            let points = placed
                .vertices
                .iter()
                .map(|vertex| frame.inverse_transform_point(&Point3::from(*vertex)).coords.into());
            let bounds = Bounds::of(points);
            let centre = [0, 1, 2].map(|axis| (bounds.min[axis] + bounds.max[axis]) / 2.0);
            frame *= Translation3::from(centre);
            bounds.size().map(|length| length / 2.0)
        }
    };
    let size = match (geom.kind, compiler.fits_boxes) {
        (GeomKind::Sphere, false) => [(a + b + c) / 3.0, 0.0, 0.0],
        (GeomKind::Sphere, true) => [a.max(b).max(c), 0.0, 0.0],
        (GeomKind::Capsule, false) => [(a + b) / 2.0, (c - (a + b) / 4.0).max(0.0), 0.0],
        (GeomKind::Cylinder, false) => [(a + b) / 2.0, c, 0.0],
        (GeomKind::Capsule, true) => [a.max(b), c - a.max(b), 0.0],
        (GeomKind::Cylinder, true) => [a.max(b), c, 0.0],
        _ => [a, b, c],
    };
    let size = size.map(|size| size * geom.fit_scale);
    if let Some(wrong) = size[..geom.kind.sizes()].iter().position(|size| *size <= 0.0) {
        return Err(at(geom.place, MjcfFault::Size(wrong + 1)));
    }
    Ok(Fitted { pose: geom.pose * frame, size })
}
