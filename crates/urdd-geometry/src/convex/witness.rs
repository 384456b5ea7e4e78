//! The closest points of two shapes.
//!
//! The descent is that of `gjk`, which records its vertices and their support points on the first shape. The nearest
//! point is a convex combination of the last vertices; the same weights give the closest point on the first shape.

use arrayvec::ArrayVec;
use fearless_simd::{Simd, prelude::*};

use super::gjk::{MAX_ROUNDS, Pair, Record, TOLERANCE};
use super::support::Support;
use crate::lanes::{LANES, Mask, Vec3};

/// The distance of two shapes and their closest points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// Distance, metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The closest points on the first and the second shape, metres. If the shapes overlap, both are one common point.
    pub points: [[f64; 3]; 2],
}

/// The way of a descent.
struct Way<S: Simd> {
    /// Each vertex of the Minkowski difference so far, and its support point on the first shape.
    vertices: ArrayVec<[Vec3<S>; 2], MAX_VERTICES>,
    /// The vertices of the nearest feature.
    feature: [Vec3<S>; 3],
    /// The fourth vertex, in the lanes of `inside`.
    last: Vec3<S>,
    /// Lanes whose simplex encloses the origin.
    inside: Mask<S>,
}

/// The most vertices of a descent: the first, and one for each round.
const MAX_VERTICES: usize = MAX_ROUNDS + 1;

impl<S: Simd> Record<S> for Way<S> {
    #[inline(always)]
    fn vertex(&mut self, vertex: Vec3<S>, on_a: Vec3<S>) {
        if self.vertices.is_empty() {
            self.feature = [vertex; 3];
        }
        let _ = self.vertices.try_push([vertex, on_a]);
    }

    #[inline(always)]
    fn feature(&mut self, vertices: [Vec3<S>; 3], moved: Mask<S>, inside: Mask<S>) {
        for (kept, new) in self.feature.iter_mut().zip(vertices) {
            *kept = Vec3::select(moved, new, *kept);
        }
        if let Some([newest, _]) = self.vertices.last() {
            self.last = Vec3::select(inside, *newest, self.last);
        }
        self.inside |= inside;
    }
}

impl<S: Simd> Way<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let none = Vec3::splat(simd, [0.0; 3]);
        let inside = Mask::from_bitmask(simd, 0);
        Self { vertices: ArrayVec::new(), feature: [none; 3], last: none, inside }
    }

    /// The closest points in a lane, relative to the centre of the first shape, and the deviation of their distance from
    /// `distance`.
    #[inline(always)]
    fn witness(&self, lane: usize, distance: f64) -> (Witness, f64) {
        let feature = self.feature.map(|vertex| vertex.lane(lane));
        if self.inside.to_bitmask() >> lane & 1 == 0 {
            return self.combined(lane, distance, feature, of_triangle(feature.map(Into::into)));
        }
        let [a, b, c] = feature;
        let simplex = [a, b, c, self.last.lane(lane)];
        self.combined(lane, distance, simplex, weights(&simplex))
    }

    /// The closest points, from vertices and their weights.
    #[inline(always)]
    fn combined<const N: usize>(
        &self,
        lane: usize,
        distance: f64,
        vertices: [[f64; 3]; N],
        weights: [f64; N],
    ) -> (Witness, f64) {
        let mut on_a = [0.0; 3];
        let mut apart = [0.0; 3];
        for (vertex, weight) in vertices.into_iter().zip(weights) {
            // By value: of equal vertices, the first.
            let same = |[of, _]: &&[Vec3<S>; 2]| of.lane(lane) == vertex;
            let Some([_, support]) = self.vertices.iter().find(same) else { continue };
            let support = support.lane(lane);
            for k in 0..3 {
                on_a[k] += weight * support[k];
                apart[k] += weight * vertex[k];
            }
        }
        let on_b = if distance > 0.0 { [0, 1, 2].map(|k| on_a[k] - apart[k]) } else { on_a };
        let found = Witness { distance, points: [on_a, on_b] };
        let length = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
        (found, (length - distance).abs())
    }
}

impl<S: Simd, T: Support> Pair<'_, S, T> {
    /// The distances and closest points in the lanes of the bit set `lanes`, relative to the centre of `a`.
    #[inline(always)]
    pub fn witnesses(&self, lanes: u64) -> [Witness; LANES] {
        let mut way = Way::new(self.simd);
        let bounds = self.descend::<_, false>(-self.pose.shift, lanes, &mut way);
        let distances = self.sure(&bounds);
        std::array::from_fn(|lane| {
            let (found, off) = way.witness(lane, distances[lane]);
            if off <= TOLERANCE || lanes >> lane & 1 == 0 {
                return found;
            }
            let again = self.single(lane).witness_from_octants(distances[lane]);
            if again.1 < off { again.0 } else { found }
        })
    }

    /// The closest points of two shapes in one pose, and their error: the best of eight descents, one from each octant.
    /// Used when rounding stopped the first descent.
    #[inline(never)]
    fn witness_from_octants(&self, distance: f64) -> (Witness, f64) {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let mut way = Way::new(self.simd);
                self.descend_from_octants(&mut way);
                let mut best = way.witness(0, distance);
                for lane in 1..LANES {
                    let other = way.witness(lane, distance);
                    if other.1 < best.1 {
                        best = other;
                    }
                }
                best
            },
        )
    }
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
