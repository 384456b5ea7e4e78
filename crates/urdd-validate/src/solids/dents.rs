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
    /// Number of faces.
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

#[cfg(test)]
mod tests {
    use super::*;
    use urdd_geometry::primitives::cuboid;

    #[test]
    fn a_corner_that_is_pushed_in_is_a_dent_of_its_depth() {
        // A pyramid on each side of a cube, one of them pointing inward by 0.25.
        let mut mesh = cuboid([2.0, 2.0, 2.0]);
        mesh.vertices.push([0.0, 0.0, 0.75]);
        let top: Vec<usize> = (0..mesh.triangles.len())
            .filter(|t| mesh.corners(mesh.triangles[*t]).iter().all(|p| p[2] == 1.0))
            .collect();
        assert_eq!(top.len(), 2);
        let apex = 8;
        let split: Vec<[u32; 3]> = top
            .iter()
            .flat_map(|t| {
                let [a, b, c] = mesh.triangles[*t];
                [[a, b, apex], [b, c, apex], [c, a, apex]]
            })
            .collect();
        for t in top.into_iter().rev() {
            mesh.triangles.remove(t);
        }
        // The two halves of the diagonal's triangles cancel.
        mesh.triangles.extend(split);
        let found = dents(&mesh).expect("a hull");
        assert!((found.depth - 0.25).abs() < 1e-12, "{found:?}");
        assert_eq!(found.place, [0.0, 0.0, 0.75]);
        assert_eq!(dents(&cuboid([2.0, 2.0, 2.0])).map(|d| (d.inward, d.depth)), Some((0, 0.0)));
    }
}
