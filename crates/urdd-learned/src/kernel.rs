//! Arithmetic of the network for several configurations at once.
//!
//! Uses only operations with the same result on every instruction set, in a fixed order.

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
