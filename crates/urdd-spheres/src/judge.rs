//! Compares spheres with the exact shapes: missed collisions and false contacts.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::model::{Placeable, Placed, Spheres};
use super::samples::Sample;
use urdd_directory::account::{Account, AccountError};
use urdd_format::rate::interval;

/// Allowed rates of missed collisions, and of false contacts in free configurations.
pub const MAX_MISSED: f64 = 0.01;
pub const MAX_FALSE: f64 = 0.05;

/// Counts of the spheres' results in sampled configurations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SphereRates {
    /// Configurations in which the exact shapes collide.
    pub colliding: usize,
    /// Colliding configurations in which no spheres touch.
    pub missed: usize,
    /// Configurations in which the exact shapes do not touch.
    pub free: usize,
    /// Free configurations in which spheres touch.
    pub false_contacts: usize,
}

impl SphereRates {
    /// Counts a configuration: whether it collides, and whether its spheres touch.
    pub fn count(&mut self, collides: bool, touches: bool) {
        if collides {
            self.colliding += 1;
            self.missed += usize::from(!touches);
        } else {
            self.free += 1;
            self.false_contacts += usize::from(touches);
        }
    }

    /// Whether at most 1 % of collisions are missed, and at most 5 % of free configurations have a false contact.
    pub fn are_within_goals(&self) -> bool {
        self.missed as f64 <= MAX_MISSED * self.colliding as f64
            && self.false_contacts as f64 <= MAX_FALSE * self.free as f64
    }

    /// The greater of the upper ends of the intervals of both rates, each relative to its goal.
    pub fn worse(&self) -> f64 {
        (interval(self.missed, self.colliding)[1] / MAX_MISSED)
            .max(interval(self.false_contacts, self.free)[1] / MAX_FALSE)
    }
}

/// Number of samples in which a pair of links caused a wrong result for the robot.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PairFaults {
    pub missed: usize,
    pub false_contacts: usize,
}

/// The minimum signed distance of spheres in each sample, over the pairs that are not ignored, capped at `limit`.
pub fn gaps(
    spheres: &Spheres,
    pairs: &[[usize; 2]],
    ignored: &[bool],
    samples: &[Sample],
    limit: f64,
) -> Vec<f64> {
    let model = Placeable::new(spheres);
    let checked = checked(pairs, ignored);
    let gap = |placed: &mut Placed, sample: &Sample| {
        model.place(sample, placed);
        let mut least = limit;
        for (_, pair) in &checked {
            if model.may_be_near(placed, *pair, least) {
                least = model.gap(sample, placed, *pair, least);
            }
        }
        least
    };
    samples.par_iter().map_init(Placed::default, gap).collect()
}

/// Pairs of spheres of two links that are looked at for nothing in a sample: some microseconds, as the pieces of two links
/// take. Of lists that people have, fewer are.
const FREE: usize = 2048;

/// Two links whose spheres take more work than the account has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CostlyPair {
    pub links: [usize; 2],
    pub error: AccountError,
}

/// Of each sample, the indices of the pairs in contact by spheres, ascending.
///
/// # Errors
/// If spheres of two links are so many, and so near each other, that the account does not have what it takes.
pub fn touching(
    spheres: &Spheres,
    pairs: &[[usize; 2]],
    samples: &[Sample],
    account: &Account,
) -> Result<Vec<Vec<u32>>, CostlyPair> {
    let model = Placeable::new(spheres);
    let touching = |placed: &mut Placed, sample: &Sample| {
        model.place(sample, placed);
        let mut touching = Vec::new();
        for (number, links) in (0u32..).zip(pairs) {
            let touches = charged(&model, (sample, placed), *links, account)?;
            touching.extend(touches.then_some(number));
        }
        Ok(touching)
    };
    samples.par_iter().map_init(Placed::default, touching).collect()
}

/// Of each sample, whether a pair that is not ignored is in contact by spheres.
///
/// # Errors
/// Those of [`touching`].
pub fn any_touching(
    spheres: &Spheres,
    pairs: &[[usize; 2]],
    ignored: &[bool],
    samples: &[Sample],
    account: &Account,
) -> Result<Vec<bool>, CostlyPair> {
    let model = Placeable::new(spheres);
    let checked = checked(pairs, ignored);
    let touches = |placed: &mut Placed, sample: &Sample| {
        model.place(sample, placed);
        for (_, links) in &checked {
            if charged(&model, (sample, placed), *links, account)? {
                return Ok(true);
            }
        }
        Ok(false)
    };
    samples.par_iter().map_init(Placed::default, touches).collect()
}

/// Whether spheres of two links touch.
fn charged(
    model: &Placeable,
    (sample, placed): (&Sample, &Placed),
    links: [usize; 2],
    account: &Account,
) -> Result<bool, CostlyPair> {
    let (touches, steps) = model.touches(sample, placed, links);
    if let Some(steps) = steps.checked_sub(FREE) {
        account.charge(steps).map_err(|error| CostlyPair { links, error })?;
    }
    Ok(touches)
}

fn checked(pairs: &[[usize; 2]], ignored: &[bool]) -> Vec<(usize, [usize; 2])> {
    pairs.iter().copied().enumerate().filter(|(number, _)| !ignored[*number]).collect()
}

/// Counts results, given the minimum distances from `gaps`.
pub fn rates(samples: &[Sample], gaps: &[f64]) -> SphereRates {
    let mut rates = SphereRates::default();
    for (sample, gap) in samples.iter().zip(gaps) {
        rates.count(sample.collides(), *gap <= 0.0);
    }
    rates
}

/// The pairs that cause wrong results. `samples` list the pairs in contact.
pub fn faults(
    spheres: &Spheres,
    pairs: &[[usize; 2]],
    ignored: &[bool],
    samples: &[Sample],
) -> BTreeMap<usize, PairFaults> {
    let model = Placeable::new(spheres);
    let mut placed = Placed::default();
    let mut found: BTreeMap<usize, PairFaults> = BTreeMap::new();
    for sample in samples {
        model.place(sample, &mut placed);
        let touching: Vec<usize> = checked(pairs, ignored)
            .into_iter()
            .filter(|(_, pair)| model.touches(sample, &placed, *pair).0)
            .map(|(number, _)| number)
            .collect();
        match (sample.collides(), touching.is_empty()) {
            (true, true) => {
                for pair in &sample.touching {
                    found.entry(*pair as usize).or_default().missed += 1;
                }
            }
            (false, false) => {
                for pair in touching {
                    found.entry(pair).or_default().false_contacts += 1;
                }
            }
            _ => {}
        }
    }
    found
}

/// The growth of all radii, in metres, that balances the two rates: it minimizes the larger of the upper ends of their
/// confidence intervals, each relative to its goal.
pub fn growth(samples: &[Sample], gaps: &[f64], limit: f64) -> f64 {
    let colliding = samples.iter().filter(|sample| sample.collides()).count();
    let free = samples.len() - colliding;
    if colliding == 0 || free == 0 {
        return 0.0;
    }
    let mut order: Vec<usize> = (0..samples.len()).collect();
    order.sort_by(|a, b| gaps[*a].total_cmp(&gaps[*b]));
    let (mut missed, mut false_contacts) = (colliding, 0);
    let mut best = (f64::INFINITY, 0.0);
    for (place, sample) in order.iter().enumerate() {
        if samples[*sample].collides() {
            missed -= 1
        } else {
            false_contacts += 1
        }
        let gap = gaps[*sample];
        let next = order.get(place + 1).map_or(limit, |next| gaps[*next]);
        // Spheres with gaps up to this threshold touch if all radii grow by half of it.
        let threshold = 0.5 * (gap + next);
        if threshold <= -limit || threshold >= limit || next <= gap {
            continue;
        }
        let worse = SphereRates { colliding, missed, free, false_contacts }.worse();
        if worse < best.0 {
            best = (worse, threshold);
        }
    }
    0.5 * best.1
}
