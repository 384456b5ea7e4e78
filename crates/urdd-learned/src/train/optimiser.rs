//! Optimises the weights with Adam (Kingma and Ba, 2015) and a half-cosine learning rate schedule.

use std::f64::consts::PI;

use fearless_simd::Level;
use rayon::prelude::*;

use super::backward::Work;
use super::labels::Labels;
use super::settings::{BATCH, FIRST_STEP, PATIENCE, SEED, VALIDATION};
use crate::kernel::LANES;
use crate::network::{Layer, Network};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_kinematics::unit;

/// Decay rates of the means of the gradients and of their squares.
const MEMORY: [f64; 2] = [0.9, 0.999];
/// Added to the root mean square to avoid division by zero.
const LEAST: f64 = 1e-8;

/// Examples: the network's inputs, row by row, and the labels.
pub(super) type Examples<'a> = (&'a [f64], &'a Labels);

/// Trains a network and keeps the weights with the lowest validation loss. `progress` receives the number of finished
/// epochs.
pub(super) fn train(
    network: &mut Network,
    (inputs, labels): Examples,
    validation: Examples,
    epochs: usize,
    cancellation: &Cancellation,
    progress: &dyn Fn(usize),
) -> Result<(), Cancelled> {
    let level = Level::new();
    let count = labels.collides.len();
    let mut order: Vec<u32> = (0..u32::try_from(count).unwrap_or(u32::MAX)).collect();
    let mut works: Vec<Work> = (0..BATCH / LANES).map(|_| Work::new(network)).collect();
    let size = numbers(&network.layers).count();
    let mut means = [vec![0.0; size], vec![0.0; size]];
    let steps = epochs * (count / BATCH);
    let mut step = 0;
    let (mut best, mut least, mut since) = (network.clone(), f64::INFINITY, 0);
    for epoch in 0..epochs {
        shuffle(&mut order, epoch);
        for batch in order.chunks_exact(BATCH) {
            cancellation.check()?;
            works.par_iter_mut().zip(batch.par_chunks(LANES)).for_each(|(work, configurations)| {
                work.run(level, network, (inputs, labels), configurations, true);
            });
            step += 1;
            let part = f64::from(step) / steps as f64;
            let size = 0.5 * FIRST_STEP * (1.0 + (PI * part).cos());
            advance(network, &works, &mut means, step, size);
        }
        progress(epoch + 1);
        let loss = loss(network, validation, level);
        if loss < least {
            (best, least, since) = (network.clone(), loss, 0);
        } else {
            since += 1;
            if since == PATIENCE {
                break;
            }
        }
    }
    *network = best;
    Ok(())
}

/// Shuffles the order for an epoch; deterministic.
fn shuffle(order: &mut [u32], epoch: usize) {
    let sequence = SEED + 1 + epoch as u64;
    for last in (1..order.len()).rev() {
        let other = (unit(sequence, last as u64) * (last + 1) as f64) as usize;
        order.swap(last, other.min(last));
    }
}

/// All weights and biases in a fixed order.
fn numbers(layers: &[Layer]) -> impl Iterator<Item = &f64> {
    layers.iter().flat_map(|layer| layer.weights.iter().chain(&layer.biases))
}

/// One Adam step with the summed gradients of a batch.
fn advance(network: &mut Network, works: &[Work], means: &mut [Vec<f64>; 2], step: i32, size: f64) {
    let [first, second] = means;
    let corrections = MEMORY.map(|memory| 1.0 - libm::pow(memory, f64::from(step)));
    let mut parts: Vec<_> = works.iter().map(|work| numbers(&work.gradients)).collect();
    let layers = network.layers.iter_mut();
    let all = layers.flat_map(|layer| layer.weights.iter_mut().chain(&mut layer.biases));
    for ((number, first), second) in all.zip(first).zip(second) {
        let gradient = parts.iter_mut().filter_map(Iterator::next).sum::<f64>() / BATCH as f64;
        *first = MEMORY[0] * *first + (1.0 - MEMORY[0]) * gradient;
        *second = MEMORY[1] * *second + (1.0 - MEMORY[1]) * gradient * gradient;
        let spread = (*second / corrections[1]).sqrt() + LEAST;
        *number -= size * (*first / corrections[0]) / spread;
    }
}

/// The loss over the first [`VALIDATION`] examples.
fn loss(network: &Network, (inputs, labels): Examples, level: Level) -> f64 {
    let count = labels.collides.len().min(VALIDATION);
    let all: Vec<u32> = (0..u32::try_from(count).unwrap_or(u32::MAX)).collect();
    let parts: Vec<f64> = all
        .par_chunks(LANES)
        .map_init(
            || Work::new(network),
            |work, configurations| {
                work.run(level, network, (inputs, labels), configurations, false);
                work.loss
            },
        )
        .collect();
    parts.iter().sum()
}
