//! Words in names: what a chain is, and on which side.

use urdd_export::setup::guesser::*;

#[test]
fn names_say_parts_and_sides() {
    assert_eq!(words("FL_hipJoint2"), ["fl", "hip", "joint2"]);
    let leg = ["FL_hip_joint", "FL_thigh_joint"];
    assert_eq!(part(leg.into_iter()), Some(Part::Leg));
    assert_eq!(side(leg.into_iter()).as_deref(), Some("fl"));
    assert_eq!(side(["left_a", "right_b"].into_iter()), None);
    assert_eq!(part(["joint_1", "legion"].into_iter()), None);
    assert!(is_tool("panda_hand_tcp") && !is_tool("stool") && !is_tool("multitool"));
    assert!(is_imu("imu_link") && !is_imu("simulated"));
}
