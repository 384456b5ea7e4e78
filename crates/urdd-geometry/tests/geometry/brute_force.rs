//! Distance of two convex hulls of few points by trying everything: the second implementation.
//!
//! The nearest points of disjoint hulls lie on triangles of the points; all are tried. Hulls overlap if a
//! triangle of one meets a triangle of the other, or if one is inside the other, that is, if a point of it is
//! in a tetrahedron of the other's points.

use nalgebra::{Matrix3, Vector3};

pub type Point = Vector3<f64>;

/// Distance of the hulls of `a` and `b`, at least one point each; 0 if they meet.
pub fn distance(a: &[Point], b: &[Point]) -> f64 {
    let (of_a, of_b) = (triangles(a), triangles(b));
    if in_hull(a[0], b) || in_hull(b[0], a) {
        return 0.0;
    }
    let mut least = f64::INFINITY;
    for s in &of_a {
        for t in &of_b {
            least = least.min(triangle_triangle(s, t));
        }
    }
    least
}

/// All triples of the points, with repetition if there are fewer.
fn triangles(p: &[Point]) -> Vec<[Point; 3]> {
    let n = p.len();
    let mut all = Vec::new();
    for i in 0..n {
        for j in i..n {
            for k in j..n {
                if n < 3 || (i < j && j < k) {
                    all.push([p[i], p[j], p[k]]);
                }
            }
        }
    }
    all
}

fn in_hull(p: Point, points: &[Point]) -> bool {
    let n = points.len();
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                for l in k + 1..n {
                    let e = [points[j] - points[i], points[k] - points[i], points[l] - points[i]];
                    let longest = e.iter().map(|e| e.norm()).fold(0.0, f64::max);
                    let m = Matrix3::from_columns(&e);
                    if m.determinant().abs() <= 1e-12 * longest.powi(3) {
                        continue;
                    }
                    let inside = |x: Point| x.min() >= 0.0 && x.sum() <= 1.0;
                    if m.lu().solve(&(p - points[i])).is_some_and(inside) {
                        return true;
                    }
                }
            }
        }
    }
    false
}

fn triangle_triangle(s: &[Point; 3], t: &[Point; 3]) -> f64 {
    let mut least = f64::INFINITY;
    for i in 0..3 {
        least = least.min(point_triangle(s[i], t)).min(point_triangle(t[i], s));
        for j in 0..3 {
            least = least.min(segment_segment([s[i], s[(i + 1) % 3]], [t[j], t[(j + 1) % 3]]));
        }
        if pierces([s[i], s[(i + 1) % 3]], t) || pierces([t[i], t[(i + 1) % 3]], s) {
            return 0.0;
        }
    }
    least
}

fn point_segment(p: Point, [a, b]: [Point; 2]) -> f64 {
    let e = b - a;
    let t = ((p - a).dot(&e) / e.norm_squared()).clamp(0.0, 1.0);
    let t = if t.is_nan() { 0.0 } else { t };
    (p - a - e * t).norm()
}

fn point_triangle(p: Point, t: &[Point; 3]) -> f64 {
    let mut least = point_segment(p, [t[0], t[1]])
        .min(point_segment(p, [t[1], t[2]]))
        .min(point_segment(p, [t[2], t[0]]));
    let n = (t[1] - t[0]).cross(&(t[2] - t[0]));
    let longest = (t[1] - t[0]).norm_squared().max((t[2] - t[0]).norm_squared());
    if n.norm() > 1e-12 * longest {
        let inside = (0..3).all(|i| (t[(i + 1) % 3] - t[i]).cross(&(p - t[i])).dot(&n) >= 0.0);
        if inside {
            least = least.min((p - t[0]).dot(&n).abs() / n.norm());
        }
    }
    least
}

/// The ends against the other segment, and the common normal if its feet are inside both.
fn segment_segment(s: [Point; 2], t: [Point; 2]) -> f64 {
    let mut least = point_segment(s[0], t)
        .min(point_segment(s[1], t))
        .min(point_segment(t[0], s))
        .min(point_segment(t[1], s));
    let (d, e, r) = (s[1] - s[0], t[1] - t[0], t[0] - s[0]);
    let n = d.cross(&e);
    if n.norm() > 1e-12 * d.norm() * e.norm() {
        let x = r.cross(&e).dot(&n) / n.norm_squared();
        let y = r.cross(&d).dot(&n) / n.norm_squared();
        if (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) {
            least = least.min(r.dot(&n).abs() / n.norm());
        }
    }
    least
}

fn pierces([a, b]: [Point; 2], t: &[Point; 3]) -> bool {
    let n = (t[1] - t[0]).cross(&(t[2] - t[0]));
    let (ha, hb) = ((a - t[0]).dot(&n), (b - t[0]).dot(&n));
    if ha * hb > 0.0 || ha == hb {
        return false;
    }
    let p = a + (b - a) * (ha / (ha - hb));
    (0..3).all(|i| (t[(i + 1) % 3] - t[i]).cross(&(p - t[i])).dot(&n) >= 0.0)
}
