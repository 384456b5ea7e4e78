//! Robots that use the names that exports would invent. Names stay apart, and the robot keeps its own.

use std::collections::BTreeSet;

use crate::made::export;
use urdd_export::{Choices, Format, Note};
use urdd_xml::{Document, Node};

use crate::made::{robot, urdf};

const BOX: &str = "<visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual>";

/// A chain of boxes with these names of links and joints, and types of joints.
fn chain(links: &[&str], joints: &[(&str, &str)]) -> String {
    let mut parts = String::new();
    for link in links {
        parts += &format!("<link name=\"{link}\">{BOX}</link>");
    }
    for ((name, kind), ends) in joints.iter().zip(links.windows(2)) {
        parts += &format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{}\"/><child link=\"{}\"/><axis xyz=\"0 0 1\"/>\
             <limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>",
            ends[0], ends[1]
        );
    }
    urdf(&parts)
}

fn unique<'a>(what: &str, names: impl Iterator<Item = &'a str>) {
    let mut seen = BTreeSet::new();
    for name in names {
        assert!(seen.insert(name.to_owned()), "{what}: two are called {name:?}");
    }
}

fn named<'a>(nodes: impl Iterator<Item = Node<'a, 'a>>) -> impl Iterator<Item = &'a str> {
    nodes.filter_map(|node| node.attribute("name"))
}

/// In SDF, all children of an element have names of their own.
fn check_sdf(document: &Document) {
    for node in document.descendants().filter(Node::is_element) {
        unique(node.tag_name().name(), named(node.children()));
    }
}

/// In other formats, all elements of a kind.
fn check_kinds(document: &Document) {
    const KINDS: [&[&str]; 9] = [
        &["body"],
        &["link"],
        &["joint", "freejoint", "virtual_joint"],
        &["geom"],
        &["site"],
        &["mesh"],
        &["gyro", "accelerometer"],
        &["drake:collision_filter_group", "collision_filter_group"],
        &["transmission"],
    ];
    for kind in KINDS {
        let nodes = document.descendants().filter(|node| {
            // What names another is not called so.
            let is_own = node.parent().is_none_or(|parent| {
                !["equality", "actuator", "group", "transmission"]
                    .contains(&parent.tag_name().name())
            });
            is_own && kind.contains(&node.tag_name().name())
        });
        unique(kind[0], named(nodes));
    }
}

#[test]
fn invented_names_stay_apart() {
    /// Names of links; names and types of joints.
    type Case<'a> = (&'a [&'a str], &'a [(&'a str, &'a str)]);
    let cases: [Case; 6] = [
        // Industrial arms.
        (&["link_0", "link_1", "link_2"], &[("joint_1", "revolute"), ("joint_2", "revolute")]),
        (
            &["base", "j/trans_x", "c", "d"],
            &[("j", "floating"), ("j/rot", "planar"), ("j/trans_y", "revolute")],
        ),
        (
            &["j/trans_x_link", "world_fixed", "j/trans_x_link_2", "floating_base"],
            &[("floating_base", "revolute"), ("j", "planar"), ("world_fixed", "revolute")],
        ),
        // A link and a joint of one name, whose replacement is taken as well.
        (
            &["a", "b", "b_joint", "c"],
            &[("b", "revolute"), ("b_joint_2", "planar"), ("b_joint", "revolute")],
        ),
        (&["a", "visual_0", "piece_0"], &[("virtual_joint", "revolute"), ("piece_0", "revolute")]),
        (
            &["world", "collision", "attached_object"],
            &[("attach_joint", "revolute"), ("visual", "revolute")],
        ),
    ];
    for (links, joints) in cases {
        let (_folder, robot) = robot(&chain(links, joints));
        for floating_base in [false, true] {
            for format in [Format::Mjcf, Format::Sdf, Format::Drake, Format::Urdf, Format::Moveit] {
                let options = Choices {
                    floating_base: floating_base && [Format::Mjcf, Format::Sdf].contains(&format),
                    sensors: format == Format::Mjcf,
                    ..Choices::default()
                };
                let made = export(&robot, format, &options).expect("an export");
                let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("XML");
                match format {
                    Format::Sdf => check_sdf(&document),
                    _ => check_kinds(&document),
                }
                let of = |tag: &str| -> BTreeSet<&str> {
                    named(document.descendants().filter(|node| node.has_tag_name(tag))).collect()
                };
                let mut members =
                    document.descendants().filter(|node| node.tag_name().name() == "member");
                let is_world = |node: Node| node.attribute("link").or(node.text()) == Some("world");
                assert!(!members.any(is_world), "{format:?}: Drake finds no such body");
                let body = if format == Format::Mjcf { "body" } else { "link" };
                for link in links {
                    let is_own = *link == "world" && [Format::Mjcf, Format::Sdf].contains(&format);
                    assert!(
                        is_own || format == Format::Moveit || of(body).contains(link),
                        "{format:?} {link}"
                    );
                }
                for (joint, kind) in joints {
                    let is_renamed = format == Format::Sdf && links.contains(joint);
                    if *kind == "revolute" && format != Format::Moveit {
                        assert_eq!(of("joint").contains(joint), !is_renamed, "{format:?} {joint}");
                    }
                    let note = |note: &Note| matches!(note, Note::Renamed { joint: of, .. } if of == joint);
                    assert_eq!(made.notes.iter().any(note), is_renamed, "{format:?} {joint}");
                }
            }
        }
    }
}

/// What refers to a renamed joint follows it.
#[test]
fn a_joint_that_is_called_as_a_link_is_renamed_in_sdf() {
    let parts = format!(
        "<link name=\"a\">{BOX}</link><link name=\"b\"/><link name=\"c\"/>\
         <joint name=\"b\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/></joint>\
         <joint name=\"k\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/><axis xyz=\"0 0 1\"/><mimic joint=\"b\"/></joint>"
    );
    let (_folder, robot) = robot(&urdf(&parts));
    let made = export(&robot, Format::Sdf, &Choices::default()).expect("an export");
    assert!(made.text.contains("<joint name=\"b_joint\" type=\"continuous\">"), "{}", made.text);
    assert!(made.text.contains("<mimic joint=\"b_joint\">"));
    assert!(made.text.contains("<pose relative_to=\"b_joint\">0 0 0 0 0 0</pose>"));
    let report: serde_json::Value = serde_json::from_str(&made.report).expect("JSON");
    let otherwise = report["otherwise"].as_array().expect("a list");
    let is_said = |entry: &serde_json::Value| entry["what"] == "joints with the name of a link";
    assert!(otherwise.iter().any(|entry| is_said(entry) && entry["count"] == 1), "{report}");
    let note = "joint `b` is called `b_joint`";
    assert!(made.text.contains(note) && made.report.contains(note));
}
