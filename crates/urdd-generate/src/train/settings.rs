//! How models are trained: the same for every robot. Found on UR5, Panda, xArm7, Z1, H1 and Orca.

/// How much work training is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Sampled configurations to train on.
    pub training: u32,
    /// Those to choose margins on, and to say when training ends.
    pub calibration: u32,
    /// Passes over all configurations, at most.
    pub epochs: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            training: 80_000,
            calibration: 20_000,
            epochs: 20,
        }
    }
}

impl Effort {
    /// The first of each part's sampled configurations, and their number: they follow each other from 0 on.
    pub(super) fn ranges(self) -> [[u32; 2]; 2] {
        [[0, self.training], [self.training, self.calibration]]
    }
}

/// Of so many of the calibration's configurations the loss is taken.
pub(super) const VALIDATION: usize = 5_000;

/// Most pairs of links: labels take 4 bytes for each, in each configuration.
pub const MOST_PAIRS: usize = 512;
/// Most DOFs: a configuration takes 8 bytes for each, and what the network is told of it 32.
pub const MOST_DOFS: usize = 100;
/// Least number of collisions, and of free configurations, among those of training.
pub(super) const LEAST: usize = 50;
/// A pair has an output where it came nearer than this, as a part of the clip distance.
pub(super) const NEAR: f64 = 0.5;

/// Values of each of the two hidden layers.
pub(super) const HIDDEN: usize = 64;
/// What all outputs begin with, as a part of the clip distance.
pub(super) const FIRST_OUTPUT: f64 = 0.7;
/// Which of the specification's sequences weights are drawn from: one that no sampled configuration is of.
pub(super) const SEED: u64 = 1 << 32;
/// How many networks are trained at most, from other initial weights each: the rates of about one in a hundred honest
/// models are not confirmed (SPEC 8.8.12), by chance.
pub(super) const ATTEMPTS: u64 = 3;

/// Training ends after so many passes that brought nothing.
pub(super) const PATIENCE: usize = 5;
/// Configurations of one step.
pub(super) const BATCH: usize = 128;
/// How far a step goes at first; it falls by half a cosine.
pub(super) const FIRST_STEP: f64 = 0.02;

/// In contact an output has to come out this far below 0, as a part of the clip distance.
pub(super) const IN_CONTACT: f64 = 0.3;
/// The weight of contact in the loss, where pairs that are far apart have 1.
pub(super) const CONTACT_WEIGHT: f64 = 5.0;
/// The weight of pairs that are near.
pub(super) const NEAR_WEIGHT: f64 = 2.0;

/// Of the collisions in the calibration's configurations this part may be missed.
pub(super) const MISSES: f64 = 0.005;
/// So many of a pair's contacts with the highest outputs are its tail, at most.
pub(super) const TAIL: usize = 10;
/// Misses of a pair that are to be expected of its first margin; each following one has twice as many.
pub(super) const FIRST_MISSES: f64 = 0.02;
/// How many margins are tried.
pub(super) const LEVELS: usize = 14;

/// Sampled configurations among the test vectors.
pub(super) const TEST_VECTORS: u32 = 8;
