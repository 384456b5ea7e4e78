//! Where a surface that should be convex is not.

use urdd_geometry::primitives::cuboid;
use urdd_validate::solids::polytope::*;

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
