//! `<gazebo>` elements in SDF, where libsdformat's own converter from URDF has them. `tests/figures/exports` compares the
//! two on whole robots.

use urdd_export::Format;
use urdd_xml::Node;

use crate::made::{exported, robot, urdf};

const PARTS: &str = r#"<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
<link name="b"><visual><geometry><box size="1 1 1"/></geometry></visual>
<collision><geometry><box size="1 1 1"/></geometry></collision></link><link name="c"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="f" type="fixed"><parent link="b"/><child link="c"/></joint>
<gazebo><static>true</static><plugin name="a" filename="liba.so"><robotNamespace>/r &amp; d</robotNamespace></plugin></gazebo>
<gazebo reference="b"><mu1>0.50</mu1><mu2 value="1e-1"/><fdir1>1 0 0</fdir1><kp>1000000.0</kp><kd>7</kd><maxVel>0.25</maxVel><minDepth>0.001</minDepth>
<maxContacts>3</maxContacts><laserRetro>2</laserRetro><material>Gazebo/Orange</material><turnGravityOff>true</turnGravityOff>
<selfCollide>Yes</selfCollide><dampingFactor>0.125</dampingFactor>
<visual><cast_shadows>0</cast_shadows></visual><collision><max_contacts>9</max_contacts><plugin name="p" filename="p"/><plugin name="q" filename="q"/></collision>
<sensor name="i" type="imu"><imu><noise><rate/></noise><angular_velocity><x><noise type="gaussian"/></x></angular_velocity></imu></sensor>
<sensor name="visual_0" type="contact"><contact><collision>b_collision</collision></contact></sensor></gazebo>
<gazebo reference="b"><mu1>0.75</mu1></gazebo>
<gazebo reference="j"><stopCfm>0.1</stopCfm><stopErp>0.2</stopErp><fudgeFactor>0.3</fudgeFactor><provideFeedback>true</provideFeedback>
<implicitSpringDamper>1</implicitSpringDamper><springReference>0.4</springReference><springStiffness>0.5</springStiffness></gazebo>
<gazebo reference="f"><preserveFixedJoint>true</preserveFixedJoint><springReference>1</springReference></gazebo>
<gazebo reference="nothing"><mu1>1</mu1></gazebo><gazebo><canonicalBody>b</canonicalBody></gazebo><gazebo reference="a"><kp>hard</kp></gazebo>"#;

fn find<'a>(node: Node<'a, 'a>, path: &str) -> Option<Node<'a, 'a>> {
    path.split('/').try_fold(node, |at, tag| at.children().find(|child| child.has_tag_name(tag)))
}

#[test]
fn what_gazebo_elements_say_is_where_sdf_has_it() {
    let (_folder, robot) = robot(&urdf(PARTS));
    let made = exported(&robot, Format::Sdf);
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("XML");
    let model = document.descendants().find(|node| node.has_tag_name("model")).expect("a model");
    let named = |tag: &str, name: &str| {
        let mut nodes = document.descendants().filter(|node| node.has_tag_name(tag));
        nodes.find(|node| node.attribute("name") == Some(name)).expect("an element")
    };
    let text = |node: Node, path: &str| {
        find(document.get_node(node.id()).unwrap(), path)
            .and_then(|at| at.text())
            .map(str::to_owned)
    };
    let check = |node: Node, expected: &[(&str, &str)]| {
        for (path, value) in expected {
            assert_eq!(text(node, path).as_deref(), Some(*value), "{path}");
        }
    };
    check(model, &[("static", "true"), ("plugin/robotNamespace", "/r & d")]);
    let link = named("link", "b");
    check(
        link,
        &[
            ("gravity", "false"),
            ("self_collide", "true"),
            ("velocity_decay/linear", "0.125"),
            ("velocity_decay/angular", "0.125"),
            ("visual/cast_shadows", "0"),
            ("visual/material/script/name", "Gazebo/Orange"),
            ("visual/material/script/uri", "file://media/materials/scripts/gazebo.material"),
            ("collision/surface/friction/ode/mu", "0.75"),
            ("collision/surface/friction/ode/mu2", "0.1"),
            ("collision/surface/friction/ode/fdir1", "1 0 0"),
            ("collision/surface/contact/ode/kp", "1000000"),
            ("collision/surface/contact/ode/kd", "7"),
            ("collision/surface/contact/ode/max_vel", "0.25"),
            ("collision/surface/contact/ode/min_depth", "0.001"),
            ("collision/max_contacts", "3"),
            ("collision/laser_retro", "2"),
        ],
    );
    check(
        named("joint", "j"),
        &[
            ("physics/ode/limit/cfm", "0.1"),
            ("physics/ode/limit/erp", "0.2"),
            ("physics/ode/fudge_factor", "0.3"),
            ("physics/provide_feedback", "true"),
            ("physics/ode/implicit_spring_damper", "true"),
            ("axis/dynamics/spring_reference", "0.4"),
            ("axis/dynamics/spring_stiffness", "0.5"),
        ],
    );
    assert_eq!(named("joint", "f").attribute("type"), Some("fixed"));
    assert!(find(named("joint", "f"), "axis").is_none());
    assert!(find(named("link", "a"), "collision/surface").is_none());
    assert!(find(model, "canonicalBody").is_none());
    // Noise is where SDF 1.5 and later have it.
    assert!(find(link, "sensor/imu/angular_velocity/x/noise").is_some());
    assert!(find(link, "sensor/imu/noise").is_none());
    // The sensor keeps its name, and hears the collisions of the file.
    let heard = text(named("sensor", "visual_0"), "contact/collision");
    assert_eq!(heard.as_deref(), find(link, "collision").and_then(|node| node.attribute("name")));
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    for note in [
        "not checked",
        "neither a link nor a joint",
        "a number in it is not one",
        "`<noise>` is left out",
        "an element in it is not defined by SDF for a model, a link or a joint, or cannot be added to ours",
    ] {
        assert!(notes.iter().any(|said| said.contains(note)), "{note}: {notes:?}");
    }
    assert!(!made.report.contains("\"lost\": [\n    {\n      \"count\": 7"));
    let report: serde_json::Value = serde_json::from_str(&made.report).expect("JSON");
    let otherwise = report["otherwise"].as_array().expect("a list");
    assert!(
        otherwise.iter().any(|entry| entry["what"] == "`<gazebo>` elements" && entry["count"] == 8),
        "{report}"
    );
}

/// Elements that would give the model two parts of one name, or a prefix that nothing declares, are left out.
#[test]
fn gazebo_elements_cannot_break_the_file() {
    let parts = r#"<link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
<gazebo><link name="a"/><frame name="world_fixed"/><plugin name="b" filename="x"/><plugin name="b" filename="y"/></gazebo>
<gazebo><include><uri>x</uri></include></gazebo><gazebo reference="b"><pose>1 0 0 0 0 0</pose></gazebo><gazebo reference="j"><parent>b</parent></gazebo>
<gazebo xmlns:q="urn:q" reference="a"><q:x/><turnGravityOff value="true"/><sensor name="s" type="imu"/><sensor name="s" type="imu"/></gazebo>"#;
    let (_folder, robot) = robot(&urdf(parts));
    let made = exported(&robot, Format::Sdf);
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("XML");
    let count = |tag: &str| document.descendants().filter(|node| node.has_tag_name(tag)).count();
    assert_eq!(["link", "frame", "plugin", "sensor"].map(count), [2, 1, 2, 1]);
    // What would be there twice, and what would load another file.
    assert_eq!(["include", "parent"].map(count), [0, 2]);
    assert!(!made.text.contains("<pose>1 0 0 0 0 0</pose>"));
    assert!(!made.text.contains("q:x") && made.text.contains("<gravity>false</gravity>"));
    assert!(made.text.contains("<joint name=\"world_fixed_2\""));
}
