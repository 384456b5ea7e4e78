//! The rules of `urdf::joints`.

use urdd_validate::rules::urdf::tree::has_direction;

#[test]
fn short_axes_have_a_direction() {
    assert!(has_direction([0.001, 0.002, -0.002]));
    assert!(has_direction([0.0, -1e-9, 0.0]));
    for axis in [[0.0; 3], [-0.0; 3], [1e-200; 3], [1e200, 0.0, 0.0]] {
        assert!(!has_direction(axis), "{axis:?}");
    }
}
