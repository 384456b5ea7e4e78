//! Poses as homogeneous 4 x 4 matrices, in row-major order.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::pose::UNIT_TOLERANCE;

/// Writes a pose as the 16 numbers of its matrix.
pub fn write_matrix(pose: &Isometry3<f64>, out: &mut [f64]) {
    let rotation = pose.rotation.to_rotation_matrix();
    let (r, t) = (rotation.matrix(), &pose.translation.vector);
    let rows = [
        [r.m11, r.m12, r.m13, t.x],
        [r.m21, r.m22, r.m23, t.y],
        [r.m31, r.m32, r.m33, t.z],
        [0.0, 0.0, 0.0, 1.0],
    ];
    out[..16].copy_from_slice(rows.as_flattened());
}

/// The pose of a matrix of a rotation and a translation, without a check that it is.
pub fn unchecked_pose(matrix: &[f64]) -> Isometry3<f64> {
    let rotation = Matrix3::from_fn(|row, column| matrix[4 * row + column]);
    let rotation = Rotation3::from_matrix_unchecked(rotation);
    Isometry3::from_parts(
        Translation3::new(matrix[3], matrix[7], matrix[11]),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}

/// The pose of a matrix; `None` if it is not one of a rotation and a translation, within [`UNIT_TOLERANCE`].
pub fn pose(matrix: &[f64]) -> Option<Isometry3<f64>> {
    let rotation = Matrix3::from_fn(|row, column| matrix[4 * row + column]);
    let near = |a: f64, b: f64| (a - b).abs() <= UNIT_TOLERANCE;
    let product = rotation.tr_mul(&rotation);
    let orthonormal = product.iter().zip(&Matrix3::identity()).all(|(a, b)| near(*a, *b));
    let last = matrix[12..16].iter().zip([0.0, 0.0, 0.0, 1.0]);
    let finite = matrix.iter().all(|value| value.is_finite());
    let is_pose = finite
        && orthonormal
        && rotation.determinant() > 0.0
        && last.into_iter().all(|(a, b)| near(*a, b));
    is_pose.then(|| unchecked_pose(matrix))
}
