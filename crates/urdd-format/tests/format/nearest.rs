//! Suggestions for mistyped names.

use urdd_format::nearest::{closeness, nearest};

#[test]
fn of_names_as_near_the_one_that_keeps_the_telling_part_is_proposed() {
    for (name, names, expected) in [
        ("R_lnk2", ["L_link2", "R_link2"], "R_link2"),
        ("lnk2_R", ["link2_L", "link2_R"], "link2_R"),
        ("arm_link4", ["arm_link3", "arm_lin4"], "arm_lin4"),
        ("left_wrst", ["left_wist", "left_wrist"], "left_wrist"),
        ("Elbow", ["albow", "elbow"], "elbow"),
    ] {
        assert_eq!(nearest(names.into_iter(), name).as_deref(), Some(expected), "{name}");
    }
}

#[test]
fn sides_and_numbers_tell_parts_apart() {
    for (known, name, is_other) in [
        ("R_link2", "r_link2", false),
        ("L_link2", "R_link2", true),
        ("link_1", "link_2", true),
        ("left_hand", "lef_hand", false),
        ("front_left_wheel", "front_right_wheel", true),
    ] {
        assert_eq!(closeness(known, name).is_of_another_part, is_other, "{known} {name}");
    }
}
