//! The order of joints: of a robot whose branches were loaded by MuJoCo 4.0.0, Pinocchio 4.1.0, PyBullet 3.2.7, Drake
//! 1.51.1 and Newton 1.8.0, which had the joints as here. `tests/figures/exports/order.py` asks them about whole robots.

use urdd_export::{Choices, Export, Format, joint_orders};
use urdd_robot::Robot;

use crate::made::{exported, robot, urdf};

/// Joints of a tree, as name, parent, child and type; the names of links say nothing of the order.
const JOINTS: [(&str, &str, &str, &str); 9] = [
    ("z_second", "z1", "z2", "revolute"),
    ("z_first", "root", "z1", "revolute"),
    ("a_first", "root", "a1", "revolute"),
    ("a_second", "a1", "a2", "revolute"),
    ("m_first", "root", "m1", "revolute"),
    ("B_first", "root", "b1", "revolute"),
    ("m_second", "m1", "m2", "revolute"),
    ("k_fix", "root", "k1", "fixed"),
    ("k_second", "k1", "k2", "prismatic"),
];

const AS_WRITTEN: &str = "z_second z_first a_first a_second m_first B_first m_second k_second";
const DEPTH_FIRST: &str = "z_first z_second a_first a_second m_first m_second B_first k_second";
const BY_NAME: &str = "B_first a_first a_second k_second m_first m_second z_first z_second";
const BREADTH_FIRST: &str = "B_first a_first m_first z_first a_second k_second m_second z_second";

fn tree() -> String {
    let mut links: Vec<&str> = JOINTS.iter().map(|(_, _, child, _)| *child).collect();
    links.push("root");
    links.reverse();
    let links = links.into_iter().map(|link| format!(r#"<link name="{link}"/>"#));
    let joints = JOINTS.iter().map(|(name, parent, child, kind)| {
        format!(
            r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>
            <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>"#
        )
    });
    links.chain(joints).collect()
}

fn joints(robot: &Robot, program: &str) -> String {
    let orders = joint_orders(robot).expect("a tree");
    let order = orders.iter().find(|order| order.program == program).expect("a program");
    order.joints.join(" ")
}

fn has_note(made: &Export) -> bool {
    made.notes.iter().any(|note| note.to_string().contains("`urdd info --order`"))
}

#[test]
fn each_program_has_its_own_order() {
    let (_folder, robot) = robot(&urdf(&tree()));
    for (program, expected) in [
        ("urdf", AS_WRITTEN),
        ("libsdformat", AS_WRITTEN),
        ("mujoco", DEPTH_FIRST),
        ("pybullet", DEPTH_FIRST),
        ("drake", DEPTH_FIRST),
        ("newton", BY_NAME),
        ("pinocchio", BY_NAME),
        ("isaac", BREADTH_FIRST),
    ] {
        assert_eq!(joints(&robot, program), expected, "{program}");
    }
}

#[test]
fn an_export_says_the_order_of_its_programs() {
    let (_folder, robot) = robot(&urdf(&tree()));
    let of = |format: Format, program: &str| {
        let made = exported(&robot, format);
        let report: serde_json::Value = serde_json::from_str(&made.report).expect("JSON");
        let joints = report["order"][program]["joints"].as_array().expect("joints").clone();
        let names: Vec<String> = joints.iter().map(|name| name.as_str().unwrap().into()).collect();
        (names.join(" "), has_note(&made))
    };
    assert_eq!(of(Format::Mjcf, "mujoco"), (DEPTH_FIRST.into(), true));
    assert_eq!(of(Format::Drake, "drake"), (DEPTH_FIRST.into(), true));
    assert_eq!(of(Format::Usd, "isaac"), (BREADTH_FIRST.into(), true));
    assert_eq!(of(Format::Sdf, "libsdformat"), (AS_WRITTEN.into(), false));
    assert_eq!(of(Format::Spherized, "pinocchio"), (BY_NAME.into(), false));
    assert_eq!(of(Format::Moveit, "pybullet"), (DEPTH_FIRST.into(), false));
}

/// A chain is the same everywhere, and says nothing.
#[test]
fn a_chain_has_one_order() {
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            r#"<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>
            <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>"#
        )
    };
    let links = ["a", "b", "c"].map(|name| format!(r#"<link name="{name}"/>"#)).concat();
    let parts = links + &joint("z", "a", "b") + &joint("y", "b", "c");
    let (_folder, robot) = robot(&urdf(&parts));
    for order in joint_orders(&robot).expect("a tree") {
        assert_eq!(order.joints, ["z", "y"], "{}", order.program);
    }
    assert!(Format::ALL.iter().all(|format| {
        let choices = Choices { samples: 100, ..Choices::default() };
        let options = choices.options(*format).expect("options");
        urdd_export::export(&robot, &options).is_ok_and(|made| !has_note(&made))
            || [Format::Curobo, Format::Foam, Format::Spherized].contains(format)
    }));
}

/// Joints as an export has them: parts of a floating and a planar joint, fixed ones where limits are equal or a mimic
/// stands, and names of prims.
#[test]
fn joints_are_called_and_moved_as_in_the_export() {
    let limits = |lower: f64, upper: f64| {
        format!(
            r#"<axis xyz="0 0 1"/><limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/>"#
        )
    };
    let joint = |name: &str, kind: &str, [parent, child]: [&str; 2], inside: &str| {
        format!(
            r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>"#
        )
    };
    let links =
        ["a", "b", "c", "d", "e", "f", "twin"].map(|name| format!(r#"<link name="{name}"/>"#));
    let parts = links.concat()
        + &joint("flies", "floating", ["a", "b"], "")
        + &joint("slides", "planar", ["b", "c"], r#"<axis xyz="0 0 1"/>"#)
        + &joint("held", "revolute", ["c", "d"], &limits(0.5, 0.5))
        + &joint("stays", "fixed", ["d", "e"], "")
        + &joint(
            "stands",
            "revolute",
            ["e", "f"],
            &(limits(-1.0, 1.0) + r#"<mimic joint="stays"/>"#),
        )
        + &joint("twin", "revolute", ["f", "twin"], &limits(-1.0, 1.0));
    let (_folder, robot) = robot(&urdf(&parts));
    let floating = "flies/trans_x flies/trans_y flies/trans_z flies";
    let planar = "slides/trans_x slides/trans_y slides/rot";
    assert_eq!(joints(&robot, "mujoco"), format!("{floating} {planar} held stands twin"));
    assert_eq!(joints(&robot, "drake"), format!("{floating} slides held twin"));
    assert_eq!(joints(&robot, "libsdformat"), format!("{floating} {planar} held twin_joint"));
    assert_eq!(joints(&robot, "isaac"), "flies slides twin");
    // It holds a floating joint fixed.
    assert_eq!(joints(&robot, "pybullet"), "slides held twin");
    assert_eq!(joints(&robot, "urdf"), "flies slides held twin");
}

/// Drake's actuators: those of the transmissions of the source, then one for each other joint that has effort.
#[test]
fn actuators_are_those_of_the_file() {
    let transmission = |joint: &str| {
        format!(
            r#"<transmission name="of_{joint}"><type>transmission_interface/SimpleTransmission</type>
            <joint name="{joint}"/><actuator name="{joint}_motor"/></transmission>"#
        )
    };
    let parts = tree() + &transmission("m_second") + &transmission("a_first");
    let (_folder, robot) = robot(&urdf(&parts));
    let orders = joint_orders(&robot).expect("a tree");
    let of = |program: &str| {
        let order = orders.iter().find(|order| order.program == program).expect("a program");
        order.actuators.clone()
    };
    let drake = [
        "m_second_motor",
        "a_first_motor",
        "z_second",
        "z_first",
        "a_second",
        "m_first",
        "B_first",
        "k_second",
    ];
    assert_eq!(of("drake"), drake);
    // Drake drops the actuator of a joint without effort.
    let weak = parts.replacen(r#"effort="1""#, r#"effort="0""#, 7).replacen(
        r#"effort="0""#,
        r#"effort="1""#,
        6,
    );
    let (_folder, weak) = crate::made::robot(&urdf(&weak));
    let orders_of_weak = joint_orders(&weak).expect("a tree");
    let of_weak = orders_of_weak.iter().find(|order| order.program == "drake").expect("drake");
    assert!(!of_weak.actuators.iter().any(|name| name == "m_second_motor"));
    let text = exported(&robot, Format::Drake).text;
    let places = drake.map(|name| text.find(&format!(r#"<actuator name="{name}"/>"#)).expect(name));
    assert!(places.is_sorted(), "{places:?}");
    // As `urdd export mjcf --actuators` writes them.
    assert_eq!(of("mujoco").join(" "), AS_WRITTEN);
    let choices =
        Choices { actuators: Some(urdd_export::ActuatorKind::Motor), ..Choices::default() };
    let made = crate::made::export(&robot, Format::Mjcf, &choices).expect("an export");
    let written = made.text.split("<motor name=\"").skip(1);
    let written: Vec<&str> = written.filter_map(|rest| rest.split('"').next()).collect();
    assert_eq!(written.join(" "), AS_WRITTEN);
    assert!(of("isaac").is_empty());
}
