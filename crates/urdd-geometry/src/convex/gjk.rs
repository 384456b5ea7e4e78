//! The Gilbert-Johnson-Keerthi algorithm for several samples at once.
//!
//! Source: E. Gilbert, D. Johnson, S. Keerthi, "A fast procedure for computing the distance between complex objects in
//! three-dimensional space", IEEE J. Robotics and Automation 4 (1988). The termination test is that of van den Bergen, "A
//! Fast and Robust GJK Implementation for Collision Detection of Convex Objects", J. Graphics Tools 4(2), 1999. Let v be
//! the nearest point so far, and w the support point of the Minkowski difference towards the origin. Then the distance is
//! between v . w / |v| and |v|.
//!
//! The sub-algorithm finds the point of a simplex that is nearest to the origin, for all lanes at once without branches.
//! The newest vertex w is part of the nearest feature, because GJK adds it beyond the plane through the nearest point so
//! far. So the candidates are w, the three edges at w, the three faces at w, and the interior. The code computes the
//! distance of every candidate and selects the least. A simplex with fewer vertices repeats one; degenerate edges and
//! faces are never selected.

use fearless_simd::{Simd, prelude::*};

use crate::convex::shape::Support;
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

/// The nearest point, the vertices of its feature (the first is w), and whether the origin is inside the simplex.
pub(crate) struct Nearest<S: Simd> {
    pub point: Vec3<S>,
    pub vertices: [Vec3<S>; 3],
    pub inside: Mask<S>,
}

/// The nearest point of an edge at w, as the parameter t of `w + t * edge`, and its squared distance.
#[inline(always)]
fn edge<S: Simd>(simd: S, c: Num<S>, b: Num<S>, a: Num<S>) -> (Num<S>, Num<S>) {
    let (zero, one) = (splat(simd, 0.0), splat(simd, 1.0));
    let t = b / a;
    // A comparison with NaN (0 / 0) is false, which leaves the vertex w.
    let t = select(t.simd_gt(zero), t, zero);
    let t = select(t.simd_lt(one), t, one);
    (t, c + t * (t * a - (b + b)))
}

/// Whether the projection of the origin onto the plane of a face is inside the face, its squared distance, and the
/// factor that scales the normal to this projection.
#[inline(always)]
fn face<S: Simd>(
    simd: S,
    normal: Vec3<S>,
    height: Num<S>,
    [aii, ajj, aij]: [Num<S>; 3],
    [bi, bj]: [Num<S>; 2],
) -> (Mask<S>, Num<S>, Num<S>) {
    let zero = splat(simd, 0.0);
    let area = normal.dot(normal);
    let p = ajj * bi - aij * bj;
    let q = aii * bj - aij * bi;
    let inside = p.simd_gt(zero) & q.simd_gt(zero) & (p + q).simd_lt(area);
    let k = height / area;
    (inside, height * k, k)
}

#[inline(always)]
pub(crate) fn segment<S: Simd>(simd: S, w: Vec3<S>, s: Vec3<S>) -> Nearest<S> {
    let e = s - w;
    let (t, _) = edge(simd, w.dot(w), -w.dot(e), e.dot(e));
    let keep = t.simd_gt(splat(simd, 0.0));
    Nearest {
        point: w + e.scale(t),
        vertices: [w, Vec3::select(keep, s, w), w],
        inside: Mask::splat(simd, false),
    }
}

#[inline(always)]
pub(crate) fn triangle<S: Simd>(simd: S, w: Vec3<S>, s: [Vec3<S>; 2]) -> Nearest<S> {
    let e = [s[0] - w, s[1] - w];
    let c = w.dot(w);
    let b = [-w.dot(e[0]), -w.dot(e[1])];
    let a = [e[0].dot(e[0]), e[1].dot(e[1])];
    let a01 = e[0].dot(e[1]);
    let n = e[0].cross(e[1]);
    let (t0, d0) = edge(simd, c, b[0], a[0]);
    let (t1, d1) = edge(simd, c, b[1], a[1]);
    let (in01, d01, k01) = face(simd, n, w.dot(n), [a[0], a[1], a01], b);

    let is0 = d0.simd_lt(c);
    let best = select(is0, d0, c);
    let is1 = d1.simd_lt(best);
    let best = select(is1, d1, best);
    let is01 = in01 & d01.simd_lt(best);
    let mut p = Vec3::select(is0, s[0], w);
    p = Vec3::select(is1, s[1], p);
    let t = select(is1, t1, t0);
    let on_edge = w + (p - w).scale(t);
    p = Vec3::select(is01, s[0], p);
    Nearest {
        point: Vec3::select(is01, n.scale(k01), on_edge),
        vertices: [w, p, Vec3::select(is01, s[1], w)],
        inside: Mask::splat(simd, false),
    }
}

/// A tetrahedron with less than this part of the volume of its three edges at w is flat: the volume may be rounding alone,
/// as where a feature with fewer vertices repeats one. What is nearest is then in a face.
const FLAT: f64 = 3e-14;

#[inline(always)]
pub(crate) fn tetrahedron<S: Simd>(simd: S, w: Vec3<S>, s: [Vec3<S>; 3]) -> Nearest<S> {
    let zero = splat(simd, 0.0);
    let e = [s[0] - w, s[1] - w, s[2] - w];
    let c = w.dot(w);
    let b = [-w.dot(e[0]), -w.dot(e[1]), -w.dot(e[2])];
    let a = [e[0].dot(e[0]), e[1].dot(e[1]), e[2].dot(e[2])];
    let (a01, a12, a20) = (e[0].dot(e[1]), e[1].dot(e[2]), e[2].dot(e[0]));
    let (n01, n12, n20) = (e[0].cross(e[1]), e[1].cross(e[2]), e[2].cross(e[0]));
    let (h01, h12, h20) = (w.dot(n01), w.dot(n12), w.dot(n20));

    // Barycentric coordinates of the origin, times the squared volume determinant.
    let volume = e[0].dot(n12);
    let (g0, g1, g2) = (-(h12 * volume), -(h20 * volume), -(h01 * volume));
    let inside = g0.simd_ge(zero)
        & g1.simd_ge(zero)
        & g2.simd_ge(zero)
        & (g0 + g1 + g2).simd_le(volume * volume)
        & (volume * volume).simd_gt(a[0] * a[1] * a[2] * splat(simd, FLAT * FLAT));

    let (t0, d0) = edge(simd, c, b[0], a[0]);
    let (t1, d1) = edge(simd, c, b[1], a[1]);
    let (t2, d2) = edge(simd, c, b[2], a[2]);
    let (in01, d01, k01) = face(simd, n01, h01, [a[0], a[1], a01], [b[0], b[1]]);
    let (in12, d12, k12) = face(simd, n12, h12, [a[1], a[2], a12], [b[1], b[2]]);
    let (in20, d20, k20) = face(simd, n20, h20, [a[2], a[0], a20], [b[2], b[0]]);

    let is0 = d0.simd_lt(c);
    let best = select(is0, d0, c);
    let is1 = d1.simd_lt(best);
    let best = select(is1, d1, best);
    let is2 = d2.simd_lt(best);
    let best = select(is2, d2, best);
    let is01 = in01 & d01.simd_lt(best);
    let best = select(is01, d01, best);
    let is12 = in12 & d12.simd_lt(best);
    let best = select(is12, d12, best);
    let is20 = in20 & d20.simd_lt(best);

    let mut p = Vec3::select(is0, s[0], w);
    p = Vec3::select(is1, s[1], p);
    p = Vec3::select(is2, s[2], p);
    let t = select(is2, t2, select(is1, t1, t0));
    let on_edge = w + (p - w).scale(t);
    let on_face = is01 | is12 | is20;
    let n = Vec3::select(is20, n20, Vec3::select(is12, n12, n01));
    let k = select(is20, k20, select(is12, k12, k01));
    p = Vec3::select(is01, s[0], p);
    p = Vec3::select(is12, s[1], p);
    p = Vec3::select(is20, s[2], p);
    let mut q = Vec3::select(is01, s[1], w);
    q = Vec3::select(is12, s[2], q);
    q = Vec3::select(is20, s[0], q);
    Nearest { point: Vec3::select(on_face, n.scale(k), on_edge), vertices: [w, p, q], inside }
}
