//! Spheres that give the same collision results as the exact shapes.

use rayon::prelude::*;

use crate::fit::Limits;
use crate::frame::Point;
use crate::model::Spheres;
use crate::samples::{Ask, Moves, Pairs, Region, Sample, Sampler};
use crate::{fit, judge, model, surface};

/// Spheres for each link on average, and in all, where no number is asked for.
pub const AUTO_PER_LINK: usize = 12;
/// At most this many in all then.
pub const AUTO_TOTAL: usize = 150;

/// Rounding factor of written lengths: 6 decimal places, in metres.
const DIGITS: f64 = 1e6;

/// Minimum fraction of free configurations for the fit. With fewer, some samples are taken near the default
/// configuration.
const FEW_FREE: f64 = 0.02;

/// Points on the surface of a link: minimum, per sphere, and maximum.
const POINTS: [usize; 3] = [600, 40, 4000];

/// Maximum change of all radii after the fit, relative to their mean.
const GROWTH: f64 = 0.25;

/// Minimum distance of spheres in the default configuration, if it is free, relative to the maximum change of radii.
const APART: f64 = 0.02;

/// Numbers of sampled configurations. The first indices keep the sets disjoint, and apart from the samples of a URDD's
/// own statistics and skips.
#[derive(Debug, Clone, Copy)]
pub struct Numbers {
    /// For the fit.
    pub fit: usize,
    /// For balancing the two rates, and for counting them.
    pub measure: usize,
}

/// Minimum number of samples for a meaningful rate.
const LEAST: usize = 100;
/// Maximum number of stored poses.
const POSES: usize = 2_000_000;
/// Maximum number of checks of pairs of links, and of pairs of spheres.
const LOOKS: usize = 200_000_000;
/// Number of spheres per link that counts as small. The limit on samples shrinks with the square of the multiple of
/// this.
const FEW: usize = 16;

impl Numbers {
    /// Index of the first sample (SPEC 9.3) for the fit.
    pub const FIT: u64 = 1_000_000;
    /// Index of the first sample for balancing the two rates.
    pub const GROW: u64 = 2_000_000;
    /// Index of the first sample for counting the rates.
    pub const MEASURE: u64 = 3_000_000;

    /// Evaluates `wanted` samples, or fewer if that is too expensive.
    pub fn new(wanted: usize, pairs: &Pairs, spheres_per_link: usize) -> Self {
        let many = (spheres_per_link / FEW).max(1);
        let most = (POSES / pairs.links.len().max(1)).min(LOOKS / pairs.checked.len().max(1))
            / (many * many);
        let most = most.max(LEAST);
        Numbers { fit: wanted.saturating_add(wanted / 2).min(most), measure: wanted.min(most) }
    }
}

/// The limits where no number is asked for.
pub fn auto_limits(links: usize) -> Limits {
    Limits { total: (AUTO_PER_LINK * links).min(AUTO_TOTAL), per_link: usize::MAX }
}

/// Points on the surface of each link, for so many spheres of each.
pub fn surfaces(pairs: &Pairs, per_link: usize) -> Vec<Vec<Point>> {
    let count = (POINTS[1] * per_link).clamp(POINTS[0], POINTS[2]);
    pairs.pieces.par_iter().map(|pieces| surface::points(pieces, count)).collect()
}

/// Fits spheres that give the same collision results as the exact shapes, and marks the pairs to ignore with them. Also
/// returns whether the fit used configurations near the default one.
///
/// # Errors
/// Those of the robot.
pub fn fitted<R: Moves>(
    robot: &R,
    pairs: &Pairs,
    surface: &[Vec<Point>],
    numbers: &Numbers,
    ignored: &mut [bool],
    limits: Limits,
) -> Result<(Spheres, bool), R::Error> {
    let sampler = Sampler { robot, pairs };
    let mut near = false;
    let mut known: Vec<Sample> = Vec::new();
    if !pairs.checked.is_empty() {
        known.push(sampler.zero(Ask::Pairs)?);
        let some = numbers.fit / 10;
        let take = |region, first, count| sampler.samples(region, first, count, Ask::Pairs);
        let first = Numbers::FIT;
        known.extend(take(Region::Bounds, first, some)?);
        let free = known.iter().filter(|sample| !sample.collides()).count();
        near = (free as f64) < FEW_FREE * known.len() as f64;
        known.extend(if near {
            take(Region::NearDefault, first, numbers.fit - some)?
        } else {
            take(Region::Bounds, first + some as u64, numbers.fit - some)?
        });
    }
    let mut to_balance = Vec::new();
    if let Some(default) = known.first() {
        let region = if near { Region::NearDefault } else { Region::Bounds };
        let (first, count) = (Numbers::GROW, numbers.measure);
        to_balance = sampler.samples(region, first, count, Ask::Any)?;
        to_balance.insert(0, default.clone());
    }
    let mut best: Option<(f64, Spheres, Vec<bool>)> = None;
    for steps in fit::CONTACT_STEP {
        let mut own = ignored.to_vec();
        let mut spheres = fit::fit(surface, &known, &pairs.checked, &mut own, limits, steps);
        let worse = if to_balance.is_empty() {
            0.0
        } else {
            balance(&mut spheres, surface, pairs, &mut own, &known, &to_balance)
        };
        if best.as_ref().is_none_or(|best| worse < best.0) {
            best = Some((worse, spheres, own));
        }
        if worse <= 1.0 {
            break;
        }
    }
    let mut spheres = Spheres::new();
    if let Some((_, found, own)) = best {
        spheres = found;
        ignored.copy_from_slice(&own);
    }
    let rounded = |x: f64| (x * DIGITS).round() / DIGITS + 0.0;
    for sphere in spheres.iter_mut().flatten() {
        // Rounds before the evaluation. Tiny spheres keep all digits.
        if sphere.radius * DIGITS > 1e2 {
            sphere.centre = sphere.centre.map(rounded);
            sphere.radius = rounded(sphere.radius);
        }
    }
    Ok((spheres, near))
}

/// Grows or shrinks all radii so that the rates are balanced, with the default configuration free; twice, since a pair
/// that becomes ignored changes the balance. Returns the worse rate, relative to its goal.
fn balance(
    spheres: &mut Spheres,
    surface: &[Vec<Point>],
    pairs: &Pairs,
    ignored: &mut [bool],
    known: &[Sample],
    to_balance: &[Sample],
) -> f64 {
    let checked = &pairs.checked;
    let radii = spheres.iter().flatten().map(|sphere| sphere.radius);
    let limit = GROWTH * radii.sum::<f64>() / model::count(spheres).max(1) as f64;
    for _ in 0..2 {
        let gaps = judge::gaps(spheres, checked, ignored, to_balance, limit);
        let by = judge::growth(to_balance, &gaps, limit);
        for sphere in spheres.iter_mut().flatten() {
            sphere.radius = (sphere.radius + by).max(0.5 * sphere.radius);
        }
        let goal = fit::Goal { surface, samples: known, pairs: checked, size: limit };
        goal.look(spheres, ignored, f64::MIN_POSITIVE);
        if !known[0].collides() {
            let left = checked.iter().zip(&*ignored).filter(|(_, ignored)| !**ignored);
            let left: Vec<[usize; 2]> = left.map(|(pair, _)| *pair).collect();
            model::part(spheres, &left, &known[0], APART * limit);
        }
    }
    let gaps = judge::gaps(spheres, checked, ignored, to_balance, limit);
    judge::rates(to_balance, &gaps).worse()
}
