//! Numbers as the shortest text that denotes the same binary64, and rotations as roll, pitch, yaw.

use nalgebra::Matrix3;

/// Half the thickness of a flat box for programs that reject flat boxes, in metres.
pub(super) const HALF_THICKNESS: f64 = 1e-6;

/// A number.
pub fn number(value: f64) -> String {
    // Turns -0 into 0.
    let text = format!("{:?}", value + 0.0);
    match text.strip_suffix(".0") {
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

/// Numbers separated by spaces.
pub fn numbers(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
    values.join(" ")
}

/// Fixed-axis roll, pitch, yaw of a rotation, in rad: accurate to rounding, even with pitch near ±π/2.
pub fn rpy(rotation: &Matrix3<f64>) -> [f64; 3] {
    let r = |row: usize, column: usize| rotation[(row, column)];
    let pitch = (-r(2, 0)).atan2(r(0, 0).hypot(r(1, 0)));
    let yaw = r(1, 0).atan2(r(0, 0));
    // Computes roll from the rotation without yaw: with pitch near ±π/2, only their combination is determined.
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r(0, 2) - cos * r(1, 2)).atan2(cos * r(1, 1) - sin * r(0, 1));
    [roll, pitch, yaw]
}
