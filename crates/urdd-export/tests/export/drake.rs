//! The URDF for Drake, by the rules of its parser: `tests/figures/exports/peers.py` loads it in Drake itself.

use crate::made::export;
use urdd_export::{Choices, ExportError, Format, Note};
use urdd_robot::Robot;
use urdd_xml::{Document, Node};

use testkit::robots::{made, made_of, our_robots};

/// What Drake 1.51 rejects, found with the program itself.
fn refused(document: &Document) -> Vec<String> {
    let robot = document.root_element();
    let joints: Vec<Node> = robot.children().filter(|n| n.tag_name().name() == "joint").collect();
    let kind = |joint: &Node| joint.attribute("type").expect("a type").to_owned();
    let dofs = |joint: &Node| match kind(joint).as_str() {
        "fixed" => 0,
        "revolute" | "continuous" | "prismatic" => 1,
        _ => 3,
    };
    let child =
        |node: &Node, name: &str| node.children().find(|n| n.has_tag_name(name)).map(|n| n.id());
    let number = |node: Node, key: &str| {
        node.attribute(key).map(|text| text.parse::<f64>().expect("a number"))
    };
    let mut faults = Vec::new();
    for joint in &joints {
        let name = joint.attribute("name").expect("a name");
        let is_custom = joint.tag_name().namespace() == Some("http://drake.mit.edu");
        let is_known = match is_custom {
            true => ["ball", "planar"].contains(&kind(joint).as_str()),
            false => ["revolute", "continuous", "prismatic", "fixed", "floating"]
                .contains(&kind(joint).as_str()),
        };
        if !is_known {
            faults.push(format!("{name}: {}", kind(joint)));
        }
        if let Some(mimic) = child(joint, "mimic").and_then(|id| document.get_node(id)) {
            let driver =
                joints.iter().find(|other| other.attribute("name") == mimic.attribute("joint"));
            if dofs(joint) != 1 || driver.is_none_or(|driver| dofs(driver) != 1) {
                faults.push(format!("{name}: mimic"));
            }
        }
        if let Some(limit) = child(joint, "limit").and_then(|id| document.get_node(id)) {
            let negative = ["velocity", "effort", "acceleration"];
            let is_negative =
                negative.iter().any(|key| number(limit, key).is_some_and(|value| value < 0.0));
            let crossed =
                number(limit, "lower").zip(number(limit, "upper")).is_some_and(|(a, b)| a > b);
            if is_negative || crossed {
                faults.push(format!("{name}: limit"));
            }
        }
    }
    faults
}

#[test]
fn our_robots_hold_nothing_that_drake_refuses() {
    let awkward = testkit::repository().join("tests/figures/exports/awkward.urdf");
    let robots = our_robots().into_iter().map(|(_, urdf)| urdf);
    for urdf in robots.chain([awkward]) {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let text = export(&robot, Format::Drake, &Choices::default()).expect("an export").text;
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
        assert_eq!(refused(&document), Vec::<String>::new(), "{urdf:?}");
    }
}

fn joint(kind: &str, inner: &str) -> String {
    format!(
        "<robot name='r'><link name='a'/><link name='b'/>\
         <joint name='j' type='{kind}'><parent link='a'/><child link='b'/>{inner}</joint></robot>"
    )
}

fn exported(urdf: &str) -> (String, Vec<Note>) {
    let (_folder, path) = made_of(urdf);
    let robot = Robot::open(path).expect("a robot");
    let made = export(&robot, Format::Drake, &Choices::default()).expect("an export");
    let notes = made.notes.into_iter().filter(|note| !matches!(note, Note::NoShapes(_)));
    (made.text, notes.collect())
}

#[test]
fn joints_are_as_drake_has_them_and_what_is_left_out_is_said() {
    for (kind, inner, expected, notes) in [
        ("spherical", "", "<drake:joint name=\"j\" type=\"ball\">", 0),
        ("planar", "<axis xyz='0 1 1'/>", "<drake:joint name=\"j\" type=\"planar\">", 0),
        ("planar", "<dynamics damping='1'/>", "type=\"planar\"", 1),
        ("floating", "<origin xyz='1 0 0'/>", "<drake:joint name=\"j\" type=\"ball\">", 1),
        (
            "revolute",
            "<limit lower='1' upper='-1' effort='1' velocity='1'/>",
            "<limit effort=\"1\" velocity=\"1\"/>",
            1,
        ),
        (
            "revolute",
            "<limit lower='-1' effort='-1' velocity='-1'/>",
            "<limit lower=\"-1\" upper=\"0\"/>",
            1,
        ),
        (
            "continuous",
            "<limit lower='2' upper='1' effort='1' velocity='1'/>",
            "<limit effort=\"1\" velocity=\"1\"/>",
            0,
        ),
        (
            "revolute",
            "<limit lower='-1' effort='1' velocity='1'/>",
            "<limit lower=\"-1\" upper=\"0\" effort",
            0,
        ),
    ] {
        let (text, said) = exported(&joint(kind, inner));
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
        assert!(text.contains(expected), "{kind} {inner}: {text}");
        assert_eq!(said.len(), notes, "{kind} {inner}: {said:?}");
        assert_eq!(refused(&document), Vec::<String>::new());
    }
    // A body that floats in the world corresponds to Drake's floating joint.
    let (text, notes) = exported(&joint("floating", "").replace("'a'", "'world'"));
    assert!(text.contains("<joint name=\"j\" type=\"floating\">") && notes.is_empty(), "{text}");
    let (text, _) = exported(&joint("floating", "<origin xyz='0 0 1'/>").replace("'a'", "'world'"));
    assert!(text.contains("<link name=\"j/trans_x\"/>"), "{text}");
}

#[test]
fn transmissions_that_drake_refuses_are_left_out() {
    let simple = "<type>transmission_interface/SimpleTransmission</type>";
    let of = |inner: &str| format!("<transmission name='t'>{inner}</transmission>");
    for (transmission, is_kept) in [
        (of(&format!("{simple}<joint name='j'/><actuator name='m'/>")), true),
        (of("<type>pal/Differential</type><joint name='x'/>"), true),
        (of(&format!("{simple}<joint name='j'/>")), false),
        (of(&format!("{simple}<joint name='x'/><actuator name='m'/>")), false),
        (of("<joint name='j'/><actuator name='m'/>"), false),
        ("<loop_joint name='l'/>".to_owned(), false),
    ] {
        let urdf = joint("continuous", "").replace("</robot>", &format!("{transmission}</robot>"));
        let (text, notes) = exported(&urdf);
        assert_eq!(text.contains(&transmission), is_kept, "{text}");
        assert_eq!(notes.len(), usize::from(!is_kept), "{notes:?}");
    }
}

#[test]
fn a_frame_that_drake_needs_is_not_a_links_name() {
    let (_folder, path) = made_of(&joint("fixed", "").replace("'a'", "'j_parent'"));
    let robot = Robot::open(path).expect("a robot");
    let error = export(&robot, Format::Drake, &Choices::default()).expect_err("a name");
    assert!(matches!(&error, ExportError::Name { name, .. } if name == "j_parent"), "{error}");
}

/// Drake 1.51 makes each of these a body of 1 kg, but for what is expected here, which it takes as it is.
#[test]
fn masses_and_moments_are_those_that_drake_takes() {
    let tensor = |ixx: f64, iyy: f64, izz: f64| {
        format!("<inertia ixx='{ixx}' iyy='{iyy}' izz='{izz}' ixy='0' ixz='0' iyz='0'/>")
    };
    let cases = [
        ("0", tensor(0.05, 0.06, 0.03), [1e-9, 0.05, 0.06, 0.03], "1e-9 kg"),
        // Mass is missing.
        ("", tensor(0.05, 0.06, 0.03), [1e-9, 0.05, 0.06, 0.03], "1e-9 kg"),
        ("-2", tensor(0.05, 0.06, 0.03), [1e-9, 0.05, 0.06, 0.03], "a negative mass"),
        ("-2", String::new(), [0.0; 4], "a negative mass"),
        ("5", tensor(0.25, 0.25, 1.0), [5.0, 0.5, 0.5, 0.5], "their mean"),
        ("5", tensor(-0.25, 0.5, 0.5), [5.0, 0.25, 0.25, 0.25], "their mean"),
        ("5", tensor(-1.0, 0.5, 0.25), [5.0, 0.0, 0.0, 0.0], "their mean"),
        ("5", tensor(0.25, 0.25, 0.25), [5.0, 0.25, 0.25, 0.25], ""),
        ("0", String::new(), [0.0; 4], ""),
        ("0.5", String::new(), [0.5, 0.0, 0.0, 0.0], ""),
    ];
    for (mass, inertia, expected, said) in cases {
        let mass = match mass {
            "" => String::new(),
            mass => format!("<mass value='{mass}'/>"),
        };
        let urdf = format!(
            "<robot name='r'><link name='a'><inertial>{mass}{inertia}</inertial></link></robot>"
        );
        let (text, notes) = exported(&urdf);
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
        let of = |tag: &str, key: &str| -> f64 {
            let node = document.descendants().find(|node| node.has_tag_name(tag));
            node.and_then(|node| node.attribute(key)).expect(key).parse().expect("a number")
        };
        let found =
            [of("mass", "value"), of("inertia", "ixx"), of("inertia", "iyy"), of("inertia", "izz")];
        assert_eq!(found, expected, "{mass} {inertia}");
        assert_eq!(notes.len(), usize::from(!said.is_empty()), "{notes:?}");
        assert!(notes.iter().all(|note| note.to_string().contains(said)), "{notes:?}");
    }
}

/// Drake drops spaces and tabs around the name of a shape, refuses an empty one, and two that differ in these alone.
#[test]
fn names_of_shapes_are_those_that_drake_takes() {
    let shape = |kind: &str, name: &str| {
        format!("<{kind}{name}><geometry><box size='1 1 1'/></geometry></{kind}>")
    };
    for (name, expected) in [
        ("", None),
        (" name=''", None),
        (" name=' '", None),
        (" name='&#9; '", None),
        (" name=' a '", Some("a")),
        (" name='a b'", Some("a b")),
        (" name='\u{a0}'", Some("\u{a0}")),
    ] {
        let urdf = format!(
            "<robot name='r'><link name='l'>{}{}</link></robot>",
            shape("visual", name),
            shape("collision", name)
        );
        let (text, _) = exported(&urdf);
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
        let shapes = document
            .descendants()
            .filter(|node| node.has_tag_name("visual") || node.has_tag_name("collision"));
        let names: Vec<Option<&str>> = shapes.map(|node| node.attribute("name")).collect();
        assert_eq!(names, [expected, expected], "{name:?}");
    }
}
