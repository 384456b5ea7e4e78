//! The closest points of two shapes.
//!
//! The descent is that of `gjk`. In addition, each vertex of the simplex keeps its support point on the first shape.
//! The nearest point is a convex combination of the vertices; the same weights give the closest point on the first
//! shape.

use fearless_simd::{Simd, prelude::*};

use super::gjk::{ALL, MAX_ROUNDS, TOLERANCE, octants};
use super::lanes::{LANES, Mask, Pose, Vec3, select, splat};
use super::simplex::{Nearest, segment, tetrahedron, triangle};
use super::support::Support;

/// The distance of two shapes and their closest points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// Distance, metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The closest points on the first and the second shape, metres. If the shapes overlap, both are one common point.
    pub points: [[f64; 3]; 2],
}

/// A simplex of the Minkowski difference: its vertices, and their support points on the first shape.
#[derive(Clone, Copy)]
struct Simplex {
    vertices: [[f64; 3]; 4],
    on_a: [[f64; 3]; 4],
}

/// The closest points in the lanes of the bit set `lanes`, relative to the centre of `a`. `distances` are the known
/// distances.
#[inline(always)]
pub(crate) fn witnesses<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    lanes: u64,
    distances: [f64; LANES],
) -> [Witness; LANES] {
    let simplices = descend(simd, a, b, pose, -pose.shift, lanes);
    std::array::from_fn(|lane| {
        let (found, off) = witness(&simplices[lane], distances[lane]);
        if off <= TOLERANCE || lanes >> lane & 1 == 0 {
            return found;
        }
        let (a, b) = (a.single(lane), b.single(lane));
        let again = from_other_sides(simd, a, b, &pose.lane(lane), distances[lane]);
        if again.1 < off { again.0 } else { found }
    })
}

/// The closest points of two shapes in one pose, and their error: the best of eight descents, one from each octant.
/// Used when rounding stopped the first descent.
#[inline(never)]
fn from_other_sides<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &[[f64; 3]; 4],
    distance: f64,
) -> (Witness, f64) {
    simd.vectorize(
        #[inline(always)]
        || {
            let pose = Pose::same(simd, pose);
            let simplices = descend(simd, a, b, &pose, octants(simd), ALL);
            let mut best = witness(&simplices[0], distance);
            for simplex in &simplices[1..] {
                let other = witness(simplex, distance);
                if other.1 < best.1 {
                    best = other;
                }
            }
            best
        },
    )
}

/// The final simplex of each lane. The descent starts from the point of the difference that is farthest against
/// `start`.
#[inline(always)]
fn descend<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    start: Vec3<S>,
    lanes: u64,
) -> [Simplex; LANES] {
    let tolerance2 = splat(simd, TOLERANCE * TOLERANCE);
    let zero = splat(simd, 0.0);
    let (mut v, first) = farthest(simd, a, b, pose, start, lanes);
    let mut s = [v; 3];
    let mut on_a = [first; 3];
    // The fourth vertex, if the origin is inside.
    let mut last = (v, first);
    let mut squared = v.dot(v);
    let mut done = squared.simd_le(zero) | Mask::from_bitmask(simd, !lanes & ALL);
    for round in 1..=MAX_ROUNDS {
        if done.all_true() {
            break;
        }
        let (w, w_on_a) = farthest(simd, a, b, pose, v, !done.to_bitmask() & ALL);
        let gap = squared - v.dot(w);
        done |= gap.simd_le(zero) | (gap * gap).simd_le(squared * tolerance2);
        if done.all_true() {
            break;
        }
        let Nearest {
            point,
            vertices,
            inside,
        } = match round {
            1 => segment(simd, w, s[0]),
            2 => triangle(simd, w, [s[0], s[1]]),
            _ => tetrahedron(simd, w, s),
        };
        // If the origin is inside, keep all four: the three previous vertices and the new one.
        let enclosing = inside & !done;
        last.0 = Vec3::select(enclosing, w, last.0);
        last.1 = Vec3::select(enclosing, w_on_a, last.1);
        done |= enclosing;
        let least = point.dot(point);
        done |= !least.simd_lt(squared);
        let before = (s, on_a);
        for k in 0..3 {
            // Find the support point of each vertex by value; equal vertices are interchangeable.
            let mut of = w_on_a;
            for (vertex, on_a) in before.0.iter().zip(before.1) {
                of = Vec3::select(equal(*vertex, vertices[k]), on_a, of);
            }
            of = Vec3::select(equal(w, vertices[k]), w_on_a, of);
            s[k] = Vec3::select(done, s[k], vertices[k]);
            on_a[k] = Vec3::select(done, on_a[k], of);
        }
        last.0 = Vec3::select(done, last.0, vertices[0]);
        last.1 = Vec3::select(done, last.1, on_a[0]);
        v = Vec3::select(done, v, point);
        squared = select(done, squared, least);
    }
    std::array::from_fn(|lane| Simplex {
        vertices: [s[0], s[1], s[2], last.0].map(|p| p.lane(lane)),
        on_a: [on_a[0], on_a[1], on_a[2], last.1].map(|p| p.lane(lane)),
    })
}

#[inline(always)]
fn equal<S: Simd>(a: Vec3<S>, b: Vec3<S>) -> Mask<S> {
    a.x.simd_eq(b.x) & a.y.simd_eq(b.y) & a.z.simd_eq(b.z)
}

/// The point of the difference that is farthest against `v`, and its support point on `a`.
#[inline(always)]
fn farthest<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    v: Vec3<S>,
    lanes: u64,
) -> (Vec3<S>, Vec3<S>) {
    let on_a = a.support(simd, -v, lanes);
    let on_b = b.support(simd, pose.rotate_back(v), lanes);
    (on_a - pose.rotate(on_b) - pose.shift, on_a)
}

/// The closest points from the simplex, and the deviation of their distance from `distance`.
fn witness(simplex: &Simplex, distance: f64) -> (Witness, f64) {
    let weights = weights(&simplex.vertices);
    let mean = |points: &[[f64; 3]; 4]| {
        [0, 1, 2].map(|k| (0..4).map(|i| weights[i] * points[i][k]).sum::<f64>())
    };
    let on_a = mean(&simplex.on_a);
    let apart = mean(&simplex.vertices);
    let on_b = match distance > 0.0 {
        true => [0, 1, 2].map(|k| on_a[k] - apart[k]),
        false => on_a,
    };
    let found = Witness {
        distance,
        points: [on_a, on_b],
    };
    let length = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
    (found, (length - distance).abs())
}

/// The weights of the four vertices for the point of their hull nearest to the origin.
fn weights(vertices: &[[f64; 3]; 4]) -> [f64; 4] {
    let point = |i: usize| nalgebra::Vector3::from(vertices[i]);
    // The origin is inside if no weight is negative.
    let edges = [1, 2, 3].map(|i| point(i) - point(0));
    let volume = edges[0].cross(&edges[1]).dot(&edges[2]);
    if volume != 0.0 {
        let to = -point(0);
        let inner = [
            edges[1].cross(&edges[2]).dot(&to) / volume,
            edges[2].cross(&edges[0]).dot(&to) / volume,
            edges[0].cross(&edges[1]).dot(&to) / volume,
        ];
        let rest = 1.0 - inner.iter().sum::<f64>();
        if rest >= 0.0 && inner.iter().all(|x| *x >= 0.0) {
            return [rest, inner[0], inner[1], inner[2]];
        }
    }
    let mut best = ([1.0, 0.0, 0.0, 0.0], point(0).norm_squared());
    for face in [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]] {
        let weights = of_triangle(face.map(point));
        let mut all = [0.0; 4];
        for (i, weight) in face.into_iter().zip(weights) {
            all[i] = weight;
        }
        let at: nalgebra::Vector3<f64> = (0..4).map(|i| point(i) * all[i]).sum();
        if at.norm_squared() < best.1 {
            best = (all, at.norm_squared());
        }
    }
    best.0
}

/// The weights of a triangle's corners for its point nearest to the origin.
///
/// Source: C. Ericson, Real-Time Collision Detection (2005), 5.1.5: the regions of corners, edges and the face.
fn of_triangle([a, b, c]: [nalgebra::Vector3<f64>; 3]) -> [f64; 3] {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (-ab.dot(&a), -ac.dot(&a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (d3, d4) = (-ab.dot(&b), -ac.dot(&b));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3 {
        let t = d1 / (d1 - d3);
        return [1.0 - t, t, 0.0];
    }
    let (d5, d6) = (-ab.dot(&c), -ac.dot(&c));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6 {
        let t = d2 / (d2 - d6);
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 && d4 - d3 + d5 - d6 > 0.0 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - t, t];
    }
    let sum = va + vb + vc;
    if sum > 0.0 {
        return [va / sum, vb / sum, vc / sum];
    }
    [1.0, 0.0, 0.0]
}
