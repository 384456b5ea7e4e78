//! Rotations and rigid transforms as matrices.

use std::f64::consts::PI;

use urdd_format::pose::Pose;

/// A rotation matrix in row-major order.
pub type Rotation = [[f64; 3]; 3];
/// A rigid transform in row-major order.
pub type Transform = [[f64; 4]; 4];

pub const IDENTITY: Transform =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

pub fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The unit vector along v; v itself if it is zero.
pub fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = norm(v);
    if length > 0.0 { v.map(|c| c / length) } else { v }
}

/// Rodrigues' formula.
pub fn rotation_about([x, y, z]: [f64; 3], angle: f64) -> Rotation {
    let (s, c) = angle.sin_cos();
    let t = 1.0 - c;
    [
        [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
        [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
        [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
    ]
}

pub fn rotation_by_vector(v: [f64; 3]) -> Rotation {
    rotation_about(unit(v), norm(v))
}

/// R = Rz(yaw) Ry(pitch) Rx(roll), expanded.
pub fn rotation_of_rpy([roll, pitch, yaw]: [f64; 3]) -> Rotation {
    let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
    [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
}

/// The rotation that takes +z to n by the shortest arc; half a turn about x for n = -z. An n too near to the z axis
/// counts as being on it (5.9).
pub fn shortest_arc_from_z([x, y, z]: [f64; 3]) -> Rotation {
    let sine = x.hypot(y);
    if sine < 1e-10 {
        return rotation_about([1.0, 0.0, 0.0], if z < 0.0 { PI } else { 0.0 });
    }
    let axis = unit([-y, x, 0.0]);
    rotation_about(axis, sine.atan2(z))
}

pub fn transform(r: Rotation, p: [f64; 3]) -> Transform {
    let mut t = IDENTITY;
    for row in 0..3 {
        t[row][..3].copy_from_slice(&r[row]);
        t[row][3] = p[row];
    }
    t
}

pub fn product(a: &Transform, b: &Transform) -> Transform {
    let mut out = [[0.0; 4]; 4];
    for (row, line) in out.iter_mut().enumerate() {
        for (column, element) in line.iter_mut().enumerate() {
            *element = (0..4).map(|k| a[row][k] * b[k][column]).sum();
        }
    }
    out
}

/// Applies the transform to a point.
pub fn apply(t: &Transform, p: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|row| (0..3).map(|k| t[row][k] * p[k]).sum::<f64>() + t[row][3])
}

/// Position and quaternion of a transform, computed from the largest quaternion component for accuracy.
pub fn pose(t: &Transform) -> Pose {
    let [xx, yy, zz] = [t[0][0], t[1][1], t[2][2]];
    let mut q = [1.0 + xx + yy + zz, 1.0 + xx - yy - zz, 1.0 - xx + yy - zz, 1.0 - xx - yy + zz];
    let largest = (0..4).max_by(|a, b| q[*a].total_cmp(&q[*b])).expect("four");
    let [wx, wy, wz] = [t[2][1] - t[1][2], t[0][2] - t[2][0], t[1][0] - t[0][1]];
    let [xy, xz, yz] = [t[1][0] + t[0][1], t[0][2] + t[2][0], t[2][1] + t[1][2]];
    q = match largest {
        0 => [q[0], wx, wy, wz],
        1 => [wx, q[1], xy, xz],
        2 => [wy, xy, q[2], yz],
        _ => [wz, xz, yz, q[3]],
    };
    let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    let first = q.iter().copied().find(|c| *c != 0.0).expect("not zero");
    Pose {
        position: [t[0][3], t[1][3], t[2][3]],
        quaternion_wxyz: q.map(|c| c / length.copysign(first)),
    }
}
