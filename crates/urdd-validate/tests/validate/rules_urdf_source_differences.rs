//! Compares `urdf_module` with the carried URDF, for URD001, URD013 and URD014.

use serde_json::json;
use urdd_validate::rules::urdf::compared::is_nothing;

#[test]
fn zeros_and_nulls_say_nothing() {
    assert!(is_nothing(&json!({"xyz": [0.0, -0.0], "rpy": null, "name": ""})));
    assert!(!is_nothing(&json!({"xyz": [0.0, 1e-9]})));
}
