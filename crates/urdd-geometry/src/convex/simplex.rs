//! The point of a simplex that is nearest to the origin, for all lanes at once without branches.
//!
//! Method: the newest vertex w is part of the nearest feature, because GJK adds it beyond the plane through the nearest
//! point so far. So the candidates are w, the three edges at w, the three faces at w, and the interior. The code
//! computes the distance of every candidate and selects the least: the exhaustive form of the sub-algorithm of Gilbert,
//! Johnson and Keerthi, "A fast procedure for computing the distance between complex objects in three-dimensional
//! space", IEEE J. Robotics and Automation 4 (1988). A simplex with fewer vertices repeats one; degenerate edges and
//! faces are never selected.

use fearless_simd::{Simd, prelude::*};

use crate::lanes::{Mask, Num, Vec3, select, splat};

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

/// The nearest point of the segment from `w` to `s`.
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

/// The nearest point of the triangle of `w` and `s`.
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

/// The nearest point of the tetrahedron of `w` and `s`.
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
