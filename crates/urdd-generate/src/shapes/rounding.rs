//! Rounds distances to their significant digits.

/// The powers of ten that scale numbers from 10^-6 to 10^6 to seven digits before the point. All are exact.
const SCALES: [f64; 12] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

/// Rounds a distance to seven significant digits (SPEC 8.5 says what that may change). Distances below 10^-6 m, and
/// from 10^6 m on, are unchanged. Rounding is monotonic.
pub fn seven_digits(x: f64) -> f64 {
    let scale = SCALES.iter().find(|scale| (1e6..1e7).contains(&(x * **scale)));
    match scale {
        // An integer divided by a power of ten, both exact: the quotient is the binary64 nearest to the decimal.
        Some(scale) => (x * scale).round() / scale,
        None => x,
    }
}
