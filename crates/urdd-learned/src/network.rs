//! A fully connected network, SPEC 8.8.4, and why a model cannot be used.

use fearless_simd::{Level, Simd, dispatch};
use thiserror::Error;

use super::kernel;
use urdd_format::self_collision_model::ModelLayer;

/// Why a model cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{pointer}: {fault}")]
pub struct ModelError {
    /// JSON Pointer to the value.
    pub pointer: String,
    /// What is wrong with it.
    pub fault: String,
}

impl ModelError {
    pub(super) fn new(pointer: impl Into<String>, fault: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), fault: fault.into() }
    }

    /// A number is not one that the model can have.
    pub(super) fn number(pointer: impl Into<String>) -> Self {
        Self::new(pointer, "a number is not finite, or not positive where it must be")
    }

    /// A list is empty, but the network needs at least one `item`.
    pub(super) fn empty(pointer: impl Into<String>, item: &str) -> Self {
        Self::new(pointer, format!("empty; the network needs at least one {item}"))
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Row-major, one row per output.
    pub weights: Vec<f64>,
    /// One per output.
    pub biases: Vec<f64>,
}

impl Layer {
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

    /// Number of weights and biases.
    pub fn num_parameters(&self) -> usize {
        self.layers.iter().map(|layer| layer.weights.len() + layer.biases.len()).sum()
    }

    /// Buffers for [`Network::values`]: of the inputs, then of the outputs of each layer.
    pub fn buffers<const N: usize>(&self) -> Vec<Vec<[f64; N]>> {
        let first = self.layers.first().map_or(0, Layer::num_inputs);
        let widths = self.layers.iter().map(|layer| layer.biases.len());
        std::iter::once(first).chain(widths).map(|width| vec![[0.0; N]; width]).collect()
    }

    /// Computes the values after each layer for `N` configurations; those of one do not depend on `N`. Index 0 contains the
    /// inputs.
    pub fn values<const N: usize>(&self, level: Level, values: &mut [Vec<[f64; N]>]) {
        dispatch!(level, simd => self.values_with(simd, values));
    }

    #[inline(always)]
    fn values_with<S: Simd, const N: usize>(&self, _: S, values: &mut [Vec<[f64; N]>]) {
        for (place, layer) in self.layers.iter().enumerate() {
            let (before, after) = values.split_at_mut(place + 1);
            kernel::dense(&layer.weights, &layer.biases, &before[place], &mut after[0]);
            if place + 1 < self.layers.len() {
                kernel::tanh_all(&mut after[0]);
            }
        }
    }

    /// The gradient of an output with respect to the inputs, from the values after each layer.
    pub fn derivative(&self, values: &[Vec<[f64; 1]>], output: usize) -> Vec<f64> {
        let mut by_values = vec![[0.0]; values[self.layers.len()].len()];
        by_values[output] = [1.0];
        for (place, layer) in self.layers.iter().enumerate().rev() {
            let mut by_inputs = vec![[0.0]; values[place].len()];
            kernel::dense_back(&layer.weights, &by_values, &mut by_inputs);
            if place > 0 {
                kernel::tanh_back(&values[place], &mut by_inputs);
            }
            by_values = by_inputs;
        }
        by_values.into_flattened()
    }
}
