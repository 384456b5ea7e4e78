//! The best cutting plane of a part.
//!
//! A part's *cost* is the standoff of its hull (`field`) plus a fraction of the hull's bulk: V + t A / 2 for a small
//! thickness t, so that flat parts have a cost too. Planes are tried at many offsets along a few directions; the one
//! that lowers the summed cost of the two sides most is taken. Two sweeps evaluate all planes of a direction: the part
//! is sliced once, and a hull that grows slice by slice gives the cost of everything below each plane. The reverse
//! sweep gives the cost of everything above.

use rayon::prelude::*;

use super::grower::{Frame, Grower, Places, SEED};
use super::part::{Part, Plane};
use super::slices::Slices;
use super::vector::{Bounds, centroid, dot};

/// Evenly spaced planes per axis; flat coordinates come on top.
const EVEN: usize = 9;

/// Evenly spaced planes per diagonal.
const EVEN_DIAGONAL: usize = 5;

/// Weight of a cut through the middle of the longest extent, as a fraction of the part's cost. It decides when no
/// single cut helps, as in a ring, where only the second one does.
const MIDDLE: f64 = 0.01;

/// A cut and the cost that it saves.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    pub plane: Plane,
    pub gain: f64,
    pub score: f64,
}

/// The part's hull, and its cuts along the first direction; `None` if it is convex.
pub(super) fn first_cuts(part: &Part, places: &Places) -> (Grower, Option<Vec<Cut>>) {
    match places.frames.first().and_then(|along| cuts_along(part, along, places)) {
        Some((whole, _)) if is_convex(part, &whole) => (whole, None),
        Some((whole, cuts)) => (whole, Some(cuts)),
        None => (Grower::of(&part.points), Some(Vec::new())),
    }
}

/// The cuts of a part along all directions, best first. `first` are those along the first direction.
pub(super) fn best_cuts(part: &Part, first: &[Cut], places: &Places) -> Vec<Cut> {
    let frames = places.frames.get(1..).unwrap_or_default().par_iter();
    let others: Vec<Vec<Cut>> =
        frames.filter_map(|along| Some(cuts_along(part, along, places)?.1)).collect();
    let mut found = [first, &others.concat()].concat();
    // A stable sort keeps the first of equals first.
    found.sort_by(|a, b| b.score.total_cmp(&a.score));
    found
}

/// Whether no triangle of the surface is deeper in the hull than the search resolves.
fn is_convex(part: &Part, whole: &Grower) -> bool {
    part.triangles.iter().all(|t| {
        let depth = || whole.hull.farthest_face(centroid(part.corners(*t))).1;
        Part::is_loose(*t) || depth() > -1.2 * whole.step
    })
}

/// The frames of the cutting directions, with the flat coordinates to try along each in addition to the even ones. The
/// directions are the axes (z first), which have the given flats, and the diagonals between any two axes.
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

/// Offsets of the planes between `low` and `high`, ascending: `even` evenly spaced ones, and flats.
fn offsets(low: f64, high: f64, flats: &[f64], eps: f64, even: usize) -> Vec<f64> {
    let step = (high - low) / (even + 1) as f64;
    let near = (0.02 * (high - low)).max(2.0 * eps);
    let mut out: Vec<f64> =
        flats.iter().copied().filter(|x| *x > low + near && *x < high - near).collect();
    out.dedup_by(|b, a| *b - *a < 2.0 * eps);
    out.truncate(MAX_OFFSETS - EVEN);
    let flat = out.len();
    for k in 1..=even {
        let x = low + step * k as f64;
        if out[..flat].iter().all(|f| (f - x).abs() > 0.3 * step) {
            out.push(x);
        }
    }
    out.sort_by(f64::total_cmp);
    out
}

/// The limit of a slice mask, which has one bit per slice.
const MAX_OFFSETS: usize = 31;

/// The part's hull (in the coordinates of the frame) and its cuts along the frame's z: those with a locally maximal
/// score. `None` if the part is too thin to be sliced.
fn cuts_along(part: &Part, (frame, flats): &Frame, places: &Places) -> Option<(Grower, Vec<Cut>)> {
    let (eps, normal) = (places.eps, frame[2]);
    // Coordinates in the frame: the planes are perpendicular to their z.
    let turned: Vec<[f64; 3]> =
        part.points.iter().map(|&p| frame.map(|axis| dot(axis, p))).collect();
    let bounds = Bounds::of(turned.iter().copied());
    let (low, high) = (bounds.min[2], bounds.max[2]);
    if high - low <= (8.0 * eps).max(10.0 * SEED) {
        return None;
    }
    let even = if normal.contains(&1.0) { EVEN } else { EVEN_DIAGONAL };
    let planes = offsets(low, high, flats, eps, even);
    let slices = Slices::new(part, &turned, frame, &planes, places);
    let cost = |hull: &mut Grower, k: usize| {
        let mut cuts = part.cuts.clone();
        cuts.push(Plane { normal, offset: planes[k] });
        places.cost(hull, frame, &cuts)
    };
    let (below, mut whole) = slices.sweep(true, bounds.extent(), cost);
    let (above, _) = slices.sweep(false, bounds.extent(), cost);
    let all = places.cost(&mut whole, frame, &part.cuts);
    let scored: Vec<Option<Cut>> = (0..planes.len())
        .map(|k| {
            let (offset, b, a) = (planes[k], below[k], above[planes.len() - 1 - k]);
            // Zero means that the side is empty.
            (b > 0.0 && a > 0.0).then(|| {
                let gain = all - b - a;
                let middle = 1.0 - (2.0 * (offset - low) / (high - low) - 1.0).abs();
                let score = gain + MIDDLE * all * middle * (high - low) / bounds.extent();
                Cut { plane: Plane { normal, offset }, gain, score }
            })
        })
        .collect();
    let score = |k: usize| {
        let cut = scored.get(k).and_then(Option::as_ref);
        cut.map_or(f64::NEG_INFINITY, |c| c.score)
    };
    let peaks = (0..planes.len())
        .filter(|&k| score(k) > score(k.wrapping_sub(1)) && score(k) >= score(k + 1))
        .filter_map(|k| scored[k].clone());
    Some((whole, peaks.collect()))
}
