//! Robots that tests of a crate and tests of the program share, as URDFs.

/// A base with a separate tower, and an arm on a hub without shapes. The arm's pieces near the hub always touch the
/// base, and the arm hits the tower when it turns.
pub const TOWER: &str = r#"<robot name="tower">
<link name="base"><visual><geometry><box size="0.4 0.4 0.2"/></geometry></visual>
<visual><origin xyz="0 1 0.1"/><geometry><box size="0.1 0.1 0.4"/></geometry></visual></link>
<link name="hub"/>
<link name="arm"><visual><geometry><box size="0.2 0.2 0.4"/></geometry></visual>
<visual><origin xyz="0.8 0 0.15"/><geometry><box size="1 0.1 0.1"/></geometry></visual></link>
<joint name="a" type="revolute"><parent link="base"/><child link="hub"/><axis xyz="0 0 1"/><limit lower="0" upper="2" effort="1" velocity="1"/></joint>
<joint name="b" type="revolute"><parent link="hub"/><child link="arm"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/><limit lower="-0.1" upper="0.1" effort="1" velocity="1"/></joint>
</robot>"#;

/// Five boxes in a line, far from each other: adjacent ones are skipped, no other pair is.
pub fn line() -> String {
    let mut text = String::from("<robot name=\"line\">");
    for i in 0..5 {
        text += &format!(
            "<link name=\"l{i}\"><visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual></link>"
        );
    }
    for i in 0..4 {
        text += &format!(
            "<joint name=\"j{i}\" type=\"revolute\"><parent link=\"l{i}\"/><child link=\"l{}\"/><origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/><limit lower=\"-0.1\" upper=\"0.1\" effort=\"1\" velocity=\"1\"/></joint>",
            i + 1
        );
    }
    text + "</robot>"
}

/// An arm of four joints with two fingers, and two wheels.
pub fn mobile() -> String {
    let mut text = String::from("<robot name=\"m\"><link name=\"chassis\"/>");
    let mut joint = |name: &str, kind: &str, parent: &str, xyz: &str, axis: &str| {
        text += &format!(
            "<link name=\"{name}_link\"/><joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/>\
             <child link=\"{name}_link\"/><origin xyz=\"{xyz}\"/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>"
        );
    };
    joint("w1", "continuous", "chassis", "0 0.2 0", "0 1 0");
    joint("w2", "continuous", "chassis", "0 -0.2 0", "0 1 0");
    joint("j1", "revolute", "chassis", "0 0 0.1", "0 0 1");
    joint("j2", "revolute", "j1_link", "0 0 0.3", "0 1 0");
    joint("j3", "revolute", "j2_link", "0 0 0.3", "0 1 0");
    joint("j4", "revolute", "j3_link", "0 0 0.3", "1 0 0");
    joint("mount", "fixed", "j4_link", "0 0 0.1", "1 0 0");
    joint("palm", "fixed", "mount_link", "0 0 0.1", "1 0 0");
    joint("f1", "prismatic", "palm_link", "0 0.02 0.1", "0 1 0");
    joint("f2", "prismatic", "palm_link", "0 -0.02 0.1", "0 -1 0");
    text + "</robot>"
}

/// An arm of one joint, with its upper limit and the geometry of its second link.
pub fn arm(upper: f64, geometry: &str) -> String {
    format!(
        r#"<robot name="arm"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
        <link name="b"><visual><origin xyz="0 0 2"/><geometry>{geometry}</geometry></visual></link>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
        <limit lower="-1" upper="{upper}" effort="1" velocity="1"/></joint></robot>"#
    )
}

/// A chain of three joints, of which the last follows the second.
pub const FOLLOWER: &str = r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="k" type="revolute"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="m" type="revolute"><parent link="c"/><child link="d"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="k"/></joint></robot>"#;

/// A group's state, as an SRDF has it.
pub fn state(name: &str, group: &str, joints: &[(&str, &str)]) -> String {
    let joints =
        joints.iter().map(|(joint, value)| format!("<joint name=\"{joint}\" value=\"{value}\"/>"));
    format!(
        "<group_state name=\"{name}\" group=\"{group}\">{}</group_state>\n",
        joints.collect::<String>()
    )
}
