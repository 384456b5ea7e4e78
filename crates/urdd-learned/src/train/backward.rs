//! The loss of a few configurations and its gradient with respect to all weights.

use std::mem;

use fearless_simd::{Level, Simd, dispatch};

use super::labels::Labels;
use super::settings::{CONTACT_WEIGHT, IN_CONTACT, NEAR_WEIGHT};
use crate::kernel::{self, LANES, Lanes};
use crate::network::{Layer, Network};

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
            kernel::dense_back(&layer.weights, by_outputs, by_inputs);
            kernel::tanh_back(before, by_inputs);
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
