//! The ground truth of configurations.

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::settings;
use super::subject::{NoModel, Subject};
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::learn::inputs::{self, Input};

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

/// Number of configurations per parallel task.
const BLOCK: usize = 64;

impl Labels {
    /// Labels of `count` sampled configurations from `first` on.
    pub fn new(
        subject: &Subject,
        [first, count]: [u32; 2],
        cancellation: &Cancellation,
    ) -> Result<Self, NoModel> {
        let num_pairs = subject.pairs.bodies().len();
        let num_dofs = subject.space.num_dofs();
        let clip = subject.clip_distance;
        let mut configurations = vec![0.0; count as usize * num_dofs];
        let mut distances = vec![0.0_f32; count as usize * num_pairs];
        let blocks = configurations
            .par_chunks_mut(BLOCK * num_dofs.max(1))
            .zip(distances.par_chunks_mut(BLOCK * num_pairs.max(1)))
            .enumerate();
        let faults: Vec<NoModel> = blocks
            .filter_map(|(block, (configurations, distances))| {
                if let Err(cancelled) = cancellation.check() {
                    return Some(cancelled.into());
                }
                let mut poses: Vec<Isometry3<f64>> = Vec::new();
                let mut of_pairs = vec![0.0; num_pairs];
                let rows = configurations.chunks_mut(num_dofs).zip(distances.chunks_mut(num_pairs));
                for (k, (configuration, distances)) in rows.enumerate() {
                    let sample = u64::from(first) + (block * BLOCK + k) as u64;
                    configuration.copy_from_slice(&subject.space.sampled(sample));
                    let kinematics = subject.kinematics;
                    if let Err(error) = kinematics.link_poses_into(configuration, &mut poses) {
                        return Some(error.into());
                    }
                    subject.pairs.distances(&poses, clip, &mut of_pairs);
                    for (to, from) in distances.iter_mut().zip(&of_pairs) {
                        // A distance without contact stays above 0.
                        *to = match *from > 0.0 {
                            true => ((from / clip) as f32).max(f32::MIN_POSITIVE),
                            false => 0.0,
                        };
                    }
                }
                None
            })
            .collect();
        if let Some(fault) = faults.into_iter().next() {
            return Err(fault);
        }
        let collides = distances.chunks(num_pairs).map(|row| row.contains(&0.0)).collect();
        Ok(Self { configurations, num_dofs, distances, num_pairs, collides })
    }

    /// Checks that there are enough collisions and free configurations to learn from.
    pub fn check(&self) -> Result<(), NoModel> {
        let colliding = self.collides.iter().filter(|collides| **collides).count();
        NoModel::check_counts(colliding, self.collides.len(), settings::LEAST)
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
