//! SDF, read by a reader written here. `tests/figures/exports` loads it with libsdformat and Drake.

use std::collections::HashMap;

use crate::made::export;
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use urdd_export::{Choices, Export, Format, Note};
use urdd_robot::Robot;
use urdd_xml::{Document, Node};

use testkit::robots::{made, made_of, our_robots};

fn sdf(robot: &Robot, floating_base: bool) -> Export {
    let options = Choices { floating_base, ..Choices::default() };
    export(robot, Format::Sdf, &options).expect("an export")
}

fn child<'a>(node: Node<'a, 'a>, tag: &str) -> Option<Node<'a, 'a>> {
    node.children().find(|child| child.has_tag_name(tag))
}

fn text<'a>(node: Node<'a, 'a>, tag: &str) -> Option<&'a str> {
    child(node, tag).and_then(|child| child.text())
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|word| word.parse().expect("a number")).collect()
}

/// The poses of links and joints in the model with all joints at 0 (SDF 1.9, pose frame semantics).
fn poses(document: &Document) -> HashMap<String, Isometry3<f64>> {
    let model = document.descendants().find(|node| node.has_tag_name("model")).expect("a model");
    let mut open: Vec<Node> = model
        .children()
        .filter(|node| node.has_tag_name("link") || node.has_tag_name("joint"))
        .filter(|node| node.attribute("name") != Some("world_fixed"))
        .collect();
    let mut poses = HashMap::from([("__model__".to_owned(), Isometry3::identity())]);
    while !open.is_empty() {
        let before = open.len();
        open.retain(|node| {
            let pose = child(*node, "pose");
            let frame = pose.and_then(|pose| pose.attribute("relative_to")).unwrap_or("__model__");
            let Some(frame) = poses.get(frame).copied() else {
                return true;
            };
            let own = pose.and_then(|pose| pose.text()).map_or_else(|| vec![0.0; 6], numbers);
            let rotation = UnitQuaternion::from_euler_angles(own[3], own[4], own[5]);
            let own = Isometry3::from_parts(Translation3::new(own[0], own[1], own[2]), rotation);
            poses.insert(node.attribute("name").expect("a name").to_owned(), frame * own);
            false
        });
        assert!(open.len() < before, "frames in a circle: {open:?}");
    }
    poses
}

/// Poses with joints at 0, and masses, of all of our robots.
#[test]
fn links_are_where_the_urdd_has_them() {
    let mut compared = 0;
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let made = sdf(&robot, false);
        let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
        let poses = poses(&document);
        let space = robot.configurations().expect("bounds");
        // The file has each joint at 0, also where a mimic has an offset.
        let description = robot.description().expect("a description");
        let mut mimics = description.joints.iter().filter_map(|joint| joint.mimic.as_ref());
        if mimics.any(|mimic| mimic.offset.unwrap_or(0.0) != 0.0) {
            continue;
        }
        let expected = robot.link_poses(&vec![0.0; space.num_dofs()]).expect("poses");
        for (link, pose) in robot.link_names().expect("names").iter().zip(expected) {
            let Some(found) = poses.get(link) else {
                assert_eq!(link, "world", "{name}");
                continue;
            };
            let apart = pose.inverse() * found;
            assert!(
                apart.translation.vector.norm() < 1e-9 && apart.rotation.angle() < 1e-9,
                "{name} {link}"
            );
            compared += 1;
        }
        let mass = |node: Node| text(child(node, "inertial")?, "mass")?.parse::<f64>().ok();
        let links = document.descendants().filter(|node| node.has_tag_name("link"));
        let total: f64 = links.filter_map(mass).filter(|mass| *mass != 1e-6).sum();
        let masses = description
            .links
            .iter()
            .filter_map(|link| Some(link.inertial.as_ref()?.mass.as_ref()?.value));
        let expected: f64 = masses.filter(|mass| *mass > 0.0).sum();
        assert!((total - expected).abs() < 1e-9 * expected.max(1.0), "{name}: {total} {expected}");
    }
    assert!(compared > 40, "{compared}");
}

const URDF: &str = r#"<robot name="r"><link name="base"><inertial><mass value="2"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="5"/></inertial></link><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="j" type="revolute"><parent link="base"/><child link="a"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><axis xyz="0 2 0"/>
<limit lower="-1" upper="0.5" effort="7" velocity="3"/><dynamics damping="0.1" friction="0.2"/></joint>
<joint name="k" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="0" upper="1" effort="1" velocity="1"/>
<mimic joint="j" multiplier="-2" offset="0.25"/></joint>
<joint name="p" type="planar"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/></joint>
<joint name="f" type="floating"><parent link="c"/><child link="d"/></joint></robot>"#;

#[test]
fn joints_have_limits_dynamics_and_mimics() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    let made = sdf(&robot, false);
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    assert_eq!(document.root_element().attribute("version"), Some("1.11"), "mimics came with it");
    let joint = |name: &str| {
        let mut joints = document.descendants().filter(|node| node.has_tag_name("joint"));
        joints.find(|node| node.attribute("name") == Some(name)).expect("a joint")
    };
    let axis = child(joint("j"), "axis").expect("an axis");
    assert_eq!(text(axis, "xyz"), Some("0 1 0"));
    let of = |tag: &str, key: &str| child(axis, tag).and_then(|of| text(of, key));
    assert_eq!([of("limit", "lower"), of("limit", "upper")], [Some("-1"), Some("0.5")]);
    assert_eq!([of("limit", "effort"), of("limit", "velocity")], [Some("7"), Some("3")]);
    assert_eq!([of("dynamics", "damping"), of("dynamics", "friction")], [Some("0.1"), Some("0.2")]);
    let mimic = child(joint("k"), "axis").and_then(|axis| child(axis, "mimic")).expect("a mimic");
    assert_eq!(mimic.attribute("joint"), Some("j"));
    assert_eq!([text(mimic, "multiplier"), text(mimic, "offset")], [Some("-2"), Some("0.25")]);
    // Chains from parent to child.
    let chain = |names: &[&str]| -> Vec<[String; 3]> {
        let of = |name: &&str| {
            let joint = joint(name);
            let kind = joint.attribute("type").expect("a type");
            [kind, text(joint, "parent").expect("a parent"), text(joint, "child").expect("a child")]
                .map(str::to_owned)
        };
        names.iter().map(of).collect()
    };
    let planar = chain(&["p/trans_x", "p/trans_y", "p/rot"]);
    assert_eq!(planar[0], ["prismatic", "b", "p/trans_x_link"]);
    assert_eq!(planar[2], ["continuous", "p/trans_y_link", "c"]);
    let floating = chain(&["f/trans_x", "f/trans_y", "f/trans_z", "f"]);
    assert_eq!(floating[0], ["prismatic", "c", "f/trans_x_link"]);
    assert_eq!(floating[3], ["ball", "f/trans_z_link", "d"]);
    assert_eq!(chain(&["world_fixed"])[0], ["fixed", "world", "base"]);
    // Moments that no body has, and links without mass, are said.
    let links = |wanted: &str| {
        made.notes.iter().find_map(|note| match note {
            Note::Links { links, what } if what.contains(wanted) => Some(links.clone()),
            _ => None,
        })
    };
    assert_eq!(links("moments of inertia"), Some(vec!["base".to_owned()]));
    assert_eq!(links("no mass"), Some(["a", "b", "c", "d"].map(str::to_owned).to_vec()));
    let base =
        document.descendants().find(|node| node.has_tag_name("inertia")).expect("an inertia");
    assert_eq!(text(base, "ixx").expect("a number").parse::<f64>(), Ok(7.0 / 3.0));
    assert!(!sdf(&robot, true).text.contains("world_fixed"));
}

/// A joint may be called as a part of a planar joint would be: only what moves a link places it.
#[test]
fn a_joint_named_like_a_part_of_another_changes_nothing() {
    let urdf = r#"<robot name="r"><link name="base"/><link name="a"/><link name="b"/>
<joint name="j" type="revolute"><parent link="base"/><child link="a"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="j/rot" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 2 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;
    let (_folder, path) = made_of(urdf);
    let robot = Robot::open(path).expect("a robot");
    let made = sdf(&robot, false);
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    let poses = poses(&document);
    let at = |link: &str| poses[link].translation.vector;
    assert_eq!((at("a").x, at("a").y), (1.0, 0.0));
    assert_eq!((at("b").x, at("b").y), (1.0, 2.0));
}
