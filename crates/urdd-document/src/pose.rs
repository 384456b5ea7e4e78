//! Rotations and axes by SPEC 5.4 and 5.7, to compare modules with the robot.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// The rotation of a URDF's `rpy`: fixed-axis roll, pitch, yaw, R = Rz(yaw) Ry(pitch) Rx(roll).
pub fn rotation_of_rpy([roll, pitch, yaw]: [f64; 3]) -> Matrix3<f64> {
    Rotation3::from_euler_angles(roll, pitch, yaw).into_inner()
}

/// The rotation of a quaternion w, x, y, z of any nonzero norm.
pub fn rotation_of_quaternion([w, x, y, z]: [f64; 4]) -> Matrix3<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner()
}

/// Normalises a quaternion. `None` if it is zero or not finite.
pub fn unit_quaternion(q: [f64; 4]) -> Option<[f64; 4]> {
    let largest = q.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let finite = q.iter().all(|x| x.is_finite());
    (largest > 0.0 && finite).then(|| {
        // Scale first, as in `unit`.
        let q = q.map(|x| x / largest);
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        q.map(|x| x / length)
    })
}

/// Whether a URDF of this version uses `quat_xyzw`: from 1.1 on (SPEC 6.1.9). A version that is missing, or is not two
/// numbers of digits with a dot between them, counts as 1.0.
pub fn has_quaternions(version: Option<&str>) -> bool {
    const WHITE_SPACE: [char; 4] = [' ', '\t', '\r', '\n'];
    let text = version.unwrap_or_default().trim_matches(WHITE_SPACE);
    let Some((major, minor)) = text.split_once('.') else {
        return false;
    };
    let all_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if !all_digits(major) || !all_digits(minor) {
        return false;
    }
    // Numbers of any size: ignore leading zeros.
    match major.trim_start_matches('0') {
        "" => false,
        "1" => !minor.trim_start_matches('0').is_empty(),
        _ => true,
    }
}

/// The unit vector in the direction of `axis`; `None` for the zero vector.
pub fn unit(axis: [f64; 3]) -> Option<Vector3<f64>> {
    let largest = axis.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    // Scale first, so that squares of tiny or huge components neither underflow nor overflow.
    (largest > 0.0).then(|| (Vector3::from(axis) / largest).normalize())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn close(a: &Vector3<f64>, b: [f64; 3]) -> bool {
        (a - Vector3::from(b)).norm() < 1e-15
    }

    #[test]
    fn roll_is_turned_first_and_about_fixed_axes() {
        let r = rotation_of_rpy([FRAC_PI_2, 0.0, FRAC_PI_2]);
        // Roll takes z to -y, and yaw takes -y to x.
        assert!(close(&(r * Vector3::z()), [1.0, 0.0, 0.0]));
        assert!(close(&(r * Vector3::x()), [0.0, 1.0, 0.0]));
        let r = rotation_of_rpy([0.0, FRAC_PI_2, FRAC_PI_2]);
        // Pitch takes x to -z, which yaw keeps. Pitch takes z to x, which yaw takes to y.
        assert!(close(&(r * Vector3::x()), [0.0, 0.0, -1.0]));
        assert!(close(&(r * Vector3::z()), [0.0, 1.0, 0.0]));
    }

    #[test]
    fn versions_are_numbers() {
        for version in [
            "1.1",
            "1.2",
            " 1.1\n",
            "1.10",
            "2.0",
            "01.01",
            "1.1000000000000000000001",
            "1000000000000000000000000.0",
        ] {
            assert!(has_quaternions(Some(version)), "{version}");
        }
        for version in [
            "1.0",
            "1",
            "1.1.0",
            "",
            "0.9",
            "one.one",
            "-1.1",
            "+1.1",
            "1.+1",
            "1.",
            ".1",
            "00.9",
            "1. 1",
            "\u{a0}1.1",
            "0.1000000000000000000001",
        ] {
            assert!(!has_quaternions(Some(version)), "{version}");
        }
        assert!(!has_quaternions(None));
    }

    #[test]
    fn a_quaternion_turns_as_its_rpy_does() {
        let half = (0.5_f64).sqrt();
        let turned = rotation_of_quaternion([half, 0.0, 0.0, half]) * Vector3::x();
        assert!(close(&turned, [0.0, 1.0, 0.0]));
        let same = rotation_of_quaternion([2.0 * half, 0.0, 0.0, 2.0 * half]) * Vector3::x();
        assert!(close(&same, [0.0, 1.0, 0.0]));
    }

    #[test]
    fn quaternions_of_any_length_are_one_rotation() {
        let half = (0.5_f64).sqrt();
        for length in [2e-200, 1.0, 3e200] {
            let unit = unit_quaternion([length, 0.0, 0.0, -length]).expect("a length");
            let expected = [half, 0.0, 0.0, -half];
            assert!(unit.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
        }
        assert_eq!(unit_quaternion([0.0; 4]), None);
        assert_eq!(unit_quaternion([f64::INFINITY, 0.0, 0.0, 1.0]), None);
    }

    #[test]
    fn axes_of_any_size_have_a_direction_but_zero_has_none() {
        assert!(close(&unit([0.0, 3e-300, 4e-300]).unwrap(), [0.0, 0.6, 0.8]));
        assert!(close(&unit([0.0, 3e300, -4e300]).unwrap(), [0.0, 0.6, -0.8]));
        assert_eq!(unit([0.0, -0.0, 0.0]), None);
    }
}
