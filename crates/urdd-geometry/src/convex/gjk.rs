//! The Gilbert-Johnson-Keerthi algorithm for several samples at once.
//!
//! Source: as for `simplex`. The termination test is that of van den Bergen, "A Fast and Robust GJK Implementation for
//! Collision Detection of Convex Objects", J. Graphics Tools 4(2), 1999. Let v be the nearest point so far, and w the
//! support point of the Minkowski difference towards the origin. Then the distance is between v . w / |v| and |v|.

use fearless_simd::{Simd, prelude::*};

use super::simplex::{Nearest, segment, tetrahedron, triangle};
use super::support::Support;
use crate::lanes::{LANES, Mask, Num, Pose, Vec3, select, splat};

/// Maximum error of distances, metres: the upper and lower bound differ by no more. For shapes or offsets beyond 10 km
/// it is 1e-13 of that size.
pub const TOLERANCE: f64 = 1e-9;

/// Shapes nearer than this are in contact, metres.
const CONTACT: f64 = 1e-10;

/// Maximum number of iterations per lane; two to five are usual.
pub(super) const MAX_ROUNDS: usize = 64;

/// The range of distances whose exact values do not matter, metres: none.
pub(crate) const EXACT: [f64; 2] = [0.0, -1.0];

/// Bit set of all lanes.
pub(crate) const ALL: u64 = (1 << LANES) - 1;

/// Bit set of the first `count` lanes, or of all.
#[inline(always)]
pub(crate) fn first_lanes(count: usize) -> u64 {
    if count < LANES { (1 << count) - 1 } else { ALL }
}

/// What a descent found.
pub(crate) struct Bounds<S: Simd> {
    /// Upper bounds of the distances.
    pub upper: Num<S>,
    /// Lanes that touch or overlap.
    contact: Mask<S>,
    /// Lanes whose bounds differ by more than the tolerance, because rounding stopped the descent.
    pub unsure: Mask<S>,
}

/// What is asked of a descent, and what it records of its way for the closest points.
pub(crate) trait Record<S: Simd> {
    /// The range of distances whose exact values do not matter, metres.
    fn within(&self) -> [f64; 2] {
        EXACT
    }

    /// A new vertex of the difference, and its support point on the first shape.
    fn vertex(&mut self, vertex: Vec3<S>, on_a: Vec3<S>);

    /// The vertices of the nearest feature, in the lanes of `moved`; in those of `inside`, the simplex of the feature
    /// before and of the newest vertex encloses the origin.
    fn feature(&mut self, vertices: [Vec3<S>; 3], moved: Mask<S>, inside: Mask<S>);
}

/// Distances alone, which need nothing of the way, and the range of those whose exact values do not matter.
struct Alone([f64; 2]);

impl<S: Simd> Record<S> for Alone {
    #[inline(always)]
    fn within(&self) -> [f64; 2] {
        self.0
    }

    #[inline(always)]
    fn vertex(&mut self, _: Vec3<S>, _: Vec3<S>) {}

    #[inline(always)]
    fn feature(&mut self, _: [Vec3<S>; 3], _: Mask<S>, _: Mask<S>) {}
}

/// Two shapes relative to their centres, and the poses of the second in the frames of the first.
pub(crate) struct Pair<'a, S: Simd, T> {
    pub simd: S,
    pub a: &'a T,
    pub b: &'a T,
    pub pose: Pose<S>,
}

impl<'a, S: Simd, T: Support> Pair<'a, S, T> {
    /// The shapes and the pose of one lane, in all lanes.
    #[inline(always)]
    pub fn single(&self, lane: usize) -> Pair<'a, S, T::Single> {
        let pose = Pose::same(self.simd, &self.pose.lane(lane));
        Pair { simd: self.simd, a: self.a.single(lane), b: self.b.single(lane), pose }
    }

    /// Distances in the lanes of the bit set `lanes`. In place of a distance in the range `within`, the result may be any
    /// number in it.
    #[inline(always)]
    pub fn distances(&self, lanes: u64, within: [f64; 2]) -> [f64; LANES] {
        let bounds = self.descend::<_, false>(-self.pose.shift, lanes, &mut Alone(within));
        self.sure(&bounds)
    }

    /// The distances that a descent found. Where rounding stopped it, from other sides.
    #[inline(always)]
    pub fn sure(&self, bounds: &Bounds<S>) -> [f64; LANES] {
        let mut distances = bounds.upper.to_array();
        let mut unsure = bounds.unsure.to_bitmask();
        while unsure != 0 {
            let lane = unsure.trailing_zeros() as usize & (LANES - 1);
            unsure &= unsure - 1;
            distances[lane] = self.single(lane).distance_from_octants(distances[lane]);
        }
        distances
    }

    /// The distance of two shapes in one pose, descending from all eight octants. Returns the first converged result,
    /// otherwise the least upper bound, including `upper`.
    #[inline(never)]
    fn distance_from_octants(&self, upper: f64) -> f64 {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let bounds = self.descend_from_octants(&mut Alone(EXACT));
                let unsure = bounds.unsure.to_bitmask() & ALL;
                if unsure != ALL {
                    return bounds.upper[(!unsure).trailing_zeros() as usize & (LANES - 1)];
                }
                let mut least = upper;
                for lane in 0..LANES {
                    least = least.min(bounds.upper[lane]);
                }
                least
            },
        )
    }

    /// Descends in one pose from a direction into each octant.
    #[inline(always)]
    pub fn descend_from_octants(&self, record: &mut impl Record<S>) -> Bounds<S> {
        let mut octants = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            for (axis, octant) in octants.iter_mut().enumerate() {
                octant[lane] = if lane >> axis & 1 == 0 { 1.0 } else { -1.0 };
            }
        }
        let octants = Vec3::load(self.simd, [&octants[0], &octants[1], &octants[2]]);
        self.descend::<_, false>(octants, ALL, record)
    }

    /// Runs the descent. It starts from the point of the difference A - B that is farthest against `start`. A descent for
    /// contact alone (`CONTACT_ALONE`) stops in a lane as soon as it finds a separating plane, any other as soon as the
    /// distance is known to be in the range of `record`.
    #[inline(always)]
    pub fn descend<R: Record<S>, const CONTACT_ALONE: bool>(
        &self,
        start: Vec3<S>,
        lanes: u64,
        record: &mut R,
    ) -> Bounds<S> {
        let simd = self.simd;
        let [low, high] = record.within();
        let low2 = splat(simd, low * low);
        // No square is below a negative number.
        let high2 = splat(simd, high.min(1e9) * high.abs().min(1e9));
        let contact2 = splat(simd, CONTACT * CONTACT);
        let tolerance2 = splat(simd, TOLERANCE * TOLERANCE);
        let zero = splat(simd, 0.0);
        let mut v = self.farthest(start, lanes, record);
        let mut s = [v; 3];
        let mut squared = v.dot(v);
        let mut contact = squared.simd_le(contact2);
        let mut done = contact | Mask::from_bitmask(simd, !lanes & ALL);
        let mut unsure = Mask::splat(simd, false);
        for round in 1..=MAX_ROUNDS {
            if done.all_true() {
                break;
            }
            let w = self.farthest(v, !done.to_bitmask() & ALL, record);
            // The distance is between v . w / |v| and |v|.
            let along = v.dot(w);
            let gap = squared - along;
            let decided = match CONTACT_ALONE {
                true => along.simd_gt(zero) & (along * along).simd_gt(contact2 * squared),
                false => {
                    let below = squared.simd_le(high2);
                    let above = along.simd_ge(zero) & (along * along).simd_ge(low2 * squared);
                    let is_exact = (gap * gap).simd_le(squared * tolerance2);
                    is_exact | (below & (above | low2.simd_le(zero)))
                }
            };
            done |= decided | gap.simd_le(zero);
            if done.all_true() {
                break;
            }
            let Nearest { point, vertices, inside } = match round {
                1 => segment(simd, w, s[0]),
                2 => triangle(simd, w, [s[0], s[1]]),
                _ => tetrahedron(simd, w, s),
            };
            let least = point.dot(point);
            let touching = (inside | least.simd_le(contact2)) & !done;
            contact |= touching;
            done |= touching;
            let stuck = !least.simd_lt(squared) & !done;
            unsure |= stuck;
            done |= stuck;
            record.feature(vertices, !done | (touching & !inside), touching & inside);
            v = Vec3::select(done, v, point);
            squared = select(done, squared, least);
            s = vertices;
        }
        Bounds { upper: select(contact, zero, squared.sqrt()), contact, unsure: unsure | !done }
    }

    /// The lanes of `lanes` in which the shapes touch or overlap, which is where [`Pair::distances`] returns 0. Stops early
    /// when it finds a separating plane.
    #[inline(always)]
    pub fn touching(&self, lanes: u64) -> u64 {
        let bounds = self.descend::<_, true>(-self.pose.shift, lanes, &mut Alone(EXACT));
        let mut found = bounds.contact.to_bitmask() & lanes;
        let mut unsure = bounds.unsure.to_bitmask() & lanes;
        while unsure != 0 {
            let lane = unsure.trailing_zeros() as usize & (LANES - 1);
            unsure &= unsure - 1;
            if self.single(lane).distance_from_octants(f64::INFINITY) == 0.0 {
                found |= 1 << lane;
            }
        }
        found
    }

    /// The point of the difference A - B that is farthest against `v`.
    ///
    /// This is a function because a closure may not be compiled for the instruction set of `simd`.
    #[inline(always)]
    fn farthest(&self, v: Vec3<S>, lanes: u64, record: &mut impl Record<S>) -> Vec3<S> {
        let on_a = self.a.support(self.simd, -v, lanes);
        let on_b = self.b.support(self.simd, self.pose.rotate_back(v), lanes);
        let vertex = on_a - self.pose.rotate(on_b) - self.pose.shift;
        record.vertex(vertex, on_a);
        vertex
    }
}
