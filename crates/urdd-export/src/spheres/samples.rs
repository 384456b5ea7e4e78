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

/// Computes samples of a robot.
#[derive(Clone, Copy)]
pub(super) struct Sampler<'a> {
    pub robot: &'a Robot,
    pub pairs: &'a Pairs,
}

impl Sampler<'_> {
    /// `count` samples from index `first` on.
    pub fn samples(
        self,
        region: Region,
        first: u64,
        count: usize,
        ask: Ask,
    ) -> Result<Vec<Sample>, RobotError> {
        let one = |k: usize| self.nth(region, first, k, ask);
        (0..count).into_par_iter().map(one).collect()
    }

    /// Sample `k` of those from index `first` on.
    pub fn nth(self, region: Region, first: u64, k: usize, ask: Ask) -> Result<Sample, RobotError> {
        let configurations = self.robot.configurations()?;
        self.sample(&configuration(configurations, region, first + k as u64, k), ask)
    }

    /// The sample of the default configuration.
    pub fn zero(self, ask: Ask) -> Result<Sample, RobotError> {
        self.sample(&self.robot.configurations()?.zero(), ask)
    }

    fn sample(self, configuration: &[f64], ask: Ask) -> Result<Sample, RobotError> {
        let poses = self.robot.link_poses(configuration)?;
        let touching = match ask {
            Ask::Pairs => self.pairs.touching(&poses),
            Ask::Any => Vec::from_iter(self.pairs.any_touches(&poses).then_some(0)),
        };
        let poses = self.pairs.links.iter().map(|link| Pose::from(&poses[*link]));
        Ok(Sample { poses: poses.collect(), touching })
    }
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
