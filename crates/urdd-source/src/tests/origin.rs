//! Origins of a URDF as poses: SPEC 5.4 and 6.1.9.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::origin::*;
use urdd_format::urdf::Origin;

fn rotation(origin: &Origin, version: &str) -> [f64; 4] {
    let pose = of(Some(origin), has_quaternions(Some(version)));
    pose.rotation.coords.into()
}

#[test]
fn quaternions_count_from_version_1_1() {
    let origin = Origin {
        xyz: None,
        rpy: None,
        // A quarter turn about z, with norm 2 sqrt(2) e-200.
        quat_xyzw: Some([0.0, 0.0, 2e-200, 2e-200]),
    };
    for version in ["1.1", "1.2", " 2.0 ", "01.10", "99999999999999999999.0"] {
        let [x, y, z, w] = rotation(&origin, version);
        assert_eq!([x, y], [0.0, 0.0]);
        assert!((z - FRAC_1_SQRT_2).abs() < 1e-15 && (w - FRAC_1_SQRT_2).abs() < 1e-15);
    }
    for version in ["1.0", "0.9", "1", "", "1.1.0", "1.x", "-1.1", "+1.1", "\u{a0}1.1"] {
        assert_eq!(rotation(&origin, version), [0.0, 0.0, 0.0, 1.0], "{version:?}");
    }
    assert!(!has_quaternions(None));
}

#[test]
fn a_quaternion_without_length_says_nothing() {
    let origin = Origin { xyz: None, rpy: None, quat_xyzw: Some([0.0; 4]) };
    assert_eq!(rotation(&origin, "1.1"), [0.0, 0.0, 0.0, 1.0]);
}
