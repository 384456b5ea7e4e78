//! The ground truth of configurations.

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::settings;
use super::subject::{BLOCK, NoModel, Subject};
use crate::inputs::{self, Input};
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::fill;

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
