//! MJCF with actuators, keyframes, a free base and a scene. `tests/figures/exports` runs them in MuJoCo.

use std::f64::consts::TAU;
use std::path::Path;

use crate::made::export;
use urdd_export::{ActuatorKind, Choices, Export, ExportError, Format, Setup};
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_robot::Robot;
use urdd_xml::{Document, Node};

use testkit::robots::made_of;

/// A pendulum of 2 kg at 0.5 m with 0.1 kg m² of its own, on its end a slide of 3 kg, and a joint that follows the slide
/// twice as far with 1 kg.
const URDF: &str = r#"<robot name="r"><link name="base"><visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link>
<link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
<inertia ixx="0.7" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.7"/></inertial></link>
<link name="rod"><inertial><mass value="3"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<link name="tip"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="2" effort="50" velocity="3"/></joint>
<joint name="push" type="prismatic"><parent link="base"/><child link="rod"/><axis xyz="0 0 1"/>
<limit lower="0.1" upper="0.3" effort="20" velocity="0.5"/></joint>
<joint name="follow" type="prismatic"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
<limit lower="0" upper="1" effort="5" velocity="1"/><mimic joint="push" multiplier="2" offset="0.05"/></joint></robot>"#;

fn mjcf(robot: &Robot, choices: Choices) -> Export {
    made(robot, choices, false)
}

fn made(robot: &Robot, choices: Choices, floating_base: bool) -> Export {
    let options = Choices { floating_base, output: Some("r.xml".into()), ..choices };
    export(robot, Format::Mjcf, &options).expect("an export")
}

fn with(actuators: ActuatorKind) -> Choices {
    Choices { actuators: Some(actuators), bandwidth: Some(5.0), ..Choices::default() }
}

fn number(node: Node, key: &str) -> f64 {
    node.attribute(key).expect(key).parse().expect("a number")
}

fn one<'a>(document: &'a Document, tag: &'a str, name: &str) -> Node<'a, 'a> {
    let mut found = document
        .descendants()
        .filter(|node| node.has_tag_name(tag) && node.attribute("name") == Some(name));
    found.next().unwrap_or_else(|| panic!("<{tag}> {name}"))
}

/// Closed forms: 0.1 + 2 * 0.5² kg m² turn, and 3 + 2² * 1 kg are pushed.
#[test]
fn gains_are_those_of_the_inertia_that_a_joint_moves() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    let w = TAU * 5.0;
    let text = mjcf(&robot, with(ActuatorKind::Position)).text;
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
    for (name, inertia, range, force) in
        [("turn", 0.6, "-1 2", "-50 50"), ("push", 7.0, "0.1 0.3", "-20 20")]
    {
        let actuator = one(&document, "position", name);
        let is = |key, expected: f64| {
            let found = number(actuator, key);
            assert!((found / expected - 1.0).abs() < 1e-3, "{name} {key} {found}");
        };
        is("kp", inertia * w * w);
        is("kv", 2.0 * inertia * w);
        assert_eq!(actuator.attribute("joint"), Some(name));
        assert_eq!(actuator.attribute("ctrlrange"), Some(range));
        assert_eq!(actuator.attribute("forcerange"), Some(force));
    }
    // The joint that follows has no actuator of its own.
    let all = document.descendants().filter(|n| n.has_tag_name("position"));
    assert_eq!(all.count(), 2);
    let text = mjcf(&robot, with(ActuatorKind::Velocity)).text;
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
    let actuator = one(&document, "velocity", "turn");
    assert!((number(actuator, "kv") / (0.6 * w) - 1.0).abs() < 1e-3);
    assert_eq!(actuator.attribute("ctrlrange"), Some("-3 3"));
    let text = mjcf(&robot, with(ActuatorKind::Motor)).text;
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
    let actuator = one(&document, "motor", "push");
    assert_eq!(actuator.attribute("ctrlrange"), Some("-20 20"));
}

/// Adds a named configuration with a DOF at 0.5 rad.
pub fn name_configuration(robot: &Robot, path: &Path, name: &str, dof: &str) {
    let edit = ConfigurationEdit {
        name: ConfigurationName::new(name).expect("a name"),
        positions: vec![DofPosition { dof_name: dof.to_owned(), position: 0.5 }],
    };
    let edited = robot.with_named_configurations(&[edit]).expect("files");
    for (file, bytes) in edited.files {
        let file = path.join(file);
        std::fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        std::fs::write(file, bytes).expect("a file");
    }
}

#[test]
fn named_configurations_are_keyframes() {
    let (_folder, path) = made_of(URDF);
    let key = |robot: &Robot, name: &str| {
        let text = mjcf(robot, with(ActuatorKind::Position)).text;
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
        let key = one(&document, "key", name);
        ["qpos", "ctrl"].map(|of| key.attribute(of).expect("numbers").to_owned())
    };
    let robot = Robot::open(&path).expect("a robot");
    // 0 is out of the bounds of `push`; `follow` is at 2 * 0.1 + 0.05.
    assert_eq!(key(&robot, "default"), ["0 0.1 0.25", "0 0.1"]);
    name_configuration(&robot, &path, "home", "turn");
    let robot = Robot::open(&path).expect("a robot");
    assert_eq!(key(&robot, "home"), ["0.5 0.1 0.25", "0.5 0.1"]);
    // Without actuators there is nothing to control.
    let plain = mjcf(&robot, Choices::default()).text;
    let document = urdd_xml::parse(&plain, urdd_xml::Kind::Other).expect("well-formed");
    let home = one(&document, "key", "home");
    assert_eq!((home.attribute("qpos"), home.attribute("ctrl")), (Some("0.5 0.1 0.25"), None));
}

#[test]
fn a_free_base_stands_on_the_floor() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    let with_scene = Choices { scene: true, ..Choices::default() };
    let made = self::made(&robot, with_scene.clone(), true);
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    // The base's box reaches 0.1 m down.
    assert_eq!(one(&document, "body", "base").attribute("pos"), Some("0 0 0.1"));
    one(&document, "freejoint", "floating_base");
    let key = one(&document, "key", "default");
    assert_eq!(key.attribute("qpos"), Some("0 0 0.1 1 0 0 0 0 0.1 0.25"));
    // The base has no mass, and moves.
    assert!(made.notes.iter().any(|note| note.to_string().contains("`base`")));
    let (file, scene) = made.files.last().expect("a scene");
    assert_eq!(file, "r_scene.xml");
    let scene = urdd_xml::parse(std::str::from_utf8(scene).expect("text"), urdd_xml::Kind::Other)
        .expect("well-formed");
    let floor = one(&scene, "geom", "floor");
    assert_eq!(floor.attribute("pos"), Some("0 0 0"));
    // Fixed to the world, the box is below z = 0, and so is the floor.
    let made = mjcf(&robot, with_scene);
    let scene = String::from_utf8(made.files.last().expect("a scene").1.clone()).expect("text");
    let scene = urdd_xml::parse(&scene, urdd_xml::Kind::Other).expect("well-formed");
    assert_eq!(one(&scene, "geom", "floor").attribute("pos"), Some("0 0 -0.1"));
    assert!(!made.text.contains("freejoint") && !made.text.contains("<key"));
}

/// A keyframe keeps the name of a configuration, or the export is refused and names it.
#[test]
fn names_of_configurations_come_out_as_they_went_in() {
    for (name, is_held) in [
        ("-->\"/><evil a='", true),
        ("a\nb\t\u{202e}", true),
        ("\u{1b}[2J", false),
        ("\u{0}", false),
    ] {
        let (_folder, path) = made_of(URDF);
        name_configuration(&Robot::open(&path).expect("a robot"), &path, name, "turn");
        let robot = Robot::open(&path).expect("a robot");
        match export(&robot, Format::Mjcf, &Choices::default()) {
            Ok(made) => {
                assert!(is_held, "{name:?}");
                let document =
                    urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
                one(&document, "key", name);
            }
            Err(ExportError::Name { name: said, what, .. }) => {
                assert!(!is_held && said == name && what == "configuration");
            }
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn a_root_called_world_stays_and_that_is_said() {
    let (_folder, path) = made_of(&URDF.replace("\"base\"", "\"world\""));
    let robot = Robot::open(path).expect("a robot");
    let made = made(&robot, Choices::default(), true);
    assert!(!made.text.contains("<freejoint"));
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes.iter().filter(|note| note.contains("never moves")).count(), 1, "{notes:?}");
}

/// What a file says of an actuator goes before the limits of its joint.
#[test]
fn actuators_are_as_a_file_says() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    let setup = r#"robot = "r"
[actuators.joint.turn]
name = "push"
kind = "velocity"
kp = 0.0
kv = 12.5
ctrlrange = [-6.0, 12.0]
forcerange = [-3.0, 8.0]
[actuators.joint.push]
kp = 40.0
kv = 2.0
ctrlrange = [0.125, 0.25]"#;
    let setup = Setup::from_toml(setup, "x", &robot).expect("a setup");
    let made = |kind| {
        let choices = Choices { setup: Some(setup.clone()), ..with(kind) };
        mjcf(&robot, choices).text
    };
    let of = |text: &str, tag: &str, joint: &str| -> Vec<String> {
        let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
        let is_one = |n: &Node| n.has_tag_name(tag) && n.attribute("joint") == Some(joint);
        let found = document.descendants().find(is_one).expect("an actuator");
        let keys = ["name", "kp", "kv", "ctrlrange", "forcerange"];
        keys.map(|key| found.attribute(key).unwrap_or("-").to_owned()).to_vec()
    };
    let text = made(ActuatorKind::Position);
    assert_eq!(of(&text, "velocity", "turn"), ["push", "-", "12.5", "-6 12", "-3 8"]);
    // Two actuators cannot have one name.
    assert_eq!(of(&text, "position", "push"), ["push_2", "40", "2", "0.125 0.25", "-20 20"]);
    // A servo of speed stands in the first keyframe, and the slide is where it is.
    assert!(text.contains(r#"ctrl="0 0.1""#), "{text}");
    // Who asks for motors has motors.
    let text = made(ActuatorKind::Motor);
    assert_eq!(of(&text, "motor", "turn"), ["push", "-", "-", "-3 8", "-"]);
    // A range of positions is none of speeds.
    let text = made(ActuatorKind::Velocity);
    assert_eq!(of(&text, "velocity", "push")[2..], ["2", "-0.5 0.5", "-20 20"]);
}
