//! A fully connected network, SPEC 8.8.4, its arithmetic for several configurations at once, and why a model cannot be used.
//!
//! Uses only operations with the same result on every instruction set, in a fixed order.

use fearless_simd::{Level, Simd, dispatch};
use thiserror::Error;

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
            dense(&layer.weights, &layer.biases, &before[place], &mut after[0]);
            if place + 1 < self.layers.len() {
                tanh_all(&mut after[0]);
            }
        }
    }

    /// The gradient of an output with respect to the inputs, from the values after each layer.
    pub fn derivative(&self, values: &[Vec<[f64; 1]>], output: usize) -> Vec<f64> {
        let mut by_values = vec![[0.0]; values[self.layers.len()].len()];
        by_values[output] = [1.0];
        for (place, layer) in self.layers.iter().enumerate().rev() {
            let mut by_inputs = vec![[0.0]; values[place].len()];
            dense_back(&layer.weights, &by_values, &mut by_inputs);
            if place > 0 {
                tanh_back(&values[place], &mut by_inputs);
            }
            by_values = by_inputs;
        }
        by_values.into_flattened()
    }
}

/// Configurations per batch.
pub const LANES: usize = 32;

/// One value for each configuration of a batch.
pub type Lanes = [f64; LANES];

/// Coefficients of the series of e^r for |r| <= ln 2 / 2, highest power first. 1/13! is less than 2^-32 and r^14 less
/// than 2^-21, so the truncation error is less than 2^-53.
const SERIES: [f64; 14] = [
    1.0 / 6_227_020_800.0,
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
    1.0,
    1.0,
];

/// ln 2 in two parts; the product of the first part and a small integer is exact.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];

/// Adding this to a number leaves its rounded integer in the low bits.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// The hyperbolic tangent, within 4e-16: 1 - 2 / (e^2x + 1), without a branch.
#[inline(always)]
pub fn tanh(x: f64) -> f64 {
    // For |x| >= 20, tanh is 1 in full precision.
    let y = 2.0 * x.clamp(-20.0, 20.0);
    let shifted = y * std::f64::consts::LOG2_E + TO_INTEGER;
    let k = shifted - TO_INTEGER;
    let r = (y - k * LN_2[0]) - k * LN_2[1];
    let mut power = 0.0;
    for coefficient in SERIES {
        power = power * r + coefficient;
    }
    // The exponent bits of 2^k, for k between -58 and 58.
    let two_to_k = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    1.0 - 2.0 / (power * two_to_k + 1.0)
}

/// The outputs of a layer: `weights` (row-major, one row per output) times `inputs`, plus `biases`.
#[inline(always)]
pub(super) fn dense<const N: usize>(
    weights: &[f64],
    biases: &[f64],
    inputs: &[[f64; N]],
    outputs: &mut [[f64; N]],
) {
    let rows = weights.chunks_exact(inputs.len());
    for ((row, bias), output) in rows.zip(biases).zip(outputs) {
        let mut sums = [*bias; N];
        for (weight, input) in row.iter().zip(inputs) {
            for (sum, x) in sums.iter_mut().zip(input) {
                *sum += weight * x;
            }
        }
        *output = sums;
    }
}

/// The derivatives with respect to the inputs of a layer, from those with respect to its outputs: the transpose of
/// `weights` times `by_outputs`.
#[inline(always)]
pub(super) fn dense_back<const N: usize>(
    weights: &[f64],
    by_outputs: &[[f64; N]],
    by_inputs: &mut [[f64; N]],
) {
    by_inputs.fill([0.0; N]);
    for (row, by_output) in weights.chunks_exact(by_inputs.len()).zip(by_outputs) {
        for (weight, sums) in row.iter().zip(by_inputs.iter_mut()) {
            for (sum, by_output) in sums.iter_mut().zip(by_output) {
                *sum += weight * by_output;
            }
        }
    }
}

/// Replaces values by their hyperbolic tangents.
#[inline(always)]
pub(super) fn tanh_all<const N: usize>(values: &mut [[f64; N]]) {
    for value in values.as_flattened_mut() {
        *value = tanh(*value);
    }
}

/// Turns derivatives with respect to hyperbolic tangents into those with respect to their arguments: times 1 - t^2.
#[inline(always)]
pub(super) fn tanh_back<const N: usize>(tangents: &[[f64; N]], by_values: &mut [[f64; N]]) {
    let each = by_values.as_flattened_mut().iter_mut();
    for (by_value, t) in each.zip(tangents.as_flattened()) {
        *by_value *= 1.0 - t * t;
    }
}
