//! Sampled configurations, and the pairs of links in contact in them according to the exact shapes.

use rayon::prelude::*;

use super::frame::Pose;
use super::pairs::Pairs;
use urdd_robot::{Configurations, Robot, RobotError};

/// Step of the fractions of the way from the default configuration: the additive golden-ratio sequence fills [0, 1)
/// evenly.
const STEP: f64 = 0.618_033_988_749_894_9;

/// The region that configurations are sampled from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Region {
    /// Throughout the bounds: sample `k` is sample `k` of SPEC 9.3.
    Bounds,
    /// Each sample is moved towards the default configuration by a fraction of the way; the fractions are uniform in 0
    /// to 1.
    NearDefault,
}

/// A configuration.
#[derive(Debug, Clone)]
pub struct Sample {
    /// The poses of the links that have shapes, in the order of `Pairs::links`.
    pub poses: Vec<Pose>,
    /// The indices of the pairs in contact, ascending. With `Ask::Any`, a collision lists at most one pair, which can
    /// be any of them.
    pub touching: Vec<u32>,
}

impl Sample {
    pub fn collides(&self) -> bool {
        !self.touching.is_empty()
    }
}

/// What to compute for each sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ask {
    /// The pairs in contact.
    Pairs,
    /// Whether any pair is in contact.
    Any,
}

/// `count` samples from index `first` on.
pub(super) fn samples(
    robot: &Robot,
    pairs: &Pairs,
    region: Region,
    first: u64,
    count: usize,
    ask: Ask,
) -> Result<Vec<Sample>, RobotError> {
    let configurations = robot.configurations()?;
    let one = |k: usize| {
        let q = configuration(configurations, region, first + k as u64, k);
        sample(robot, pairs, &q, ask)
    };
    (0..count).into_par_iter().map(one).collect()
}

/// Sample `k` of those from index `first` on, with the pairs in contact.
pub(super) fn nth(
    robot: &Robot,
    pairs: &Pairs,
    region: Region,
    first: u64,
    k: usize,
) -> Result<Sample, RobotError> {
    let q = configuration(robot.configurations()?, region, first + k as u64, k);
    sample(robot, pairs, &q, Ask::Pairs)
}

/// The sample of a configuration.
pub(super) fn sample(
    robot: &Robot,
    pairs: &Pairs,
    configuration: &[f64],
    ask: Ask,
) -> Result<Sample, RobotError> {
    let poses = robot.link_poses(configuration)?;
    let touching = match ask {
        Ask::Pairs => pairs.touching(&poses),
        Ask::Any => Vec::from_iter(pairs.any_touches(&poses).then_some(0)),
    };
    Ok(Sample {
        poses: pairs.links.iter().map(|link| Pose::from(&poses[*link])).collect(),
        touching,
    })
}

fn configuration(
    configurations: &Configurations,
    region: Region,
    number: u64,
    k: usize,
) -> Vec<f64> {
    let mut q = configurations.random(number);
    if region == Region::NearDefault {
        let part = (0.5 + STEP * k as f64) % 1.0;
        for (value, start) in q.iter_mut().zip(configurations.zero()) {
            *value = start + part * (*value - start);
        }
    }
    q
}
