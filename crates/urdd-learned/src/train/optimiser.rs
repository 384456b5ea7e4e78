//! Optimises the weights, by the loss of a few configurations and its gradient, with Adam (Kingma and Ba, 2015) and a
//! half-cosine learning rate schedule.

use std::f64::consts::PI;
use std::mem;

use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;

use crate::network::{LANES, Lanes, Layer, Network, dense_back, tanh_back};
use crate::train::labels::Labels;
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_kinematics::unit;

/// Sampling sequence for the initial weights; no sampled configuration uses it.
pub(super) const SEED: u64 = 1 << 32;
/// Calibration configurations used for the loss.
const VALIDATION: usize = 5_000;
/// Epochs without improvement before training stops.
const PATIENCE: usize = 5;
/// Batch size: configurations per step.
const BATCH: usize = 128;
/// Initial step size; it decays along half a cosine.
const FIRST_STEP: f64 = 0.02;
/// Target output in contact: this far below 0, as a fraction of the clip distance.
const IN_CONTACT: f64 = 0.3;
/// Weight of contacts in the loss, relative to 1 for distant pairs.
const CONTACT_WEIGHT: f64 = 5.0;
/// Weight of near pairs in the loss.
const NEAR_WEIGHT: f64 = 2.0;

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

/// Buffers for [`LANES`] configurations.
pub(super) struct Work {
    values: Vec<Vec<Lanes>>,
    /// Derivatives with respect to the values of the current layer, and of the layer before.
    by_values: [Vec<Lanes>; 2],
    /// Derivatives with respect to the weights and biases of each layer.
    pub gradients: Vec<Layer>,
    pub loss: f64,
}

impl Work {
    pub fn new(network: &Network) -> Self {
        let zeros = |layer: &Layer| Layer {
            weights: vec![0.0; layer.weights.len()],
            biases: vec![0.0; layer.biases.len()],
        };
        Self {
            values: network.buffers(),
            by_values: [Vec::new(), Vec::new()],
            gradients: network.layers.iter().map(zeros).collect(),
            loss: 0.0,
        }
    }

    /// Computes the loss of at most [`LANES`] configurations and, if requested, its gradients.
    pub fn run(
        &mut self,
        level: Level,
        network: &Network,
        (inputs, labels): (&[f64], &Labels),
        configurations: &[u32],
        with_gradients: bool,
    ) {
        let width = self.values[0].len();
        for (lane, configuration) in configurations.iter().enumerate() {
            let row = &inputs[*configuration as usize * width..][..width];
            for (value, input) in self.values[0].iter_mut().zip(row) {
                value[lane] = *input;
            }
        }
        network.values(level, &mut self.values);
        self.judge(labels, configurations);
        if with_gradients {
            dispatch!(level, simd => self.back(simd, network));
        }
    }

    /// Computes the loss and its derivative with respect to each output.
    fn judge(&mut self, labels: &Labels, configurations: &[u32]) {
        let outputs = self.values.last().map_or(&[][..], Vec::as_slice);
        let by_outputs = &mut self.by_values[0];
        by_outputs.clear();
        by_outputs.resize(outputs.len(), [0.0; LANES]);
        let mut loss = 0.0;
        for (lane, configuration) in configurations.iter().enumerate() {
            let distances = labels.row(*configuration as usize);
            for (pair, distance) in distances.iter().enumerate() {
                let (output, distance) = (outputs[pair][lane], f64::from(*distance));
                let (error, weight) = match distance {
                    0.0 => ((output + IN_CONTACT).max(0.0), CONTACT_WEIGHT),
                    1.0.. => ((output - 1.0).min(0.0), 1.0),
                    _ => (output - distance, NEAR_WEIGHT),
                };
                loss += weight * error * error;
                by_outputs[pair][lane] = 2.0 * weight * error;
            }
        }
        self.loss = loss;
    }

    #[inline(always)]
    fn back<S: Simd>(&mut self, _: S, network: &Network) {
        let [by_outputs, by_inputs] = &mut self.by_values;
        for (place, layer) in network.layers.iter().enumerate().rev() {
            let before = &self.values[place];
            by_weights(by_outputs, before, &mut self.gradients[place]);
            if place == 0 {
                return;
            }
            by_inputs.resize(before.len(), [0.0; LANES]);
            dense_back(&layer.weights, by_outputs, by_inputs);
            tanh_back(before, by_inputs);
            mem::swap(by_outputs, by_inputs);
        }
    }
}

/// The derivatives with respect to a layer's weights and biases.
#[inline(always)]
fn by_weights(by_outputs: &[Lanes], before: &[Lanes], gradients: &mut Layer) {
    let rows = gradients.weights.chunks_exact_mut(before.len().max(1));
    let outputs = rows.zip(&mut gradients.biases).zip(by_outputs);
    for ((row, bias), by_output) in outputs {
        for (gradient, value) in row.iter_mut().zip(before) {
            *gradient = dot(by_output, value);
        }
        *bias = dot(by_output, &[1.0; LANES]);
    }
}

/// The dot product, summed in a fixed order.
#[inline(always)]
fn dot(a: &Lanes, b: &Lanes) -> f64 {
    const SUMS: usize = 8;
    let mut sums = [0.0; SUMS];
    for (a, b) in a.chunks_exact(SUMS).zip(b.chunks_exact(SUMS)) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]))
}
