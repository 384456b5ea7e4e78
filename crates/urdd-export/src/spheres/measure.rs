//! Evaluates spheres in configurations that were not used for the fit.

use super::moving::Moving;
use urdd_robot::{Robot, RobotError};
use urdd_spheres::fitted::Numbers;
use urdd_spheres::judge::{self, PairFaults, SphereRates};
use urdd_spheres::model::Spheres;
use urdd_spheres::samples::Pairs;
use urdd_spheres::samples::{Ask, Region, Sample, Sampler};

/// Maximum number of wrong results that are traced to pairs.
const TRACED: usize = 2000;

/// The results of an evaluation.
#[derive(Debug, Default)]
pub(super) struct Measured {
    /// Rates in configurations throughout the bounds; `None` if no pair is checked.
    pub rates: Option<SphereRates>,
    /// Rates in configurations near the default one, if the fit used such configurations.
    pub near_default: Option<SphereRates>,
    /// Whether the exact shapes collide in the default configuration, and whether the spheres touch.
    pub default: [bool; 2],
    /// The pairs of links that cause wrong results, worst first.
    pub faults: Vec<([usize; 2], PairFaults)>,
}

impl Measured {
    /// Whether both rates are within the goals, and the spheres are free in the default configuration if the shapes
    /// are.
    pub fn is_good(&self) -> bool {
        let all = self.rates.iter().chain(&self.near_default);
        let [collides, touches] = self.default;
        let is_few =
            |rates: &SphereRates| self.near_default.is_some() && Some(rates) == self.rates.as_ref();
        let is_good = |rates: &SphereRates| match is_few(rates) {
            // Too few free configurations to count false contacts.
            true => SphereRates { free: 0, false_contacts: 0, ..*rates }.are_within_goals(),
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
    let mut measured = Measured::default();
    if pairs.checked.is_empty() {
        return Ok(measured);
    }
    let gaps = |samples: &[Sample]| {
        // Only whether they touch matters here.
        judge::gaps(spheres, &pairs.checked, ignored, samples, f64::MIN_POSITIVE)
    };
    let sampler = Sampler { robot: &Moving(robot), pairs };
    let zero = sampler.zero(Ask::Any)?;
    measured.default = [zero.collides(), gaps(std::slice::from_ref(&zero))[0] <= 0.0];
    let mut wrong: Vec<Sample> = Vec::new();
    let mut count = |region| -> Result<SphereRates, RobotError> {
        let (first, number) = (Numbers::MEASURE, numbers.measure);
        let known = sampler.samples(region, first, number, Ask::Any)?;
        let gaps = gaps(&known);
        for (k, (sample, gap)) in known.iter().zip(&gaps).enumerate() {
            if sample.collides() != (*gap <= 0.0) && wrong.len() < TRACED {
                wrong.push(sampler.nth(region, first, k, Ask::Pairs)?);
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
    // A missed collision weighs as much as five false contacts, in line with the goals of 1 % and 5 %.
    faults.sort_by_key(|(links, faults)| {
        (std::cmp::Reverse(5 * faults.missed + faults.false_contacts), *links)
    });
    measured.faults = faults;
    Ok(measured)
}
