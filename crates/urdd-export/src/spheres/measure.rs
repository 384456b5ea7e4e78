//! Measuring spheres in configurations that had no part in the fit.

use super::judge::{self, PairFaults, SphereRates};
use super::model::Spheres;
use super::pairs::Pairs;
use super::samples::{Ask, Region, Sample, nth, sample, samples};
use urdd_robot::{Robot, RobotError};

/// How many configurations are sampled. The numbers of the first are such that none is in two sets, nor among those that
/// a URDD's own statistics and skips come from.
pub(super) struct Numbers {
    pub fit: usize,
    pub grow: usize,
    pub measure: usize,
}

/// Fewer would say nothing.
const LEAST: usize = 100;
/// Poses that are kept at most.
const POSES: usize = 2_000_000;
/// Pairs of links, and pairs of spheres of two links, that are looked at, at most.
const LOOKS: usize = 200_000_000;
/// So many spheres of a link are few.
const FEW: usize = 16;
/// Wrong answers of which the pairs are found, at most.
const TRACED: usize = 2000;

impl Numbers {
    /// The number of the first sample (SPEC 9.3) of those that spheres are fitted to.
    pub const FIT: u64 = 1_000_000;
    /// Of those that balance the two rates.
    pub const GROW: u64 = 2_000_000;
    /// Of those that the rates are counted in.
    pub const MEASURE: u64 = 3_000_000;

    /// `wanted` samples are measured, or fewer where that is much work.
    pub fn new(wanted: usize, pairs: &Pairs, spheres_per_link: usize) -> Self {
        let many = (spheres_per_link / FEW).max(1);
        let most = (POSES / pairs.links.len().max(1)).min(LOOKS / pairs.checked.len().max(1))
            / (many * many);
        let most = most.max(LEAST);
        Numbers {
            fit: wanted.saturating_add(wanted / 2).min(most),
            grow: wanted.min(most),
            measure: wanted.min(most),
        }
    }
}

/// How spheres answer.
#[derive(Debug)]
pub(super) struct Measured {
    /// In configurations from all that bounds allow; `None` where no pair is checked.
    pub rates: Option<SphereRates>,
    /// In configurations near the default one, where these had a part in the fit.
    pub near_default: Option<SphereRates>,
    /// Whether the exact shapes collide in the default configuration, and whether spheres touch.
    pub default: [bool; 2],
    /// The pairs of links behind wrong answers, the worst first.
    pub faults: Vec<([usize; 2], PairFaults)>,
}

impl Measured {
    /// Whether both rates are within the goals, and the default configuration is free where it is.
    pub fn is_good(&self) -> bool {
        let all = self.rates.iter().chain(&self.near_default);
        let [collides, touches] = self.default;
        let is_few =
            |rates: &SphereRates| self.near_default.is_some() && Some(rates) == self.rates.as_ref();
        let is_good = |rates: &SphereRates| match is_few(rates) {
            // Too few are free to count what is wrong in them.
            true => SphereRates {
                free: 0,
                false_contacts: 0,
                ..*rates
            }
            .are_within_goals(),
            false => rates.are_within_goals(),
        };
        (collides || !touches) && all.into_iter().all(is_good)
    }
}

pub(super) fn measure(
    robot: &Robot,
    pairs: &Pairs,
    spheres: &Spheres,
    ignored: &[bool],
    numbers: &Numbers,
    near: bool,
) -> Result<Measured, RobotError> {
    let mut measured = Measured {
        rates: None,
        near_default: None,
        default: [false; 2],
        faults: Vec::new(),
    };
    if pairs.checked.is_empty() {
        return Ok(measured);
    }
    let gaps = |samples: &[Sample]| {
        // Whether they touch is all that counts.
        judge::gaps(spheres, &pairs.checked, ignored, samples, f64::MIN_POSITIVE)
    };
    let zero = sample(robot, pairs, &robot.configurations()?.zero(), Ask::Any)?;
    measured.default = [zero.collides(), gaps(std::slice::from_ref(&zero))[0] <= 0.0];
    let mut wrong: Vec<Sample> = Vec::new();
    let mut count = |region| -> Result<SphereRates, RobotError> {
        let (first, number) = (Numbers::MEASURE, numbers.measure);
        let known = samples(robot, pairs, region, first, number, Ask::Any)?;
        let gaps = gaps(&known);
        for (k, (sample, gap)) in known.iter().zip(&gaps).enumerate() {
            if sample.collides() != (*gap <= 0.0) && wrong.len() < TRACED {
                wrong.push(nth(robot, pairs, region, first, k)?);
            }
        }
        Ok(judge::rates(&known, &gaps))
    };
    measured.rates = Some(count(Region::Bounds)?);
    if near {
        measured.near_default = Some(count(Region::NearDefault)?);
    }
    if measured.default == [false, true] {
        wrong.push(zero);
    }
    let faults = judge::faults(spheres, &pairs.checked, ignored, &wrong);
    let mut faults: Vec<([usize; 2], PairFaults)> = faults
        .into_iter()
        .map(|(pair, faults)| (pairs.checked[pair].map(|link| pairs.links[link]), faults))
        .collect();
    // A missed collision counts as much beside its goal as five false contacts beside theirs.
    faults.sort_by_key(|(links, faults)| {
        (
            std::cmp::Reverse(5 * faults.missed + faults.false_contacts),
            *links,
        )
    });
    measured.faults = faults;
    Ok(measured)
}
