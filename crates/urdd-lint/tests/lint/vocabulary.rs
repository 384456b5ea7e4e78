//! The elements and attributes of URDF (SPEC 6.1.8), and those that some programs read beside them.

use urdd_lint::vocabulary::*;

#[test]
fn a_misspelling_has_one_meaning() {
    let joint = of("joint").expect("it").children;
    let controller = of("safety_controller").expect("it").attributes;
    assert_eq!(nearest("limits", joint), Some("limit"));
    assert_eq!(nearest("Axsi", joint), Some("axis"));
    assert_eq!(nearest("mimc", joint), Some("mimic"));
    assert_eq!(nearest("sensor", joint), None);
    assert_eq!(nearest("soft_lower", controller), Some("soft_lower_limit"));
    assert_eq!(nearest("soft_", controller), None, "the beginning of two");
    assert_eq!(nearest("k_positon", controller), Some("k_position"));
    assert_eq!(nearest("xy", of("axis").expect("it").attributes), None);
    let inertia = of("inertia").expect("it").attributes;
    assert_eq!(near("iaz", inertia), Some(("ixz", false)), "or iyz, izz");
    assert_eq!(near("ixxx", inertia), Some(("ixx", true)));
}

#[test]
fn a_value_fits_its_attribute() {
    assert!(fits("upper", "-1.5") && fits("xyz", " 0 0\t1 ") && fits("name", "a b"));
    assert!(!fits("upper", "abc") && !fits("upper", "1 2") && !fits("upper", "inf"));
    assert!(!fits("rgba", "1 0 0") && !fits("filename", ""));
}
