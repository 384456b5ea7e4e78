//! Numbers of half precision.

/// The number that 16 bits are.
pub fn from_bits(bits: u16) -> f64 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
    sign * match exponent {
        0 => fraction * 2f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction / 1024.0) * 2f64.powi(exponent - 15),
    }
}

/// The nearest number of half precision; of two, the even one. Of single precision before, as USD has it.
pub fn rounded(value: f64) -> f64 {
    let value = f64::from(value as f32);
    if !value.is_finite() || value == 0.0 {
        return value;
    }
    let exponent = (value.abs().log2().floor() as i32).max(-14);
    let unit = 2f64.powi(exponent - 10);
    let near = (value / unit).round_ties_even() * unit;
    if near.abs() > 65504.0 { f64::INFINITY.copysign(value) } else { near }
}
