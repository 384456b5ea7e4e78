//! The Gilbert-Johnson-Keerthi algorithm for several samples at once.
//!
//! Source: as for `simplex`. The termination test is that of van den Bergen, "A Fast and Robust GJK Implementation for
//! Collision Detection of Convex Objects", J. Graphics Tools 4(2), 1999. Let v be the nearest point so far, and w the
//! support point of the Minkowski difference towards the origin. Then the distance is between v . w / |v| and |v|.

use fearless_simd::{Simd, prelude::*};

use super::lanes::{LANES, Mask, Num, Pose, Vec3, select, splat};
use super::simplex::{Nearest, segment, tetrahedron, triangle};
use super::support::Support;

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

/// Distances of `a` and `b` in the lanes of the bit set `lanes`. Both shapes are relative to their centres; `pose` is
/// that of `b` in the frame of `a`. In place of a distance in the range `within`, the result may be any number in it.
#[inline(always)]
pub(crate) fn distances<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    lanes: u64,
    within: [f64; 2],
) -> [f64; LANES] {
    let bounds =
        descend::<S, T, Alone, false>(simd, a, b, pose, -pose.shift, lanes, &mut Alone(within));
    sure(simd, a, b, pose, &bounds)
}

/// The distances that a descent found. Where rounding stopped it, from other sides.
#[inline(always)]
pub(crate) fn sure<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    bounds: &Bounds<S>,
) -> [f64; LANES] {
    let mut distances = bounds.upper.to_array();
    let mut unsure = bounds.unsure.to_bitmask();
    while unsure != 0 {
        let lane = unsure.trailing_zeros() as usize & (LANES - 1);
        unsure &= unsure - 1;
        let (a, b) = (a.single(lane), b.single(lane));
        distances[lane] = from_other_sides(simd, a, b, &pose.lane(lane), distances[lane]);
    }
    distances
}

/// The distance of two shapes in one pose, descending from all eight octants. Returns the first converged result,
/// otherwise the least upper bound, including `upper`.
#[inline(never)]
fn from_other_sides<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &[[f64; 3]; 4],
    upper: f64,
) -> f64 {
    simd.vectorize(
        #[inline(always)]
        || {
            let bounds = from_octants(simd, a, b, pose, &mut Alone(EXACT));
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
pub(crate) fn from_octants<S: Simd, T: Support, R: Record<S>>(
    simd: S,
    a: &T,
    b: &T,
    pose: &[[f64; 3]; 4],
    record: &mut R,
) -> Bounds<S> {
    let mut octants = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        for (axis, octant) in octants.iter_mut().enumerate() {
            octant[lane] = if lane >> axis & 1 == 0 { 1.0 } else { -1.0 };
        }
    }
    let octants = Vec3::load(simd, [&octants[0], &octants[1], &octants[2]]);
    let pose = Pose::same(simd, pose);
    descend::<S, T, R, false>(simd, a, b, &pose, octants, ALL, record)
}

/// Runs the descent. It starts from the point of the difference A - B that is farthest against `start`. A descent for
/// contact alone (`CONTACT_ALONE`) stops in a lane as soon as it finds a separating plane, any other as soon as the
/// distance is known to be in the range of `record`.
#[inline(always)]
pub(crate) fn descend<S: Simd, T: Support, R: Record<S>, const CONTACT_ALONE: bool>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    start: Vec3<S>,
    lanes: u64,
    record: &mut R,
) -> Bounds<S> {
    let [low, high] = record.within();
    let low2 = splat(simd, low * low);
    // No square is below a negative number.
    let high2 = splat(simd, high.min(1e9) * high.abs().min(1e9));
    let contact2 = splat(simd, CONTACT * CONTACT);
    let tolerance2 = splat(simd, TOLERANCE * TOLERANCE);
    let zero = splat(simd, 0.0);
    let mut v = farthest(simd, a, b, pose, start, lanes, record);
    let mut s = [v; 3];
    let mut squared = v.dot(v);
    let mut contact = squared.simd_le(contact2);
    let mut done = contact | Mask::from_bitmask(simd, !lanes & ALL);
    let mut unsure = Mask::splat(simd, false);
    for round in 1..=MAX_ROUNDS {
        if done.all_true() {
            break;
        }
        let w = farthest(simd, a, b, pose, v, !done.to_bitmask() & ALL, record);
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

/// The lanes of `lanes` in which `a` and `b` touch or overlap, which is where [`distances`] returns 0. Stops early when
/// it finds a separating plane.
#[inline(always)]
pub(crate) fn touching<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    lanes: u64,
) -> u64 {
    let bounds =
        descend::<S, T, Alone, true>(simd, a, b, pose, -pose.shift, lanes, &mut Alone(EXACT));
    let mut found = bounds.contact.to_bitmask() & lanes;
    let mut unsure = bounds.unsure.to_bitmask() & lanes;
    while unsure != 0 {
        let lane = unsure.trailing_zeros() as usize & (LANES - 1);
        unsure &= unsure - 1;
        let (a, b) = (a.single(lane), b.single(lane));
        if from_other_sides(simd, a, b, &pose.lane(lane), f64::INFINITY) == 0.0 {
            found |= 1 << lane;
        }
    }
    found
}

/// The point of the difference A - B that is farthest against `v`.
///
/// This is a function because a closure may not be compiled for the instruction set of `simd`.
#[inline(always)]
fn farthest<S: Simd, T: Support>(
    simd: S,
    a: &T,
    b: &T,
    pose: &Pose<S>,
    v: Vec3<S>,
    lanes: u64,
    record: &mut impl Record<S>,
) -> Vec3<S> {
    let on_a = a.support(simd, -v, lanes);
    let on_b = b.support(simd, pose.rotate_back(v), lanes);
    let vertex = on_a - pose.rotate(on_b) - pose.shift;
    record.vertex(vertex, on_a);
    vertex
}
