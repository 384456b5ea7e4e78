//! Hulls of coplanar points: a two-sided polygon.

use super::predicates::{Point, lexicographic, turn};
use crate::polygon::fan;

/// The polygon's triangles, front and back. `triangle` is three points that are not collinear.
pub fn triangulate(points: &[Point], triangle: [u32; 3]) -> Vec<[u32; 3]> {
    let mut corners = outline(points, triangle);
    let mut triangles: Vec<[u32; 3]> = fan(&corners).collect();
    // The two fans start from different corners and share no diagonal, so no edge is in four triangles.
    let step = corners.len().min(1);
    corners.rotate_left(step);
    triangles.extend(fan(&corners).map(|[a, b, c]| [a, c, b]));
    triangles
}

/// The polygon's corners in order: the monotone chain on the projection along the axis closest to the plane's normal.
/// The projection preserves lines and betweenness.
fn outline(points: &[Point], triangle: [u32; 3]) -> Vec<u32> {
    let [a, b, c] = triangle.map(|i| points[i as usize]);
    let shadows = [[1, 2], [2, 0], [0, 1]];
    let size =
        |[i, j]: [usize; 2]| ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i])).abs();
    // Rounding can make the largest area 0, so only projections with an exact non-zero orientation qualify.
    let best = shadows
        .into_iter()
        .filter(|[i, j]| turn([a[*i], a[*j]], [b[*i], b[*j]], [c[*i], c[*j]]).is_ne())
        .max_by(|s, t| size(*s).total_cmp(&size(*t)));
    let Some([i, j]) = best else {
        return Vec::new();
    };
    let shadow = |p: u32| [points[p as usize][i], points[p as usize][j]];
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|p, q| {
        let ([px, py], [qx, qy]) = (shadow(*p), shadow(*q));
        px.total_cmp(&qx)
            .then(py.total_cmp(&qy))
            .then_with(|| lexicographic(&points[*p as usize], &points[*q as usize]))
    });
    order.dedup_by(|p, q| shadow(*p) == shadow(*q));
    monotone_chain(&order, |u, v, p| turn(shadow(u), shadow(v), shadow(p)).is_gt())
}

/// The corners of the convex hull of sorted points, counterclockwise: Andrew's monotone chain.
pub fn monotone_chain<P: Copy>(sorted: &[P], turns_left: impl Fn(P, P, P) -> bool) -> Vec<P> {
    let mut polygon = Vec::with_capacity(sorted.len() + 1);
    for backwards in [false, true] {
        let fixed = polygon.len();
        for k in 0..sorted.len() {
            let p = sorted[if backwards { sorted.len() - 1 - k } else { k }];
            while let [.., u, v] = polygon[fixed..]
                && !turns_left(u, v, p)
            {
                polygon.pop();
            }
            polygon.push(p);
        }
        polygon.pop();
    }
    polygon
}
