//! Sampled configurations, and the pairs of links in contact in them according to the exact shapes.

use nalgebra::Isometry3;
use rayon::prelude::*;

use crate::frame::Pose;
use urdd_geometry::Mesh;
use urdd_geometry::convex::{BodyPairs, ShapeError};

/// Step of the fractions of the way from the default configuration: the additive golden-ratio sequence fills [0, 1)
/// evenly.
const STEP: f64 = 0.618_033_988_749_894_9;

/// A robot that moves.
pub trait Moves: Sync {
    /// Why it cannot.
    type Error: Send;

    /// The configuration that fitted spheres keep free: the default one (SPEC 9.4), or a reference in its place.
    fn start(&self) -> Result<Vec<f64>, Self::Error>;

    /// Sampled configuration `k` (SPEC 9.3).
    fn sampled(&self, k: u64) -> Result<Vec<f64>, Self::Error>;

    /// The poses of all links, in the root link's frame.
    fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, Self::Error>;
}

/// The region that configurations are sampled from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Region {
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
    /// Whether a pair is in contact.
    pub fn collides(&self) -> bool {
        !self.touching.is_empty()
    }
}

/// What to compute for each sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ask {
    /// The pairs in contact.
    Pairs,
    /// Whether any pair is in contact.
    Any,
}

/// Computes samples of a robot.
#[derive(Debug)]
pub struct Sampler<'a, R> {
    /// The robot.
    pub robot: &'a R,
    /// Its pairs.
    pub pairs: &'a Pairs,
}

impl<R> Clone for Sampler<'_, R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R> Copy for Sampler<'_, R> {}

impl<R: Moves> Sampler<'_, R> {
    /// `count` samples from index `first` on.
    pub fn samples(
        self,
        region: Region,
        first: u64,
        count: usize,
        ask: Ask,
    ) -> Result<Vec<Sample>, R::Error> {
        let one = |k: usize| self.nth(region, first, k, ask);
        (0..count).into_par_iter().map(one).collect()
    }

    /// Sample `k` of those from index `first` on.
    pub fn nth(self, region: Region, first: u64, k: usize, ask: Ask) -> Result<Sample, R::Error> {
        self.sample(&self.configuration(region, first + k as u64, k)?, ask)
    }

    /// The sample of the default configuration.
    pub fn zero(self, ask: Ask) -> Result<Sample, R::Error> {
        self.sample(&self.robot.start()?, ask)
    }

    fn sample(self, configuration: &[f64], ask: Ask) -> Result<Sample, R::Error> {
        let poses = self.robot.link_poses(configuration)?;
        let touching = match ask {
            Ask::Pairs => self.pairs.touching(&poses),
            Ask::Any => Vec::from_iter(self.pairs.any_touches(&poses).then_some(0)),
        };
        let poses = self.pairs.links.iter().map(|link| Pose::from(&poses[*link]));
        Ok(Sample { poses: poses.collect(), touching })
    }

    fn configuration(self, region: Region, number: u64, k: usize) -> Result<Vec<f64>, R::Error> {
        let mut q = self.robot.sampled(number)?;
        if region == Region::NearDefault {
            let part = (0.5 + STEP * k as f64) % 1.0;
            for (value, start) in q.iter_mut().zip(self.robot.start()?) {
                *value = start + part * (*value - start);
            }
        }
        Ok(q)
    }
}

/// Pairs of links with shapes of which at least one pair of pieces is checked.
#[derive(Debug)]
pub struct Pairs {
    /// The links that have shapes, ascending. All other link numbers here are indices into this list.
    pub links: Vec<usize>,
    /// The pieces of each of these links.
    pub pieces: Vec<Vec<Mesh>>,
    /// The pairs of links that are checked, each ascending.
    pub checked: Vec<[usize; 2]>,
    exact: BodyPairs,
}

impl Pairs {
    /// Of convex pieces, each with its link. `is_checked` says of two pieces whether contacts of them count.
    ///
    /// # Errors
    /// The index of the first invalid piece, and the reason.
    pub fn new(
        meshes: Vec<(usize, Mesh)>,
        is_checked: impl Fn(usize, usize) -> bool,
    ) -> Result<Self, (usize, ShapeError)> {
        let each = meshes.iter().map(|(link, mesh)| (*link, mesh.vertices.as_slice()));
        let mut exact = BodyPairs::new(each)?;
        let mut links: Vec<usize> = meshes.iter().map(|(link, _)| *link).collect();
        links.sort_unstable();
        links.dedup();
        let mut checked = Vec::new();
        for a in 0..links.len() {
            for b in a + 1..links.len() {
                if exact.add([links[a], links[b]], &is_checked) {
                    checked.push([a, b]);
                }
            }
        }
        let pieces = |link: &usize| {
            let own = meshes.iter().filter(|(of, _)| of == link);
            own.map(|(_, mesh)| mesh.clone()).collect()
        };
        Ok(Pairs { pieces: links.iter().map(pieces).collect(), links, checked, exact })
    }

    /// The indices of the pairs in contact, ascending. `poses` are those of all links of the robot.
    pub fn touching(&self, poses: &[Isometry3<f64>]) -> Vec<u32> {
        self.exact.touching(poses).into_iter().filter_map(|pair| u32::try_from(pair).ok()).collect()
    }

    /// Whether any pair is in contact.
    pub fn any_touches(&self, poses: &[Isometry3<f64>]) -> bool {
        self.exact.any_touches(poses)
    }
}
