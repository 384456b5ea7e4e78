//! The canonical form of numbers, for JSON and YAML.

use std::fmt::{self, Write};

use serde_json::Number;

/// Smaller magnitudes have an exponent. The same bound as Python's `repr`.
const SMALLEST_WITHOUT_EXPONENT: f64 = 1e-4;
/// Magnitudes from here on have an exponent. The same bound as Python's `repr`.
const LARGEST_WITHOUT_EXPONENT: f64 = 1e16;

/// Writes a number so that JSON, YAML 1.1 and YAML 1.2 read the same value.
///
/// Integers are decimal digits. A float is the shortest decimal that reads back as the same 64-bit float. Zero, of
/// either sign, is `0.0`. A magnitude of at least 10^-4 and below 10^16 has no exponent and at least one digit on each
/// side of the point (`0.0001`, `3.0`). Any other has one digit before the point, at least one after it, `e`, a sign,
/// and the exponent without leading zeros (`1.0e-5`, `1.25e+22`).
pub fn write(number: &Number, out: &mut impl Write) -> fmt::Result {
    match number.as_f64() {
        Some(x) if number.is_f64() => write_float(x, out),
        _ => write!(out, "{number}"),
    }
}

/// Writes a float like [`write()`]. The caller ensures that it is finite.
pub fn write_float(x: f64, out: &mut impl Write) -> fmt::Result {
    let magnitude = x.abs();
    if magnitude == 0.0 {
        return out.write_str("0.0");
    }
    if (SMALLEST_WITHOUT_EXPONENT..LARGEST_WITHOUT_EXPONENT).contains(&magnitude) {
        // serde_json prints floats several times faster than the standard library.
        let mut buffer = [0_u8; 40];
        let mut free = &mut buffer[..];
        let written = serde_json::to_writer(&mut free, &x).is_ok();
        let length = 40 - free.len();
        return match std::str::from_utf8(&buffer[..length]) {
            Ok(text) if written && text.contains('.') && !text.contains('e') => out.write_str(text),
            _ => write!(out, "{x:?}"),
        };
    }
    let text = format!("{x:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let point = if mantissa.contains('.') { "" } else { ".0" };
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    write!(out, "{mantissa}{point}e{sign}{exponent}")
}
