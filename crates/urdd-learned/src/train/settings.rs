//! Training settings, the same for every robot. Tuned on UR5, Panda, xArm7, Z1, H1 and Orca.

/// How much to train.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Number of sampled configurations for training.
    pub training: u32,
    /// Number of sampled configurations for choosing margins and for early stopping.
    pub calibration: u32,
    /// Maximum number of epochs.
    pub epochs: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self { training: 80_000, calibration: 20_000, epochs: 20 }
    }
}

impl Effort {
    /// The first sampled configuration of each part and its count. The parts follow each other from 0.
    pub(super) fn ranges(self) -> [[u32; 2]; 2] {
        [[0, self.training], [self.training, self.calibration]]
    }
}

/// Version of the training; changed whenever the trained model changes.
pub const VERSION: &str = "2";

/// Distances are clipped at this fraction of the largest distance between two hulls.
pub(super) const CLIP: f64 = 1.0 / 16.0;

/// Calibration configurations used for the loss.
pub(super) const VALIDATION: usize = 5_000;

/// Maximum number of pairs of links: labels take 4 bytes per pair and configuration.
pub const MAX_PAIRS: usize = 512;
/// Maximum number of DOFs: a configuration takes 8 bytes per DOF, and its network inputs 32.
pub(super) const MAX_DOFS: usize = 100;
/// Minimum number of collisions, and of free configurations, in the training set.
pub(super) const LEAST: usize = 50;
/// A pair gets an output if it comes nearer than this, as a fraction of the clip distance.
pub(super) const NEAR: f64 = 0.5;

/// Size of each of the two hidden layers.
pub(super) const HIDDEN: usize = 64;
/// Initial value of all outputs, as a fraction of the clip distance.
pub(super) const FIRST_OUTPUT: f64 = 0.7;
/// Sampling sequence for the initial weights; no sampled configuration uses it.
pub(super) const SEED: u64 = 1 << 32;
/// Maximum number of training attempts, each with different initial weights. By chance, the rates of about one in a
/// hundred honest models are not confirmed (SPEC 8.8.12).
pub(super) const ATTEMPTS: u64 = 3;

/// Epochs without improvement before training stops.
pub(super) const PATIENCE: usize = 5;
/// Batch size: configurations per step.
pub(super) const BATCH: usize = 128;
/// Initial step size; it decays along half a cosine.
pub(super) const FIRST_STEP: f64 = 0.02;

/// Target output in contact: this far below 0, as a fraction of the clip distance.
pub(super) const IN_CONTACT: f64 = 0.3;
/// Weight of contacts in the loss, relative to 1 for distant pairs.
pub(super) const CONTACT_WEIGHT: f64 = 5.0;
/// Weight of near pairs in the loss.
pub(super) const NEAR_WEIGHT: f64 = 2.0;

/// The fraction of collisions in the calibration set that may be missed.
pub(super) const MISSES: f64 = 0.005;
/// Maximum number of a pair's contacts with the highest outputs that form its tail.
pub(super) const TAIL: usize = 10;
/// Expected misses of a pair at its first margin; each further level doubles them.
pub(super) const FIRST_MISSES: f64 = 0.02;
/// Maximum number of margins to try per pair.
pub(super) const LEVELS: usize = 14;

/// Number of sampled configurations among the test vectors.
pub(super) const TEST_VECTORS: u32 = 8;
