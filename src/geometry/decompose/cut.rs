//! The best plane to divide a part by.
//!
//! A part's *cost* is the volume of its hull, thickened a little: V + t A / 2 for a small t, so that
//! flat parts have a cost too. Planes are tried at many places across a few directions, and the one
//! that lowers the summed cost of the two sides most is taken. Along one direction all planes are
//! tried in two sweeps: the part is sliced once, and a hull that grows by slice after slice gives the
//! cost of everything below each plane; the sweep back, of everything above.

use super::grower::{Bounds, Frame, Grower, Places, SEED, cost};
use super::part::{Part, Plane};
use super::slices::Slices;
use super::vector::dot;

/// Planes tried across a direction, evenly spaced; flat coordinates come on top.
const EVEN: usize = 11;

/// Weight of a cut through the middle of the longest extent, as a part of the part's cost. It decides
/// where no cut helps at once, as in a ring, where only the second one does.
const MIDDLE: f64 = 0.01;

/// A cut and what it saves of the part's cost.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    pub plane: Plane,
    pub gain: f64,
    pub score: f64,
}

/// The part's hull, and the best cut: none where the part is too small to be cut.
pub(super) fn best_cut(part: &Part, places: &Places) -> (Grower, Option<Cut>) {
    let mut best: Option<Cut> = None;
    let mut hull = None;
    let mut turned = Vec::new();
    for (frame, flats) in &places.frames {
        // Coordinates in which the planes lie across z.
        turned.clear();
        turned.extend(part.points.iter().map(|&p| frame.map(|axis| dot(axis, p))));
        let Some((whole, cut)) = best_across(part, &turned, frame, flats, places) else {
            continue;
        };
        if frame[2] == [0.0, 0.0, 1.0] {
            if is_convex(part, &whole) {
                return (whole, None);
            }
            hull = Some(whole);
        }
        if let Some(cut) = cut
            && best.as_ref().is_none_or(|b| cut.score > b.score)
        {
            best = Some(cut);
        }
    }
    let hull = hull.unwrap_or_else(|| {
        let mut hull = Grower::new(Bounds::new(&part.points).extent());
        part.points.iter().for_each(|&p| hull.add(p));
        hull
    });
    (hull, best)
}

/// Whether no point of the surface lies deeper in the hull than what the search resolves.
fn is_convex(part: &Part, whole: &Grower) -> bool {
    part.triangles.iter().all(|t| {
        let [a, b, c] = t.map(|i| part.points[i as usize]);
        let middle = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        Part::is_loose(*t) || whole.hull.farthest_face(middle).1 > -1.2 * whole.step
    })
}

/// The directions across which cuts are tried, each with two others to make a frame, and the places
/// that are tried along it beside the even ones: the axes, z first, for which these are given, and the diagonals
/// between any two of them.
pub(super) fn frames(flats: [Vec<f64>; 3]) -> Vec<Frame> {
    let axis = |a: usize| [0, 1, 2].map(|b| f64::from(u8::from(a % 3 == b)));
    let mut out: Vec<Frame> = Vec::new();
    let [x, y, z] = flats;
    for (a, flats) in [(2, z), (0, x), (1, y)] {
        out.push(([axis(a + 1), axis(a + 2), axis(a)], flats));
    }
    let half = 0.5_f64.sqrt();
    for a in 0..3 {
        for sign in [half, -half] {
            let (x, y) = (axis(a), axis(a + 1));
            let along = [0, 1, 2].map(|k| half * x[k] + sign * y[k]);
            let beside = [0, 1, 2].map(|k| half * x[k] - sign * y[k]);
            out.push(([beside, axis(a + 2), along], Vec::new()));
        }
    }
    out
}

/// Offsets of the planes tried between `low` and `high`, ascending.
fn offsets(low: f64, high: f64, flats: &[f64], eps: f64) -> Vec<f64> {
    let step = (high - low) / (EVEN + 1) as f64;
    let near = (0.02 * (high - low)).max(2.0 * eps);
    let mut out: Vec<f64> = flats
        .iter()
        .copied()
        .filter(|x| *x > low + near && *x < high - near)
        .collect();
    out.dedup_by(|b, a| *b - *a < 2.0 * eps);
    out.truncate(MOST_OFFSETS - EVEN);
    let flat = out.len();
    for k in 1..=EVEN {
        let x = low + step * k as f64;
        if out[..flat].iter().all(|f| (f - x).abs() > 0.3 * step) {
            out.push(x);
        }
    }
    out.sort_by(f64::total_cmp);
    out
}

/// A slice mask has a bit for each slice.
const MOST_OFFSETS: usize = 31;

/// The part's hull (in turned coordinates) and its best cut across the last of `frame`,
/// which is their z; none
/// where the part is too thin to be sliced.
fn best_across(
    part: &Part,
    turned: &[[f64; 3]],
    frame: &[[f64; 3]; 3],
    flats: &[f64],
    places: &Places,
) -> Option<(Grower, Option<Cut>)> {
    let (eps, normal) = (places.eps, frame[2]);
    let bounds = Bounds::new(turned);
    let (low, high) = (bounds.low[2], bounds.high[2]);
    if high - low <= (8.0 * eps).max(10.0 * SEED) {
        return None;
    }
    let planes = offsets(low, high, flats, eps);
    let slices = Slices::new(part, turned, frame, &planes, places);
    let (below, whole) = slices.sweep(true, bounds.extent());
    let (above, _) = slices.sweep(false, bounds.extent());
    let all = cost(&whole.hull);
    let mut best: Option<Cut> = None;
    for (k, &offset) in planes.iter().enumerate() {
        let (b, a) = (below[k], above[planes.len() - 1 - k]);
        if b <= 0.0 || a <= 0.0 {
            continue; // one side is empty
        }
        let gain = all - b - a;
        let middle = 1.0 - (2.0 * (offset - low) / (high - low) - 1.0).abs();
        let score = gain + MIDDLE * all * middle * (high - low) / bounds.extent();
        if best.as_ref().is_none_or(|c| score > c.score) {
            best = Some(Cut {
                plane: Plane { normal, offset },
                gain,
                score,
            });
        }
    }
    Some((whole, best))
}
