//! Distances and closest points of several pairs at once: one lane is one pair. In [`super::pair_distances`] the lanes are samples of one
//! pair.
//!
//! A lane's result does not depend on the other lanes, so distances are bit-identical for any grouping of the pairs.
//!
//! For the closest points, the descent records its vertices and their support points on the first shape. The nearest point is
//! a convex combination of the last vertices; the same weights give the closest point on the first shape.

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch};
use nalgebra::Isometry3;

use crate::convex::gjk::{self, MAX_ROUNDS, Pair, Record, TOLERANCE};
use crate::convex::shape::{ConvexShape, Support, cells, farthest};
use crate::lanes::{LANES, Mask, Num, Pose, Vec3};
use crate::vector::dot;

pub use crate::lanes::columns;

/// Two convex shapes with their relative pose.
#[derive(Clone, Copy, Debug)]
pub struct PlacedPair<'a> {
    /// The first shape.
    pub a: &'a ConvexShape,
    /// The second shape.
    pub b: &'a ConvexShape,
    /// The pose of the frame of `b` in that of `a`: the columns of the rotation, then the translation, metres.
    pub b_in_a: [[f64; 3]; 4],
}

/// Pairs per batch.
pub const AT_ONCE: usize = LANES;

impl<'a> PlacedPair<'a> {
    /// The pose must be finite.
    pub fn new(a: &'a ConvexShape, b: &'a ConvexShape, b_in_a: &Isometry3<f64>) -> Self {
        Self { a, b, b_in_a: columns(b_in_a) }
    }

    /// Whether the shapes are certainly farther apart than `distance`, metres: the boxes around them, each along the axes of
    /// its frame, are apart along one of these axes.
    pub fn boxes_are_beyond(&self, distance: f64) -> bool {
        let [x, y, z, shift] = self.b_in_a;
        let (own, other) = (self.a.half_extents(), self.b.half_extents());
        let (from, to) = (self.a.centre, self.b.centre);
        let between =
            [0, 1, 2].map(|k| x[k] * to[0] + y[k] * to[1] + z[k] * to[2] + shift[k] - from[k]);
        let size = |v: [f64; 3]| v[0].abs() + v[1].abs() + v[2].abs();
        // More than any rounding, and than what distances are wrong by.
        let gap = distance + 1e-8 + 1e-12 * (size(shift) + size(from) + size(to));
        let along_own = (0..3).any(|k| {
            let reach = x[k].abs() * other[0] + y[k].abs() * other[1] + z[k].abs() * other[2];
            between[k].abs() > own[k] + reach + gap
        });
        along_own
            || [x, y, z].iter().zip(other).any(|(axis, half)| {
                let reach =
                    axis[0].abs() * own[0] + axis[1].abs() * own[1] + axis[2].abs() * own[2];
                dot(*axis, between).abs() > half + reach + gap
            })
    }
}

/// The distance of each pair, metres; 0 if they touch or overlap. `distances` is as long as `pairs`.
pub fn distances(level: Level, pairs: &[PlacedPair], distances: &mut [f64]) {
    for (pairs, out) in pairs.chunks(LANES).zip(distances.chunks_mut(LANES)) {
        let found = dispatch!(level, simd => eight_distances(simd, pairs));
        out.copy_from_slice(&found[..out.len()]);
    }
}

/// Whether any pair touches or overlaps, which is where [`distances`] gives 0.
pub fn any_touches(level: Level, pairs: &[PlacedPair]) -> bool {
    pairs.chunks(LANES).any(|pairs| touching(level, pairs) != 0)
}

/// Like [`any_touches`], for the first [`AT_ONCE`] pairs at most: bit `k` is set if pair `k` touches or overlaps.
pub fn touching(level: Level, pairs: &[PlacedPair]) -> u64 {
    if pairs.is_empty() {
        return 0;
    }
    dispatch!(level, simd => eight_touch(simd, &pairs[..pairs.len().min(LANES)]))
}

/// The distance and closest points of each pair, in the frame of the pair's first shape.
pub fn witnesses(level: Level, pairs: &[PlacedPair]) -> Vec<Witness> {
    let mut found = Vec::with_capacity(pairs.len());
    for pairs in pairs.chunks(LANES) {
        found.extend_from_slice(&some_witnesses(level, pairs)[..pairs.len()]);
    }
    found
}

/// As [`witnesses`], for at least one and at most [`AT_ONCE`] pairs. Those beyond the last pair mean nothing.
pub fn some_witnesses(level: Level, pairs: &[PlacedPair]) -> [Witness; AT_ONCE] {
    dispatch!(level, simd => eight_witnesses(simd, pairs))
}

#[inline(always)]
fn eight_distances<S: Simd>(simd: S, pairs: &[PlacedPair]) -> [f64; LANES] {
    let (a, b, pose) = eight(simd, pairs);
    Pair { simd, a: &a, b: &b, pose }.distances(gjk::first_lanes(pairs.len()), gjk::EXACT)
}

#[inline(always)]
fn eight_touch<S: Simd>(simd: S, pairs: &[PlacedPair]) -> u64 {
    let (a, b, pose) = eight(simd, pairs);
    Pair { simd, a: &a, b: &b, pose }.touching(gjk::first_lanes(pairs.len()))
}

#[inline(always)]
fn eight_witnesses<S: Simd>(simd: S, pairs: &[PlacedPair]) -> [Witness; LANES] {
    let (a, b, pose) = eight(simd, pairs);
    let mut found = Pair { simd, a: &a, b: &b, pose }.witnesses(gjk::first_lanes(pairs.len()));
    for (found, pair) in found.iter_mut().zip(pairs) {
        found.points = found.points.map(|p| [0, 1, 2].map(|k| p[k] + pair.a.centre[k]));
    }
    found
}

struct Eight<'a>([&'a ConvexShape; LANES]);

/// The shapes of up to eight pairs, relative to their centres, and the poses of the second shapes in the frames of the
/// first. The last pair fills the remaining lanes.
#[inline(always)]
fn eight<'a, S: Simd>(simd: S, pairs: &[PlacedPair<'a>]) -> (Eight<'a>, Eight<'a>, Pose<S>) {
    let pair = |lane: usize| &pairs[lane.min(pairs.len() - 1)];
    let mut numbers = [[[0.0; LANES]; 3]; 4];
    let mut centres = [[[0.0; LANES]; 3]; 2];
    for lane in 0..LANES {
        let pair = pair(lane);
        for (to, from) in numbers.iter_mut().zip(&pair.b_in_a) {
            put(to, lane, *from);
        }
        put(&mut centres[0], lane, pair.a.centre);
        put(&mut centres[1], lane, pair.b.centre);
    }
    let load = |v: &[[f64; LANES]; 3]| Vec3::load(simd, [&v[0], &v[1], &v[2]]);
    let mut pose = Pose {
        columns: [load(&numbers[0]), load(&numbers[1]), load(&numbers[2])],
        shift: load(&numbers[3]),
    };
    pose.shift = pose.shift + pose.rotate(load(&centres[1])) - load(&centres[0]);
    let a = Eight(std::array::from_fn(|lane| pair(lane).a));
    let b = Eight(std::array::from_fn(|lane| pair(lane).b));
    (a, b, pose)
}

#[inline(always)]
fn put(lists: &mut [[f64; LANES]; 3], lane: usize, vector: [f64; 3]) {
    for (list, x) in lists.iter_mut().zip(vector) {
        list[lane] = x;
    }
}

impl Support for Eight<'_> {
    type Single = ConvexShape;

    #[inline(always)]
    fn single(&self, lane: usize) -> &ConvexShape {
        self.0[lane]
    }

    #[inline(always)]
    fn support<S: Simd>(&self, simd: S, d: Vec3<S>, lanes: u64) -> Vec3<S> {
        let sides = std::array::from_fn(|lane| self.0[lane].table.side() as f64);
        let cells = cells(simd, Num::load_array(simd, sides), d);
        farthest(simd, |lane| &self.0[lane].table, cells, d, lanes)
    }
}

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
