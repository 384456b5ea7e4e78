use crate::made::export;
use urdd_export::{Choices, Format};
use urdd_robot::Robot;
use urdd_srdf::merge_srdf;

use testkit::robots::{made_of, our_robots};

#[test]
fn a_name_cannot_leave_its_attribute() {
    let (_folder, path) = made_of(
        "<robot name='\"/&gt;&lt;x--&gt;'>\
         <link name='a\"&lt;&amp;'><visual><geometry><box size='1 1 1'/></geometry></visual></link>\
         <link name=\"b'>\"><visual><geometry><box size='1 1 1'/></geometry></visual></link>\
         <joint name='j' type='fixed'><parent link='a\"&lt;&amp;'/><child link=\"b'>\"/></joint></robot>",
    );
    let robot = Robot::open(path).expect("a robot");
    let made = export(&robot, Format::Srdf, &Choices::default()).expect("an export");
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    let root = document.root_element();
    assert_eq!(root.attribute("name"), Some("\"/><x-->"));
    let pair = root.children().find(urdd_xml::Node::is_element).expect("a pair");
    assert_eq!(pair.attribute("link1"), Some("a\"<&"));
    assert_eq!(pair.attribute("link2"), Some("b'>"));
    // Its own output replaces its own output.
    let again = merge_srdf(&made.text, &made.text).expect("merged");
    assert_eq!(again.text, made.text);
}

#[test]
fn a_robot_without_pairs_is_an_empty_srdf() {
    let single = our_robots().into_iter().find(|(name, _)| name == "single_link");
    let (_folder, path) = testkit::robots::made(&single.expect("single_link").1);
    let robot = Robot::open(path).expect("a robot");
    let made = export(&robot, Format::Srdf, &Choices::default()).expect("an export");
    assert!(!made.text.contains("disable_collisions"));
    assert!(urdd_xml::parse(&made.text, urdd_xml::Kind::Other).is_ok());
}
