//! Values of a pose, as the URDF writes it.

use crate::fields::Fields;
use urdd_format::urdf::Origin;

/// Adds the values of an origin; what is absent is 0. A quaternion counts where the URDF's version has any, and then
/// in place of `rpy`.
pub(super) fn add(prefix: &str, origin: Option<&Origin>, quaternions: bool, fields: &mut Fields) {
    let xyz = origin.and_then(|origin| origin.xyz).unwrap_or_default();
    fields.numbers(format!("{prefix}xyz"), "m", Some(xyz));
    let quaternion = origin.and_then(|origin| origin.quat_xyzw);
    match quaternion.filter(|_| quaternions) {
        Some(quaternion) => fields.numbers(format!("{prefix}quat_xyzw"), "", Some(quaternion)),
        None => {
            let rpy = origin.and_then(|origin| origin.rpy).unwrap_or_default();
            fields.numbers(format!("{prefix}rpy"), "rad", Some(rpy));
        }
    }
}
