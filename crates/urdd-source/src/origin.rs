//! Origins of a URDF as poses: SPEC 5.4 and 6.1.9.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use urdd_format::urdf::Origin;
use urdd_kinematics::rotation::from_rpy;

/// Whether `quat_xyzw` applies in a URDF of this version: from 1.1 on. A missing version, or one that is not two
/// numbers separated by a dot, counts as 1.0.
pub fn has_quaternions(version: Option<&str>) -> bool {
    let number = |text: &str| -> Option<u64> {
        let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        // A number beyond 64 bits is later than any version.
        digits.then(|| text.parse().unwrap_or(u64::MAX))
    };
    let white_space = |c: char| matches!(c, ' ' | '\t' | '\r' | '\n');
    let version = version.and_then(|version| version.trim_matches(white_space).split_once('.'));
    let numbers = version.and_then(|(major, minor)| number(major).zip(number(minor)));
    numbers.is_some_and(|version| version >= (1, 1))
}

/// The pose of an origin; missing parts are zero. `quaternions` says whether `quat_xyzw` applies.
pub fn of(origin: Option<&Origin>, quaternions: bool) -> Isometry3<f64> {
    let xyz = origin.and_then(|origin| origin.xyz).unwrap_or_default();
    let quaternion = origin.and_then(|origin| origin.quat_xyzw).filter(|_| quaternions);
    let rotation = match (quaternion, origin.and_then(|origin| origin.rpy)) {
        (Some(quaternion), _) => from_xyzw(quaternion).unwrap_or_else(UnitQuaternion::identity),
        (None, Some(rpy)) => from_rpy(rpy),
        (None, None) => UnitQuaternion::identity(),
    };
    Isometry3::from_parts(Translation3::from(xyz), rotation)
}

/// The rotation of a quaternion of any nonzero length.
pub(super) fn from_xyzw(xyzw: [f64; 4]) -> Option<UnitQuaternion<f64>> {
    // Scale first: the squares of huge or tiny components overflow or vanish.
    let largest = xyzw.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let [x, y, z, w] = xyzw.map(|x| x / largest);
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0)
}
