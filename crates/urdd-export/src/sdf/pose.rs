//! Poses.

use nalgebra::Isometry3;
use urdd_kinematics::rotation::to_rpy;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

/// A pose, as an element.
pub(super) fn placed(pose: &Isometry3<f64>) -> Element {
    let rotation = pose.rotation.to_rotation_matrix();
    let mut values = pose.translation.vector.as_slice().to_vec();
    values.extend(to_rpy(rotation.matrix()));
    Element::text("pose", &numbers(&values))
}
