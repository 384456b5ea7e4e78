//! Hulls of coplanar points: a two-sided polygon.

use super::predicates::{Point, lexicographic, turn};

/// The polygon's triangles, front and back. `triangle` is three points that are not collinear.
pub fn triangulate(points: &[Point], triangle: [u32; 3]) -> Vec<[u32; 3]> {
    let corners = outline(points, triangle);
    let (Some(&first), Some(&second)) = (corners.first(), corners.get(1)) else {
        return Vec::new();
    };
    // The two fans start from different corners and share no diagonal, so no edge is in four triangles.
    let fan = |tip: u32, rest: &[u32]| -> Vec<[u32; 3]> {
        rest.windows(2).map(|pair| [tip, pair[0], pair[1]]).collect()
    };
    let mut triangles = fan(first, &corners[1..]);
    let mut from_second = corners[2..].to_vec();
    from_second.push(first);
    triangles.extend(fan(second, &from_second).iter().map(|[a, b, c]| [*a, *c, *b]));
    triangles
}

/// The polygon's corners in order: Andrew's monotone chain on the projection along the axis closest to the plane's
/// normal. The projection preserves lines and betweenness.
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
    let half = |order: &mut dyn Iterator<Item = u32>| {
        let mut chain: Vec<u32> = Vec::new();
        for p in order {
            while let [.., u, v] = chain[..] {
                if turn(shadow(u), shadow(v), shadow(p)).is_gt() {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut corners = half(&mut order.iter().copied());
    corners.extend(half(&mut order.iter().rev().copied()));
    corners
}
