//! Removal of corners that doubles cannot distinguish from an edge.

use nalgebra::Vector3;

use super::super::mesh::Mesh;
use super::predicates::Point;

/// Maximum number of removal rounds. Each round removes about half of a row of such corners.
pub const ROUNDS: usize = 32;

/// The vertices, except those closer to the segment between two others than `thinnest` times its length, judged by the
/// mesh's triangles; `None` if all remain.
pub fn without_slivers(mesh: &Mesh, thinnest: f64) -> Option<Vec<Point>> {
    let mut dropped = vec![false; mesh.vertices.len()];
    let mut anchored = vec![false; mesh.vertices.len()];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| Vector3::from(mesh.vertices[i as usize]));
        // Squared length of the edge opposite corner k.
        let opposite = |k: usize| (corners[(k + 2) % 3] - corners[(k + 1) % 3]).norm_squared();
        let apex = (0..3).max_by(|j, k| opposite(*j).total_cmp(&opposite(*k))).unwrap_or(0);
        let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).norm();
        if area >= thinnest * opposite(apex) {
            continue;
        }
        let [apex, from, to] = [0, 1, 2].map(|k| triangle[(apex + k) % 3] as usize);
        // The ends of the segment stay in this round: the apex is dropped because it is close to them.
        if !anchored[apex] && !dropped[from] && !dropped[to] {
            dropped[apex] = true;
            anchored[from] = true;
            anchored[to] = true;
        }
    }
    dropped.contains(&true).then(|| {
        let kept = mesh.vertices.iter().zip(&dropped).filter(|(_, dropped)| !**dropped);
        kept.map(|(vertex, _)| *vertex).collect()
    })
}
