//! A fully connected network: SPEC 8.8.4.

use fearless_simd::{Level, Simd, dispatch};

use super::error::ModelError;
use super::kernel::{self, LANES, Lanes};
use urdd_format::self_collision_model::ModelLayer;

/// A layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Row-major, one row per output.
    pub weights: Vec<f64>,
    /// One per output.
    pub biases: Vec<f64>,
}

impl Layer {
    /// Number of inputs.
    pub fn num_inputs(&self) -> usize {
        self.weights.len() / self.biases.len().max(1)
    }
}

/// Consecutive layers, with a hyperbolic tangent between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    /// The layers, from the inputs to the outputs.
    pub layers: Vec<Layer>,
}

impl Network {
    /// Reads the layers of a network with `num_inputs` inputs and `num_outputs` outputs.
    pub fn read(
        layers: &[ModelLayer],
        num_inputs: usize,
        num_outputs: usize,
    ) -> Result<Self, ModelError> {
        if num_inputs == 0 {
            return Err(ModelError::empty("/inputs", "entry"));
        }
        let mut width = num_inputs;
        let mut read = Vec::with_capacity(layers.len());
        for (place, layer) in layers.iter().enumerate() {
            let fits = |found: usize, expected: usize, key: &str, what: &str| {
                let fault = || format!("found {found} entries, but {what} requires {expected}");
                let error = || ModelError::new(format!("/layers/{place}/{key}"), fault());
                (found == expected).then_some(()).ok_or_else(error)
            };
            let rows = layer.weights.len();
            if rows == 0 {
                return Err(ModelError::empty(format!("/layers/{place}/weights"), "entry"));
            }
            fits(layer.biases.len(), rows, "biases", "weights")?;
            for (row, weights) in layer.weights.iter().enumerate() {
                fits(weights.len(), width, &format!("weights/{row}"), "the previous layer")?;
            }
            let is_last = place + 1 == layers.len();
            if is_last {
                fits(rows, num_outputs, "weights", "pairs")?;
            }
            let numbers = layer.weights.iter().flatten().chain(&layer.biases);
            if !numbers.clone().all(|number| number.is_finite()) {
                return Err(ModelError::number(format!("/layers/{place}")));
            }
            read.push(Layer { weights: layer.weights.concat(), biases: layer.biases.clone() });
            width = rows;
        }
        if read.is_empty() {
            return Err(ModelError::empty("/layers", "layer"));
        }
        Ok(Self { layers: read })
    }

    /// Computes the values after each layer for several configurations. Layer k writes to index k + 1; index 0 contains
    /// the inputs.
    pub fn values(&self, level: Level, values: &mut [Vec<Lanes>]) {
        dispatch!(level, simd => self.values_with(simd, values));
    }

    #[inline(always)]
    fn values_with<S: Simd>(&self, _: S, values: &mut [Vec<Lanes>]) {
        let last = self.layers.len().saturating_sub(1);
        for (place, layer) in self.layers.iter().enumerate() {
            let (before, after) = values.split_at_mut(place + 1);
            let (inputs, outputs) = (&before[place], &mut after[0]);
            kernel::dense(&layer.weights, &layer.biases, inputs, outputs);
            if place != last {
                kernel::tanh_all(outputs);
            }
        }
    }

    /// Buffers for [`Network::values`].
    pub fn buffers(&self) -> Vec<Vec<Lanes>> {
        let zeros = |count: usize| vec![[0.0; LANES]; count];
        let first = self.layers.first().map_or(0, Layer::num_inputs);
        let rest = self.layers.iter().map(|layer| zeros(layer.biases.len()));
        std::iter::once(zeros(first)).chain(rest).collect()
    }

    /// The values after each layer for one configuration, bit-identical to [`Network::values`].
    pub fn values_of_one(&self, inputs: Vec<f64>) -> Vec<Vec<f64>> {
        let last = self.layers.len().saturating_sub(1);
        let mut values = vec![inputs];
        for (place, layer) in self.layers.iter().enumerate() {
            let inputs = &values[place];
            let rows = layer.weights.chunks_exact(inputs.len().max(1));
            let sum = |(row, bias): (&[f64], &f64)| {
                let products = row.iter().zip(inputs).map(|(weight, x)| weight * x);
                products.fold(*bias, |sum, product| sum + product)
            };
            let mut outputs: Vec<f64> = rows.zip(&layer.biases).map(sum).collect();
            if place != last {
                outputs.iter_mut().for_each(|value| *value = kernel::tanh(*value));
            }
            values.push(outputs);
        }
        values
    }

    /// The gradient of an output with respect to the inputs, from the values after each layer.
    pub fn derivative(&self, values: &[Vec<f64>], output: usize) -> Vec<f64> {
        let last = self.layers.len().saturating_sub(1);
        let mut by_values: Vec<f64> = Vec::new();
        for (place, layer) in self.layers.iter().enumerate().rev() {
            let rows = layer.weights.chunks_exact(layer.num_inputs().max(1));
            if place == last {
                by_values = rows.skip(output).take(1).flatten().copied().collect();
                continue;
            }
            let outputs = values[place + 1].iter();
            let slopes = by_values.iter().zip(outputs).map(|(d, t)| d * (1.0 - t * t));
            let mut sums = vec![0.0; layer.num_inputs()];
            for (row, slope) in rows.zip(slopes) {
                for (sum, weight) in sums.iter_mut().zip(row) {
                    *sum += weight * slope;
                }
            }
            by_values = sums;
        }
        by_values
    }
}
