//! Smooth normals for round surfaces.

use std::ops::AddAssign;

use nalgebra::Vector3;

use super::super::mesh::{Mesh, double_area_normal};
use crate::union_find::Groups;

/// Cosine of the crease angle, 35 degrees. Faces that meet at a smaller angle belong to a round surface. Cylinders of
/// robots have at least a dozen corners, which is 30 degrees; chamfers have 45.
const CREASE: f64 = 0.819_152_044_288_991_8;

/// A mesh with one normal per vertex. The vertices start with those of the mesh, in order. Copies of vertices with
/// several normals, at creases of the surface, follow.
pub(super) struct Shaded {
    pub(super) mesh: Mesh,
    pub(super) normals: Vec<[f32; 3]>,
}

/// Computes the normals of a mesh. Faces around a vertex share a normal as long as adjacent ones meet, along an edge,
/// at less than the crease angle. Each face is weighted by its angle at the vertex.
///
/// The mesh must be welded and have no index out of range.
pub(super) fn shaded(mesh: &Mesh) -> Shaded {
    let units: Vec<Vector3<f64>> = mesh
        .triangles
        .iter()
        .map(|triangle| unit(double_area_normal(mesh.corners(*triangle))))
        .collect();
    // Corners that share a normal.
    let mut groups = Groups::new(mesh.triangles.len() * 3);
    // Each edge of a triangle: its ends in ascending order, and the corner at which it starts.
    let mut edges: Vec<([u32; 2], usize)> = Vec::with_capacity(mesh.triangles.len() * 3);
    for (at, triangle) in mesh.triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            edges.push(([a.min(b), a.max(b)], 3 * at + k));
        }
    }
    edges.sort_unstable();
    for pair in edges.windows(2) {
        let ((ends, first), (others, second)) = (pair[0], pair[1]);
        if ends != others || units[first / 3].dot(&units[second / 3]) < CREASE {
            continue;
        }
        // The corners at which the edge starts and ends.
        let corners = |corner: usize| [corner, corner / 3 * 3 + (corner + 1) % 3];
        let vertex = |corner: usize| mesh.triangles[corner / 3][corner % 3];
        for one in corners(first) {
            for other in corners(second) {
                if vertex(one) == vertex(other) {
                    groups.join(one, other);
                }
            }
        }
    }
    drop(edges);
    let mut sums = vec![Vector3::zeros(); mesh.triangles.len() * 3];
    for (at, triangle) in mesh.triangles.iter().enumerate() {
        let corners = mesh.corners(*triangle).map(Vector3::from);
        for k in 0..3 {
            let (u, v) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
            let angle = u.cross(&v).norm().atan2(u.dot(&v));
            sums[groups.first(3 * at + k)].add_assign(units[at] * angle);
        }
    }
    let mut out =
        Shaded { mesh: mesh.clone(), normals: vec![[0.0, 0.0, 1.0]; mesh.vertices.len()] };
    const FREE: u32 = u32::MAX;
    let mut vertex_of = vec![FREE; mesh.triangles.len() * 3];
    let mut is_taken = vec![false; mesh.vertices.len()];
    for at in 0..mesh.triangles.len() * 3 {
        let group = groups.first(at);
        let vertex = mesh.triangles[at / 3][at % 3];
        if vertex_of[group] == FREE {
            // If opposite faces cancel, use the normal of the first face.
            let sum = sums[group];
            let normal = if sum.norm() > 1e-6 { unit(sum) } else { units[group / 3] };
            let normal: [f32; 3] = normal.map(|x| x as f32 + 0.0).into();
            if is_taken[vertex as usize] {
                // The number of corners fits the index type.
                vertex_of[group] = u32::try_from(out.mesh.vertices.len()).unwrap_or(vertex);
                out.mesh.vertices.push(mesh.vertices[vertex as usize]);
                out.normals.push(normal);
            } else {
                is_taken[vertex as usize] = true;
                vertex_of[group] = vertex;
                out.normals[vertex as usize] = normal;
            }
        }
        out.mesh.triangles[at / 3][at % 3] = vertex_of[group];
    }
    out
}

fn unit(vector: Vector3<f64>) -> Vector3<f64> {
    vector.try_normalize(0.0).unwrap_or_else(Vector3::z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::{cuboid, cylinder, sphere};

    #[test]
    fn a_box_has_three_normals_at_each_corner() {
        let found = shaded(&cuboid([1.0, 2.0, 3.0]));
        assert_eq!(found.mesh.vertices.len(), 24);
        assert_eq!(found.mesh.vertices[..8], cuboid([1.0, 2.0, 3.0]).vertices);
        for (triangle, normal) in
            found.mesh.triangles.iter().flat_map(|t| t.map(|v| (*t, found.normals[v as usize])))
        {
            let face = unit(double_area_normal(found.mesh.corners(triangle)));
            assert_eq!(face.map(|x| x as f32), Vector3::from(normal));
        }
    }

    #[test]
    fn a_sphere_has_the_normals_of_a_sphere() {
        let mesh = sphere(0.5);
        let found = shaded(&mesh);
        assert_eq!(found.mesh, mesh);
        for (vertex, normal) in found.mesh.vertices.iter().zip(&found.normals) {
            let radial = Vector3::from(*vertex) / 0.5;
            let normal = Vector3::from(normal.map(f64::from));
            assert!((normal.norm() - 1.0).abs() < 1e-6);
            // One degree.
            assert!(normal.dot(&radial) > 0.9998, "{vertex:?} {normal:?}");
        }
    }

    #[test]
    fn a_cylinder_is_round_and_its_caps_are_flat() {
        let found = shaded(&cylinder(0.1, 0.4));
        for (vertex, normal) in found.mesh.vertices.iter().zip(&found.normals) {
            let along = f64::from(normal[2]);
            let radial =
                (f64::from(normal[0]) * vertex[0] + f64::from(normal[1]) * vertex[1]) / 0.1;
            assert!(along.abs() > 0.9999 || radial > 0.9999, "{vertex:?} {normal:?}");
        }
    }
}
