//! Poses in JSON.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// The pose of a position, in metres, and a quaternion w, x, y, z, which is normalised.
pub fn pose(position: [f64; 3], [w, x, y, z]: [f64; 4]) -> Result<Isometry3<f64>, String> {
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
    let turn = turn.ok_or("`quaternion_wxyz` is not a rotation")?;
    Ok(Isometry3::from_parts(Translation3::from(position), turn))
}
