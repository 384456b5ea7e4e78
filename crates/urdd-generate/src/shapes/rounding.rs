//! Rounds distances to their significant digits.

/// The powers of ten that scale numbers from 10^-6 to 10^6 to seven digits before the point. All are exact.
const SCALES: [f64; 12] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

/// Rounds a distance to seven significant digits (SPEC 8.5 says what that may change). Distances below 10^-6 m, and
/// from 10^6 m on, are unchanged. Rounding is monotonic.
pub(super) fn seven_digits(x: f64) -> f64 {
    let scale = SCALES.iter().find(|scale| (1e6..1e7).contains(&(x * **scale)));
    match scale {
        // An integer divided by a power of ten, both exact: the quotient is the binary64 nearest to the decimal.
        Some(scale) => (x * scale).round() / scale,
        None => x,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_nearest_to_the_decimal_of_seven_digits() {
        // Rust's own formatting, which rounds exactly.
        let mut x = 1.000_000_4e-6;
        while x < 1e6 {
            let text = format!("{x:.6e}");
            assert_eq!(seven_digits(x), text.parse::<f64>().unwrap(), "{x}");
            x *= 1.000_37;
        }
        assert_eq!(seven_digits(0.0), 0.0);
        assert_eq!(seven_digits(9.999_999_7), 10.0);
        assert_eq!(seven_digits(123.456_784_9), 123.4568);
        for unchanged in [1.234_567_891e-7, 1_234_567.891, 0.125] {
            assert_eq!(seven_digits(unchanged), unchanged);
        }
    }

    #[test]
    fn order_is_kept() {
        let mut before = 0.0;
        for step in 0..200_000_i32 {
            let x = 0.999_99 + f64::from(step) * 1e-10;
            assert!(seven_digits(x) >= before);
            before = seven_digits(x);
        }
    }
}
