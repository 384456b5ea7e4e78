//! Corners that doubles cannot tell from an edge.

use nalgebra::Vector3;

use super::super::mesh::Mesh;
use super::predicates::Point;

/// Rounds of leaving corners out, at most; each takes about half of a row of them.
pub const ROUNDS: usize = 32;

/// The vertices without those that stand off the segment between two others by less than `thinnest`
/// of its length, as the mesh's triangles show them; `None` if there are none of them.
pub fn without_slivers(mesh: &Mesh, thinnest: f64) -> Option<Vec<Point>> {
    let mut dropped = vec![false; mesh.vertices.len()];
    let mut anchored = vec![false; mesh.vertices.len()];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| Vector3::from(mesh.vertices[i as usize]));
        // The edge opposite corner k, squared.
        let opposite = |k: usize| (corners[(k + 2) % 3] - corners[(k + 1) % 3]).norm_squared();
        let apex = (0..3)
            .max_by(|j, k| opposite(*j).total_cmp(&opposite(*k)))
            .unwrap_or(0);
        let area = (corners[1] - corners[0])
            .cross(&(corners[2] - corners[0]))
            .norm();
        if area >= thinnest * opposite(apex) {
            continue;
        }
        let [apex, from, to] = [0, 1, 2].map(|k| triangle[(apex + k) % 3] as usize);
        // The ends of the segment stay in this round: otherwise the apex has nothing to be near.
        if !anchored[apex] && !dropped[from] && !dropped[to] {
            dropped[apex] = true;
            anchored[from] = true;
            anchored[to] = true;
        }
    }
    dropped.contains(&true).then(|| {
        let kept = mesh
            .vertices
            .iter()
            .zip(&dropped)
            .filter(|(_, dropped)| !**dropped);
        kept.map(|(vertex, _)| *vertex).collect()
    })
}
