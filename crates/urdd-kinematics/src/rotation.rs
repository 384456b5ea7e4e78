//! Rotations: canonical quaternions, rotation vectors, fixed-axis angles, axes, and distances between rotations.

use std::f64::consts::{SQRT_2, TAU};

use nalgebra::{Matrix3, Quaternion, Unit, UnitQuaternion, Vector3};

/// Distance from the z axis below which the arc from z to a planar joint's axis has no direction, given the precision
/// of numbers in URDFs.
const PLANAR_AXIS_EPSILON: f64 = 1e-10;

/// The vector scaled to length 1, without negative zeros; `None` if it has no direction (zero or not finite).
pub fn unit_axis(axis: [f64; 3]) -> Option<Unit<Vector3<f64>>> {
    let v = Vector3::from(axis);
    // Scale the components to about 1 first, because the squares of huge or tiny ones overflow or underflow. A vector
    // without direction becomes NaN, which is not longer than 0.
    let unit = Unit::try_new(v / v.amax(), 0.0)?;
    Some(Unit::new_unchecked(unit.map(|x| x + 0.0)))
}

/// The rotation by the shortest arc that takes z to an axis, of any length but 0; half a turn about x where that is -z.
pub fn from_z(axis: &Vector3<f64>) -> UnitQuaternion<f64> {
    let half = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    UnitQuaternion::rotation_between(&Vector3::z(), axis).unwrap_or_else(half)
}

/// The rotation of fixed-axis roll, pitch, yaw, as in URDF: `Rz(yaw) * Ry(pitch) * Rx(roll)`.
pub fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(roll, pitch, yaw)
}

/// Fixed-axis roll, pitch, yaw of a rotation, in rad, without negative zeros: accurate to rounding, even with a pitch near
/// ±π/2.
pub fn to_rpy(rotation: &Matrix3<f64>) -> [f64; 3] {
    let r = |row: usize, column: usize| rotation[(row, column)];
    let pitch = (-r(2, 0)).atan2(r(0, 0).hypot(r(1, 0)));
    let yaw = r(1, 0).atan2(r(0, 0));
    // Of the rotation without yaw: with a pitch near ±π/2, only roll and yaw together are determined.
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r(0, 2) - cos * r(1, 2)).atan2(cos * r(1, 1) - sin * r(0, 1));
    [roll, pitch, yaw].map(|angle| angle + 0.0)
}

/// The canonical one of a rotation's two quaternions: its first non-zero component, in the order w, x, y, z, is
/// positive. So `w >= 0`. No component is negative zero.
pub fn canonical(rotation: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let q = rotation.quaternion();
    let wxyz = [q.w, q.i, q.j, q.k];
    let negative = wxyz.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0);
    let [w, x, y, z] = wxyz.map(|x| if negative { -x } else { x } + 0.0);
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}

/// The rotation by `|v|` radians about `v`. Keeps full precision for tiny rotations, unlike nalgebra's function.
pub fn from_rotation_vector(v: [f64; 3]) -> UnitQuaternion<f64> {
    let v = Vector3::from(v);
    let angle = v.norm();
    let half = 0.5 * angle;
    // sin(a/2)/a is 1/2 - a^2/48 + ...: below 1e-8 that is 1/2 in full precision.
    let factor = if angle < 1e-8 { 0.5 } else { half.sin() / angle };
    UnitQuaternion::new_unchecked(Quaternion::from_parts(half.cos(), v * factor))
}

/// The rotation vector of a rotation: its axis times its angle, which is in [0, pi]. For a half turn, the canonical
/// quaternion selects one of the two vectors.
pub fn to_rotation_vector(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let q = canonical(rotation);
    let v = q.imag();
    let sine = v.norm();
    // Not arccos(w), which loses half of the digits near w = 1. Near 0, atan(t)/t is 1.
    let factor = if sine < 1e-8 { 2.0 / q.w } else { 2.0 * sine.atan2(q.w) / sine };
    (v * factor).map(|x| x + 0.0).into()
}

/// The rotation for three numbers in [0, 1]; uniformly distributed if they are (Shoemake, 1992). It is the
/// [`canonical`] quaternion of `w = sqrt(u1) cos(2 pi u3)`, `x = sqrt(1 - u1) sin(2 pi u2)`,
/// `y = sqrt(1 - u1) cos(2 pi u2)`, `z = sqrt(u1) sin(2 pi u3)`.
pub fn uniform_rotation([u1, u2, u3]: [f64; 3]) -> UnitQuaternion<f64> {
    let (zw, xy) = (u1.sqrt(), (1.0 - u1).sqrt());
    let ((sin2, cos2), (sin3, cos3)) = ((TAU * u2).sin_cos(), (TAU * u3).sin_cos());
    let quaternion = Quaternion::new(zw * cos3, xy * sin2, xy * cos2, zw * sin3);
    canonical(&UnitQuaternion::new_unchecked(quaternion))
}

/// The directions of a planar joint's first two DOFs: x and y, rotated by the shortest arc from z to the axis. If the
/// axis is -z, by a half turn about x.
pub fn planar_basis(axis: &Unit<Vector3<f64>>) -> [Vector3<f64>; 2] {
    let radius = axis.x.hypot(axis.y);
    if radius < PLANAR_AXIS_EPSILON {
        return [Vector3::x(), Vector3::y() * axis.z.signum()];
    }
    // Rodrigues' formula about (-ny, nx, 0). It uses 1 - az instead of 1 + az in a denominator, so it is accurate near
    // -z too.
    let (nx, ny) = (axis.x / radius, axis.y / radius);
    let versine = 1.0 - axis.z;
    let mixed = -versine * nx * ny;
    [
        Vector3::new(1.0 - versine * nx * nx, mixed, -axis.x),
        Vector3::new(mixed, 1.0 - versine * ny * ny, -axis.y),
    ]
}

/// The distance between two rotations: the Frobenius norm of the difference of their matrices, divided by `sqrt(2)`.
/// For rotations that differ by the angle `a` it equals `2 sin(a/2)`: about `a` for small angles, 2 for a half turn.
pub fn rotation_distance(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>) -> f64 {
    let difference = a.to_rotation_matrix().into_inner() - b.to_rotation_matrix().into_inner();
    difference.norm() / SQRT_2
}
