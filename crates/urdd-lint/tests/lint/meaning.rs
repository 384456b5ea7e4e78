//! What means the same in two URDFs, and what does not.

use urdd_lint::meaning::differences;
use urdd_xml::Xml;

const ARM: &str = r#"<robot name="arm"><link name="base"><visual><geometry><mesh filename="package://arm/m.stl"/></geometry><material name="red"/></visual></link>
    <material name="red"><color rgba="1 0 0 1"/></material>
    <link name="tool"/><joint name="j" type="revolute"><origin xyz="0.1 0 0.333333" rpy="0 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/><parent link="base"/><child link="tool"/></joint></robot>"#;

/// What is said of the robot above beside one with this in place of that.
fn said(that: &str, this: &str) -> Option<String> {
    assert!(ARM.contains(that), "{that}");
    let other = ARM.replace(that, this);
    let (one, other) = (Xml::new(ARM), Xml::new(&other));
    let [one, other] = [&one, &other].map(|xml| xml.document().expect("XML").root_element());
    let found = differences(one, other, &|_, _| false);
    assert_eq!(found.first.is_some(), found.count > 0);
    found.first.map(|(_, _, words)| words)
}

#[test]
fn what_means_the_same_is_no_difference() {
    for (that, this) in [
        ("robot", "robot"),
        ("0.1 0 0.333333", "1e-1  0.0 0.3333333333"),
        ("0.1 0 0.333333", "0.1 0 0.33333"),
        (" rpy=\"0 0 0\"", ""),
        ("z=\"0 0 1\"", "z=\"0 0 2\""),
        ("<link name=\"tool\"/>", "<link name=\"tool\" ><!-- a --></link>"),
        ("<axis", "<dynamics damping=\"0\"/><axis"),
        ("package://arm/", "file:///opt/share/arm/"),
        ("red\"/></visual", "r\"><color rgba=\"1 0 0 1.0\"/></material></visual"),
    ] {
        assert_eq!(said(that, this), None, "{this}");
    }
}

#[test]
fn what_means_something_else_is_said() {
    for (that, this, words) in [
        (
            "0.333333",
            "0.33334",
            "`xyz` of `<origin>` is `0.1 0 0.333333`, and xacro makes `0.1 0 0.33334`",
        ),
        ("z=\"0 0 1\"", "z=\"0 0 -1\"", "`xyz` of `<axis>` is `0 0 1`, and xacro makes `0 0 -1`"),
        (" upper=\"1\"", "", "`upper` of `<limit>` is `1`, and xacro makes none"),
        ("<axis", "<dynamics damping=\"2\"/><axis", "`<dynamics>` is missing"),
        ("1 0 0 1", "1 0 0 0", "`rgba` of `<color>` is `1 0 0 1`, and xacro makes `1 0 0 0`"),
        ("<link name=\"tool\"/>", "", "xacro makes no such `<link>`"),
        (
            "<link name=\"tool\"/>",
            "<link name=\"tool\"/><link name=\"b\"/>",
            "`<link>` `b` is missing",
        ),
        (
            "arm/m.stl",
            "arm/n.stl",
            "`filename` of `<mesh>` is `package://arm/m.stl`, and xacro makes `package://arm/n.stl`",
        ),
    ] {
        assert_eq!(said(that, this).as_deref(), Some(words), "{this}");
    }
}
