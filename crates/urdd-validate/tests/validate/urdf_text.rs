//! The small reader of the carried URDF: what is absent stays absent, and each fault has its place.

use urdd_directory::position::LineIndex;
use urdd_format::urdf::{Geometry, JointType};
use urdd_validate::urdf_text::{Fault, Reading, as_legacy, read};

fn robot(inside: &str) -> Reading {
    read(&format!("<robot name=\"r\">{inside}</robot>"))
}

fn faults(inside: &str) -> Vec<String> {
    robot(inside).problems.iter().map(|problem| problem.fault.to_string()).collect()
}

const ENDS: &str = "<parent link='a'/><child link='b'/>";

#[test]
fn what_is_absent_stays_absent() {
    let reading = robot(&format!(
        "<link name='a'/><link name='b'><inertial><mass/><inertia ixx='1'/></inertial><visual/></link>\
         <joint name='j' type='revolute'>{ENDS}<limit upper='+.5'/><axis/></joint>"
    ));
    assert_eq!(reading.problems, []);
    let robot = reading.robot.unwrap();
    assert!(robot.links[0].inertial.is_none());
    let inertial = robot.links[1].inertial.as_ref().unwrap();
    assert!(inertial.mass.is_none() && inertial.origin.is_none());
    let inertia = inertial.inertia.as_ref().unwrap();
    assert_eq!((inertia.ixx, inertia.iyy), (Some(1.0), None));
    assert!(robot.links[1].visual[0].geometry.is_none());
    let joint = &robot.joints[0];
    assert_eq!(joint.joint_type, JointType::Revolute);
    let limit = joint.limit.as_ref().unwrap();
    assert_eq!((limit.lower, limit.upper), (None, Some(0.5)));
    assert_eq!(joint.axis.as_ref().unwrap().xyz, None);
}

#[test]
fn what_is_not_finite_is_absent() {
    let reading = robot(&format!(
        "<link name='a'/><joint name='j' type='prismatic'>{ENDS}<origin xyz='0 nan 0'/>\
         <limit lower='-inf' upper='1e999' effort='1'/></joint>"
    ));
    assert_eq!(reading.problems, []);
    let robot = reading.robot.unwrap();
    let limit = robot.joints[0].limit.as_ref().unwrap();
    assert_eq!((limit.lower, limit.upper, limit.effort), (None, None, Some(1.0)));
    assert_eq!(robot.joints[0].origin.as_ref().unwrap().xyz, None);
    assert_eq!(
        faults(
            "<link name='a'><visual><geometry><sphere radius='inf'/></geometry></visual></link>"
        ),
        ["`radius` of `<sphere>` is not finite; write a number of at most 1.7e308"]
    );
}

#[test]
fn the_first_of_a_repeated_element_counts() {
    let reading = robot(
        "<link name='a'><visual><geometry><plane/><box size='1 2 3'/><sphere radius='1'/></geometry>\
         <origin xyz='1 0 0'/><origin xyz='2 0 0'/></visual></link>",
    );
    assert_eq!(reading.problems, []);
    let repeated: Vec<(&str, &str)> = reading
        .repeated
        .iter()
        .map(|again| (again.element.as_str(), again.parent.as_str()))
        .collect();
    assert_eq!(repeated, [("origin", "visual"), ("sphere", "geometry")]);
    let visual = &reading.robot.as_ref().unwrap().links[0].visual[0];
    assert_eq!(visual.origin.as_ref().unwrap().xyz, Some([1.0, 0.0, 0.0]));
    assert!(
        matches!(&visual.geometry, Some(Geometry::Box(cuboid)) if cuboid.size == [1.0, 2.0, 3.0])
    );
}

#[test]
fn unknown_elements_are_kept_as_they_stand() {
    let text = "<robot xmlns='http://u' xmlns:xacro=\"http://x\" name='r' >\n\
        <gazebo reference=\"a>b\" ><x>&lt;</x> <!-- > --></gazebo ><xacro:link name='n'/>\
        <link name='a'><contact>\r\n </contact></link><joint name='j' type='fixed'>\
        <parent link='a'/><child link='b'/><origin/><joint_properties  d='1' /></joint></robot>";
    let reading = read(text);
    assert_eq!(reading.problems, []);
    let robot = reading.robot.as_ref().unwrap();
    assert_eq!(
        robot.unknown_elements,
        ["<gazebo reference=\"a>b\" ><x>&lt;</x> <!-- > --></gazebo >", "<xacro:link name='n'/>"]
    );
    assert_eq!(robot.links[0].unknown_elements, ["<contact>\r\n </contact>"]);
    assert_eq!(robot.joints[0].unknown_elements, ["<joint_properties  d='1' />"]);
    assert_eq!(reading.offset("/unknown_elements/1"), text.find("<xacro:link"));
}

#[test]
fn every_value_has_its_place() {
    let text = "<robot name='é'>\n <link name='a'/>\n <joint name='j'\n  type='fixed'>\n  \
        <origin\n   rpy='0 0 1'/><parent link='a'/><child link='b'/></joint></robot>";
    let reading = read(text);
    let lines = LineIndex::new(text);
    let at = |pointer: &str| {
        let place = reading.position(&lines, pointer).unwrap();
        (place.line, place.column)
    };
    assert_eq!(at("/name"), (1, 8));
    assert_eq!(at("/links/0/name"), (2, 8));
    assert_eq!(at("/joints/0/joint_type"), (4, 3));
    assert_eq!(at("/joints/0/origin/rpy/2"), (6, 4));
    // A missing value has the place of its parent.
    assert_eq!(at("/joints/0/origin/xyz"), (5, 3));
    assert_eq!(at("/joints/0/limit/lower"), (3, 2));
    assert_eq!(at("/materials"), (1, 1));
}

#[test]
fn says_what_cannot_be_read() {
    assert_eq!(
        faults(
            "<link/><joint name='j' type='hinge'><parent/></joint><link name='a'><visual><geometry>\
             <mesh/></geometry></visual><collision><geometry><cylinder radius='1'/></geometry>\
             <origin xyz='0 x 0 1'/></collision></link>"
        ),
        [
            "`<link>` does not have the attribute `name`; add it",
            "`<joint>` does not have a `<child>`; add it",
            "`<joint>` has a type that URDF does not define; write revolute, continuous, prismatic, fixed, floating, planar or spherical",
            "`<parent>` does not have the attribute `link`; add it",
            "`<mesh>` does not have the attribute `filename`; add it",
            "`<cylinder>` does not have the attribute `length`; add it",
            "`xyz` of `<origin>` is not 3 numbers; write 3 numbers with spaces between them, without commas",
        ]
    );
    assert_eq!(read("<urdf/>").problems[0].fault, Fault::NotRobot);
}

#[test]
fn bad_xml_is_refused_with_its_place() {
    let text = "<robot name='r'>\n  <link name='a>\n</robot>";
    let reading = read(text);
    assert!(reading.robot.is_none());
    assert!(matches!(reading.problems[0].fault, Fault::NotXml(_)));
    for text in [
        "",
        "\n<?xml version='1.0'?><robot name='r'/>",
        "<robot name='r'><gazebo:x/></robot>",
        "<robot name='r'>&lol;</robot>",
        "<!DOCTYPE robot [<!ENTITY a 'b'>]><robot name='r'/>",
        "<robot name='r'><link name='a'></robot>",
        "<robot name='\u{1}'/>",
    ] {
        assert!(matches!(read(text).problems[0].fault, Fault::NotXml(_)), "{text}");
    }
    for text in [
        "<!DOCTYPE robot><robot name='r'/>",
        "<!DOCTYPE robot SYSTEM 'http://example.org/urdf.dtd'><robot name='r'/>",
        "<robot name='r'/><!-- <!ENTITY -->",
    ] {
        assert_eq!(read(text).problems, []);
    }
}

#[test]
fn deep_nesting_is_refused() {
    let nested = |levels: usize| format!("{}{}", "<a>".repeat(levels), "</a>".repeat(levels));
    // The robot itself is one level.
    let reading = robot(&nested(255));
    assert_eq!(reading.problems, []);
    assert_eq!(reading.robot.unwrap().unknown_elements, [nested(255)]);
    for levels in [256, 200_000] {
        assert!(faults(&nested(levels))[0].contains("more than 256 levels"));
    }
}

#[test]
fn every_key_of_legacy_modules_is_written_and_no_other() {
    let bare = "<link name='a'/><joint name='j' type='revolute'><parent link='a'/><child link='b'/></joint>";
    let full = "<link name='b'><inertial/><visual><geometry><sphere radius='1'/></geometry><material name='m'/>\
                </visual><collision><geometry><box size='1 2 3'/></geometry></collision></link>\
                <joint name='k' type='planar'><parent link='b'/><child link='c'/><origin/><axis/><limit/>\
                <dynamics/><mimic joint='j'/><safety_controller k_velocity='1'/></joint><link name='c'/>\
                <material name='m'><color rgba='1 0 0 1'/></material>";
    let reading = robot(&format!("{bare}{full}"));
    let document = as_legacy(&reading.robot.expect("a robot")).expect("a document");
    let module: urdd_format::legacy::urdf::UrdfModule =
        serde_json::from_value(document.clone()).expect("of the schema");
    assert_eq!(serde_json::to_value(module).expect("JSON"), document);
}
