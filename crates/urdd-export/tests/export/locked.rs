//! Joints that their limits hold at one position.

use crate::made::export;
use urdd_export::{ActuatorKind, Choices, Format};

use crate::made::{robot, urdf};

const PARTS: &str = "<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/><link name=\"d\"/>\
<joint name=\"held\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/>\
<limit lower=\"0.25\" upper=\"0.25\" effort=\"0\" velocity=\"0\"/></joint>\
<joint name=\"free\" type=\"prismatic\"><parent link=\"b\"/><child link=\"c\"/><axis xyz=\"0 0 1\"/>\
<limit lower=\"0\" upper=\"0.5\" effort=\"1\" velocity=\"1\"/></joint>\
<joint name=\"follows\" type=\"revolute\"><parent link=\"c\"/><child link=\"d\"/><axis xyz=\"0 0 1\"/>\
<limit lower=\"0\" upper=\"0\" effort=\"1\" velocity=\"1\"/><mimic joint=\"free\"/></joint>";

#[test]
fn a_locked_joint_stays_locked_in_mjcf() {
    let (_folder, robot) = robot(&urdf(PARTS));
    let actuators = Some(ActuatorKind::Position);
    let options = Choices { actuators, ..Choices::default() };
    let made = export(&robot, Format::Mjcf, &options).expect("an export");
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("XML");
    let equalities: Vec<_> = document
        .descendants()
        .filter(|node| node.has_tag_name("joint") && node.has_attribute("joint1"))
        .map(|node| ["joint1", "joint2", "polycoef"].map(|key| node.attribute(key)))
        .collect();
    let expected = [
        [Some("held"), None, Some("0.25 0 0 0 0")],
        [Some("follows"), Some("free"), Some("0 1 0 0 0")],
    ];
    assert_eq!(equalities, expected);
    // Nothing pulls at it, and there is a state in which it is where it is held.
    let actuated: Vec<_> = document
        .descendants()
        .filter(|node| node.has_tag_name("position"))
        .filter_map(|node| node.attribute("joint"))
        .collect();
    assert_eq!(actuated, ["free"]);
    let key = document.descendants().find(|node| node.has_tag_name("key")).expect("a keyframe");
    assert_eq!((key.attribute("qpos"), key.attribute("ctrl")), (Some("0.25 0 0"), Some("0")));
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(
        notes.iter().any(|note| note.starts_with("joint `held`: its limits are equal")),
        "{notes:?}"
    );
}
