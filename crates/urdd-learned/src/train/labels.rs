//! The ground truth of configurations: to learn from, and to measure how often a model is right (SPEC 8.8.9 to 8.8.12).

use nalgebra::Isometry3;
use rayon::prelude::*;
use sha2::{Digest, Sha256};

use crate::inputs::{self, Input};
use crate::model::CollisionModel;
use crate::train::subject::{BLOCK, NoModel, Subject};
use urdd_directory::cancellation::Cancellation;
use urdd_format::self_collision_model::{
    CONFIRMATION_SECOND, EVALUATION_FIRST, EVALUATION_MIN, ModelEvaluation, NEAR_CONTACT_STEP,
    SelfCollisionModelModule,
};
use urdd_kinematics::fill;

/// Minimum number of collisions, and of free configurations, in the training set.
const LEAST: usize = 50;

/// Sampled configurations and the distances of all pairs.
pub struct Labels {
    pub configurations: Vec<f64>,
    pub num_dofs: usize,
    /// One distance per pair and configuration, as a fraction of the clip distance, at most 1.
    pub distances: Vec<f32>,
    pub num_pairs: usize,
    /// Whether any pair is in contact.
    pub collides: Vec<bool>,
}

impl Labels {
    /// Labels of `count` sampled configurations from `first` on.
    pub fn new(
        subject: &Subject,
        [first, count]: [u32; 2],
        cancellation: &Cancellation,
    ) -> Result<Self, NoModel> {
        let num_pairs = subject.pairs.bodies().len();
        let num_dofs = subject.space.num_dofs();
        let clip = subject.clip_distance();
        let configurations = subject.configurations([first, count]);
        let mut distances = vec![0.0_f32; count as usize * num_pairs];
        type Memory = (Vec<Isometry3<f64>>, Vec<f64>);
        fill(&mut distances, num_pairs, BLOCK, |(poses, metres): &mut Memory, k, row| {
            cancellation.check()?;
            let configuration = &configurations[k * num_dofs..][..num_dofs];
            subject.kinematics.link_poses_into(configuration, poses)?;
            metres.resize(num_pairs, 0.0);
            subject.pairs.distances(poses, clip, metres);
            for (to, from) in row.iter_mut().zip(metres) {
                // A distance without contact stays above 0.
                *to = match *from > 0.0 {
                    true => ((*from / clip) as f32).max(f32::MIN_POSITIVE),
                    false => 0.0,
                };
            }
            Ok::<(), NoModel>(())
        })?;
        let collides = distances.chunks(num_pairs).map(|row| row.contains(&0.0)).collect();
        Ok(Self { configurations, num_dofs, distances, num_pairs, collides })
    }

    /// Checks that there are enough collisions and free configurations to learn from.
    pub fn check(&self) -> Result<(), NoModel> {
        let colliding = self.collides.iter().filter(|collides| **collides).count();
        NoModel::check_counts(colliding, self.collides.len(), LEAST)
    }

    /// The pairs that come nearer than `limit`, a fraction of the clip distance.
    pub fn near_pairs(&self, limit: f64) -> Vec<usize> {
        let mut least = vec![f32::INFINITY; self.num_pairs];
        for row in self.distances.chunks(self.num_pairs) {
            for (least, distance) in least.iter_mut().zip(row) {
                *least = least.min(*distance);
            }
        }
        let limit = limit as f32;
        (0..self.num_pairs).filter(|pair| least[*pair] < limit).collect()
    }

    /// Keeps the distances of these pairs only. `collides` still covers all pairs.
    pub fn keep(&mut self, pairs: &[usize]) {
        let rows = self.distances.chunks(self.num_pairs);
        self.distances = rows.flat_map(|row| pairs.iter().map(|pair| row[*pair])).collect();
        self.num_pairs = pairs.len();
    }

    /// The network's inputs for each configuration, row by row.
    pub fn inputs(&self, inputs: &[Input]) -> Vec<f64> {
        let width = inputs.iter().map(Input::width).sum::<usize>().max(1);
        let num_dofs = self.num_dofs.max(1);
        let mut rows = vec![0.0; self.configurations.len() / num_dofs * width];
        let configurations = self.configurations.par_chunks_exact(num_dofs);
        let each = rows.par_chunks_exact_mut(width).zip(configurations);
        each.for_each(|(row, configuration)| inputs::write(inputs, configuration, row));
        rows
    }

    /// The distances in a configuration.
    pub fn row(&self, configuration: usize) -> &[f32] {
        &self.distances[configuration * self.num_pairs..][..self.num_pairs]
    }
}

/// Sampled configurations and the true state of each.
pub(super) struct Counted {
    configurations: Vec<f64>,
    truths: Vec<Truth>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Truth {
    Free,
    Colliding,
    /// In collision, and a small step away from a free configuration.
    NearContact,
}

impl Counted {
    /// `count` sampled configurations from `first` on. Only those of the evaluation are checked for near contact.
    pub fn new(
        subject: &Subject,
        [first, count]: [u32; 2],
        cancellation: &Cancellation,
    ) -> Result<Self, NoModel> {
        let configurations = subject.configurations([first, count]);
        let num_dofs = subject.space.num_dofs();
        let mut truths = vec![Truth::Free; count as usize];
        fill(&mut truths, 1, BLOCK, |poses: &mut Vec<_>, k, truth| {
            cancellation.check()?;
            let mut collides = |configuration: &[f64]| -> Result<bool, NoModel> {
                subject.kinematics.link_poses_into(configuration, poses)?;
                Ok(subject.pairs.any_touches(poses))
            };
            let configuration = &configurations[k * num_dofs..][..num_dofs];
            let next = || subject.space.sampled(u64::from(first) + k as u64 + 1);
            truth[0] = if !collides(configuration)? {
                Truth::Free
            } else if first != EVALUATION_FIRST || collides(&stepped(configuration, &next()))? {
                Truth::Colliding
            } else {
                Truth::NearContact
            };
            Ok::<(), NoModel>(())
        })?;
        Ok(Self { configurations, truths })
    }

    /// Checks that there are enough collisions and free configurations to state rates.
    pub fn check(&self) -> Result<(), NoModel> {
        let colliding = self.truths.iter().filter(|truth| **truth != Truth::Free).count();
        NoModel::check_counts(colliding, self.truths.len(), EVALUATION_MIN as usize)
    }

    pub fn count(&self, model: &CollisionModel) -> Result<ModelEvaluation, NoModel> {
        let may_collide = model.may_collide_batch(&self.configurations)?;
        let mut counts = ModelEvaluation::NOTHING;
        for (truth, may_collide) in self.truths.iter().zip(may_collide) {
            let cleared = u32::from(!may_collide);
            match truth {
                Truth::Free => {
                    counts.num_free.0 += 1;
                    counts.num_cleared.0 += cleared;
                }
                Truth::Colliding | Truth::NearContact => {
                    counts.num_colliding.0 += 1;
                    counts.num_missed.0 += cleared;
                }
            }
            if *truth == Truth::NearContact {
                counts.num_near_contact.0 += 1;
                counts.num_near_contact_missed.0 += cleared;
            }
        }
        Ok(counts)
    }
}

/// A step towards another configuration; no DOF changes by more than [`NEAR_CONTACT_STEP`].
fn stepped(from: &[f64], to: &[f64]) -> Vec<f64> {
    let largest = from.iter().zip(to).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
    let part = if largest > NEAR_CONTACT_STEP { NEAR_CONTACT_STEP / largest } else { 1.0 };
    from.iter().zip(to).map(|(a, b)| a + part * (b - a)).collect()
}

/// The first configuration of the second confirmation, from 29 bits of the SHA-256 of the network's weights, biases and
/// margins.
pub(super) fn second_confirmation(module: &SelfCollisionModelModule) -> u32 {
    let numbers = module.layers.iter().flat_map(|of| of.weights.iter().flatten().chain(&of.biases));
    let margins = module.pairs.iter().map(|pair| &pair.margin);
    let mut hash = Sha256::new();
    for number in numbers.chain(margins) {
        hash.update(number.to_le_bytes());
    }
    let digest: [u8; 32] = hash.finalize().into();
    let first = u32::from_be_bytes([digest[0], digest[1], digest[2], digest[3]]);
    CONFIRMATION_SECOND + (first >> 3)
}
