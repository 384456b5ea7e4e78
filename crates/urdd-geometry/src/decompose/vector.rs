//! Vectors and triangles of the search.

pub(super) use crate::mesh::Bounds;
pub(super) use crate::vector::{cross, dot, norm, sub};

/// The point at parameter `t` from `a` to `b`.
pub(super) fn lerp(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])]
}

/// The normal of a triangle; its length is twice the area.
pub(super) fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    cross(sub(b, a), sub(c, a))
}

/// The mean of a triangle's corners.
pub(super) fn centroid([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0)
}

/// Distance of a point from a triangle.
pub(super) fn distance_to_triangle(p: [f64; 3], triangle: [[f64; 3]; 3]) -> f64 {
    norm(sub(p, nearest_on_triangle(p, triangle)))
}

/// The point of a triangle that is nearest to `p` (Ericson, "Real-Time Collision Detection", 5.1.5).
pub(super) fn nearest_on_triangle(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return lerp(a, b, d1 / (d1 - d3));
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return lerp(a, c, d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return lerp(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    if sum > 0.0 {
        let (v, w) = (vb / sum, vc / sum);
        [0, 1, 2].map(|i| a[i] + ab[i] * v + ac[i] * w)
    } else {
        // A degenerate triangle that no edge case handled: its nearest corner bounds the distance.
        let near = |q: [f64; 3], r: [f64; 3]| {
            if norm(sub(p, r)) < norm(sub(p, q)) { r } else { q }
        };
        near(near(a, b), c)
    }
}
