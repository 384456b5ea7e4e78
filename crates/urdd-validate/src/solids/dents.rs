//! Where a surface that should be convex is not.

use nalgebra::Vector3;

use super::polytope::{Polytope, step};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::surface::distinct;

/// How a closed surface differs from that of a convex body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dents {
    /// Number of faces towards the middle of the vertices.
    pub inward: usize,
    pub faces: usize,
    /// Largest depth of the surface inside the hull of its vertices, m.
    pub depth: f64,
    /// Its place: a vertex or the centroid of a face, m.
    pub place: [f64; 3],
}

/// The dents of a surface; `None` if its vertices have no hull. Of very many points, only some are measured.
pub fn dents(mesh: &Mesh) -> Option<Dents> {
    let vertices = distinct(mesh);
    let hull = ConvexHull::new(&vertices).ok()?.into_mesh();
    let polytope = Polytope::new(&hull)?;
    let sum: Vector3<f64> = vertices.iter().map(|p| Vector3::from(*p)).sum();
    let middle = sum / vertices.len() as f64;
    let mut dents =
        Dents { inward: 0, faces: mesh.triangles.len(), depth: 0.0, place: middle.into() };
    let mut centres = Vec::with_capacity(mesh.triangles.len());
    for triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(*triangle).map(Vector3::from);
        let centre = (a + b + c) / 3.0;
        dents.inward += usize::from((b - a).cross(&(c - a)).dot(&(centre - middle)) < 0.0);
        centres.push(centre.into());
    }
    let every = step(vertices.len() + centres.len(), polytope.num_faces());
    for place in vertices.into_iter().chain(centres).step_by(every) {
        let depth = polytope.depth(place);
        if depth > dents.depth {
            (dents.depth, dents.place) = (depth, place);
        }
    }
    Some(dents)
}
