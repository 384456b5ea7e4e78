//! Distances of several pairs at once: one lane is one pair. In [`super::pair_distances`] the lanes are samples of one
//! pair.
//!
//! A lane's result does not depend on the other lanes, so distances are bit-identical for any grouping of the pairs.

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use nalgebra::Isometry3;

use super::gjk::{self, Pair};
use super::shape::ConvexShape;
use super::support::{Support, cells, farthest};
use super::witness::Witness;
pub use crate::lanes::columns;
use crate::lanes::{LANES, Num, Pose, Vec3};
use crate::vector::dot;

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

/// One shape per lane.
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
