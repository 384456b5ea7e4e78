//! Triangulates fans, strips, and polygons in space.

use earcut::Earcut;
use nalgebra::Vector3;

/// Maximum number of corners for ear clipping. Its worst case is quadratic: 0.5 s for a tangled polygon of this size.
/// Real faces have up to 40 corners.
const MAX_CORNERS: usize = 10_000;
/// Budget of one splitter for ear clipping: the sum of squared corner counts of polygons with more than [`FEW_CORNERS`]
/// corners. If all of them are tangled, this takes some seconds.
const MAX_WORK: usize = 500_000_000;
/// Polygons with at most this many corners do not count against the budget.
const FEW_CORNERS: usize = 100;

/// Triangulates polygons; reuses its buffers.
#[derive(Default)]
pub(crate) struct Splitter {
    ears: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    found: Vec<u32>,
    work: usize,
    uncut: bool,
}

impl Splitter {
    /// `uncut` as in [`Options`](crate::read::Options).
    pub(crate) fn new(uncut: bool) -> Self {
        Self { uncut, ..Self::default() }
    }

    /// Appends a triangle. Where faces stay uncut, three equal indices would mark one.
    pub(crate) fn push(&self, triangle: [u32; 3], out: &mut Vec<[u32; 3]>) {
        let [a, b, c] = triangle;
        if !self.uncut || a != b || b != c {
            out.push(triangle);
        }
    }

    /// Appends the triangles of one polygon, with its winding. `corners` are indices of `vertices`.
    ///
    /// A convex polygon becomes a fan around its first corner, as in every reader of quads. Other polygons are
    /// triangulated by ear clipping, projected along the largest component of their normal. Fewer than three corners
    /// give no triangles. More than [`MAX_CORNERS`] corners always give a fan. Once [`MAX_WORK`] is spent, so do more
    /// than [`FEW_CORNERS`].
    pub(crate) fn split(
        &mut self,
        vertices: &[[f64; 3]],
        corners: &[u32],
        out: &mut Vec<[u32; 3]>,
    ) {
        if let [a, b, c] = *corners {
            self.push([a, b, c], out);
            return;
        }
        if corners.len() < 3 {
            return;
        }
        let place = |index: u32| vertices.get(index as usize).copied().map(Vector3::from);
        let places: Option<Vec<Vector3<f64>>> =
            corners.iter().map(|corner| place(*corner)).collect();
        let uncut = self.uncut;
        let is_same = |[a, b, c]: &[u32; 3]| a == b && b == c;
        let fan = |out: &mut Vec<[u32; 3]>| {
            out.extend(fan(corners).filter(|triangle| !uncut || !is_same(triangle)));
        };
        // An index out of range or a non-finite coordinate: the caller drops the affected triangles.
        let Some(places) =
            places.filter(|places| places.iter().flatten().all(|value| value.is_finite()))
        else {
            fan(out);
            return;
        };
        let normal = area_normal(&places);
        let slack = if uncut { DISPUTED_SLACK } else { SLACK };
        if corners.len() > MAX_CORNERS && !uncut || is_convex(&places, normal, slack) {
            fan(out);
            return;
        }
        if uncut {
            out.push([corners[0]; 3]);
            fan(out);
            out.push([corners[0]; 3]);
            return;
        }
        if corners.len() > FEW_CORNERS {
            self.work = self.work.saturating_add(corners.len() * corners.len());
            if self.work > MAX_WORK {
                fan(out);
                return;
            }
        }
        let start = out.len();
        self.cut_ears(&places, normal, corners, out);
        if out.len() == start {
            fan(out);
        }
    }

    fn cut_ears(
        &mut self,
        places: &[Vector3<f64>],
        normal: Vector3<f64>,
        corners: &[u32],
        out: &mut Vec<[u32; 3]>,
    ) {
        let (u, v) = match normal.iamax() {
            0 => (1, 2),
            1 => (2, 0),
            _ => (0, 1),
        };
        self.flat.clear();
        self.flat.extend(places.iter().map(|place| [place[u], place[v]]));
        self.ears.earcut::<u32>(self.flat.iter().copied(), &[], &mut self.found);
        // Earcut always winds its triangles the same way; restore the polygon's winding.
        let wanted = normal[normal.iamax()] > 0.0;
        for cut in self.found.chunks_exact(3) {
            let [a, b, c] = [cut[0], cut[1], cut[2]].map(|index| self.flat[index as usize]);
            let turns_left = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0;
            let [a, b, c] = [cut[0], cut[1], cut[2]].map(|index| corners[index as usize]);
            out.push(if turns_left == wanted { [a, b, c] } else { [a, c, b] });
        }
    }
}

/// The triangles of a fan around its first corner; none of fewer than three corners.
pub(crate) fn fan<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 3]> {
    let pairs = corners.get(1..).unwrap_or_default().windows(2);
    pairs.map(|pair| [corners[0], pair[0], pair[1]])
}

/// The triangles of a strip; every second one has its winding reversed.
pub(crate) fn strip(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    corners.windows(3).enumerate().map(|(at, three)| {
        if at % 2 == 0 { [three[0], three[1], three[2]] } else { [three[0], three[2], three[1]] }
    })
}

/// The polygon's normal (Newell's method); its length is twice the area.
fn area_normal(places: &[Vector3<f64>]) -> Vector3<f64> {
    let origin = places[0];
    places[1..].windows(2).map(|pair| (pair[0] - origin).cross(&(pair[1] - origin))).sum()
}

/// Sine of the turn-back angle up to which corners count as collinear.
const SLACK: f64 = 1e-6;
/// From here on, others may find that they do not (SPEC 7.8).
const DISPUTED_SLACK: f64 = 0.999e-6;

/// Whether no corner turns against the polygon's normal by a sine of more than `slack`.
fn is_convex(places: &[Vector3<f64>], normal: Vector3<f64>, slack: f64) -> bool {
    let count = places.len();
    let length = normal.norm();
    let mut turned = 0.0;
    for at in 0..count {
        let before = places[at] - places[(at + count - 1) % count];
        let after = places[(at + 1) % count] - places[at];
        let turn = before.cross(&after).dot(&normal);
        let scale = before.norm() * after.norm();
        if turn < -slack * scale * length {
            return false;
        }
        if count > 4 && scale > 0.0 {
            turned += (before.dot(&after) / scale).clamp(-1.0, 1.0).acos();
        }
    }
    // A star polygon always turns the same way, but more than one full turn.
    turned < 1.5 * std::f64::consts::TAU
}
