//! Numbers as the shortest text that denotes the same binary64, and rotations as roll, pitch, yaw.

use nalgebra::Matrix3;

/// Half the thickness of a flat box for programs that reject flat boxes, in metres.
pub(super) const HALF_THICKNESS: f64 = 1e-6;

/// A number.
pub(super) fn number(value: f64) -> String {
    // Turns -0 into 0.
    let text = format!("{:?}", value + 0.0);
    match text.strip_suffix(".0") {
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

/// Numbers separated by spaces.
pub(super) fn numbers(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
    values.join(" ")
}

/// Fixed-axis roll, pitch, yaw of a rotation, in rad: accurate to rounding, even with pitch near ±π/2.
pub(super) fn rpy(rotation: &Matrix3<f64>) -> [f64; 3] {
    let r = |row: usize, column: usize| rotation[(row, column)];
    let pitch = (-r(2, 0)).atan2(r(0, 0).hypot(r(1, 0)));
    let yaw = r(1, 0).atan2(r(0, 0));
    // Computes roll from the rotation without yaw: with pitch near ±π/2, only their combination is determined.
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r(0, 2) - cos * r(1, 2)).atan2(cos * r(1, 1) - sin * r(0, 1));
    [roll, pitch, yaw]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_mean_the_same() {
        assert_eq!(numbers(&[1.0, -0.0, 0.1, 1e-9, 1e300]), "1 0 0.1 1e-9 1e300");
        for value in [std::f64::consts::PI, 1.0 / 3.0, 5e-324, -1e22] {
            assert_eq!(number(value).parse::<f64>(), Ok(value));
        }
    }

    #[test]
    fn roll_pitch_yaw_are_the_rotation() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let near = [0.0, 1e-16, 1e-12, 1e-9, 1e-8, 3e-8, 1e-6, 0.3];
        for pitch in near.iter().flat_map(|x| [quarter - x, x - quarter, *x]) {
            for (roll, yaw) in [(0.0, 0.0), (0.4, -2.9), (-3.1, 1.2), (quarter, -quarter)] {
                let rotation = urdd_document::pose::rotation_of_rpy([roll, pitch, yaw]);
                let again = urdd_document::pose::rotation_of_rpy(rpy(&rotation));
                let apart = (again - rotation).abs().max();
                assert!(apart < 1e-14, "{roll} {pitch} {yaw}: {apart}");
            }
        }
    }
}
