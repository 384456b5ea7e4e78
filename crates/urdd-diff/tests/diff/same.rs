//! Robots that mean the same: no difference.

use std::fmt::Write;

use urdd_xml::Node;

use super::by_rules::place;
use super::{differences, open, places};
use testkit::repository;
use testkit::robots::{made, our_robots};
use testkit::trials::sample;
use testkit::workshop::Workshop;
use urdd_diff::compare;
use urdd_geometry::read::read;
use urdd_geometry::write;

/// A text as XML between single quotes.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('\'', "&apos;")
}

/// Writes an element in another form: attributes in reverse order, numbers spelled otherwise, no white space, comments.
fn respelled(node: Node, out: &mut String) {
    let tag = node.tag_name().name();
    write!(out, "<!-- {tag} --><{tag}").unwrap();
    let attributes: Vec<_> = node.attributes().collect();
    for attribute in attributes.into_iter().rev() {
        let words: Vec<&str> = attribute.value().split_whitespace().collect();
        let numbers: Option<Vec<f64>> = words.iter().map(|word| word.parse().ok()).collect();
        // Only the reader of an element knows that it is a number.
        let is_known = place(node, attribute.name()).is_some() && attribute.name() != "version";
        let value = match numbers.filter(|it| !it.is_empty() && is_known) {
            None => escaped(attribute.value()),
            Some(numbers) => {
                let words: Vec<String> = numbers.iter().map(|it| format!("{it:e}")).collect();
                words.join("   ")
            }
        };
        write!(out, "\n\t{} = '{value}'", attribute.name()).unwrap();
    }
    out.push('>');
    for child in node.children() {
        match child.text().filter(|_| child.is_text()) {
            Some(text) => write!(out, " {} ", escaped(text.trim())).unwrap(),
            None if child.is_element() => respelled(child, out),
            None => {}
        }
    }
    write!(out, "</{tag}>").unwrap();
}

#[test]
fn another_spelling_makes_no_difference() {
    let shop = Workshop::new();
    for (name, _) in our_robots() {
        let text = shop.text(&name);
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).unwrap();
        let mut other = String::from("<?xml version='1.0'?>\n");
        respelled(document.root_element(), &mut other);
        assert_ne!(other, text);
        let after = shop.write("other.urdf", &other);
        let report = differences(&shop.path(&format!("{name}.urdf")), &after);
        assert!(report.same, "{name}: {:?}", places(&report));
        assert_eq!(report.notes, Vec::<String>::new(), "{name}");
    }
}

/// Of lengths, masses and limits alike, in the unit of each. What is farther is named.
#[test]
fn numbers_within_the_tolerance_are_equal() {
    let shop = Workshop::new();
    let robot = |name: &str, by: f64| {
        let (mass, z, upper) = (1.0 + by, 1.0 + by, 1.0 + by);
        let text = format!(
            "<robot name='r'><link name='a'><inertial><mass value='{mass}'/></inertial></link><link name='b'/>\
             <joint name='j' type='revolute'><parent link='a'/><child link='b'/><origin xyz='0 0 {z}'/>\
             <limit lower='-1' upper='{upper}' effort='1' velocity='1'/></joint></robot>"
        );
        open(&shop.write(name, &text))
    };
    // A power of two, so that the differences are exact.
    let step = f64::exp2(-20.0);
    let (before, after) = (robot("a.urdf", 0.0), robot("b.urdf", step));
    let named = ["joints/j/limit.upper", "joints/j/origin.xyz", "links/a/inertial.mass"];
    for (tolerance, expected) in [(0.0, &named[..]), (step / 2.0, &named), (step, &[])] {
        let report = compare(&before, &after, tolerance).unwrap();
        let mut found = places(&report);
        found.sort();
        assert_eq!(found, expected, "{tolerance}");
        assert_eq!(report.poses.is_none(), expected.is_empty());
    }
}

#[test]
fn the_order_of_links_is_a_note_and_that_of_joints_moves_dofs() {
    let shop = Workshop::new();
    let text = shop.text("six_axis_arm");
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).unwrap();
    let write = |tags: [&str; 2], name: &str| {
        let mut other = String::from("<robot name='six_axis_arm'>");
        for tag in tags {
            let robot = document.root_element();
            let mut parts: Vec<_> = robot.children().filter(Node::is_element).collect();
            if tag.starts_with('-') {
                parts.reverse();
            }
            for part in parts {
                let is_joint = part.has_tag_name("joint");
                if is_joint == (tag.trim_start_matches('-') == "joint") {
                    other.push_str(&text[part.range()]);
                }
            }
        }
        shop.write(name, &(other + "</robot>"))
    };
    let before = shop.path("six_axis_arm.urdf");
    let report = differences(&before, &write(["joint", "-other"], "links.urdf"));
    assert_eq!(places(&report), Vec::<String>::new());
    assert!(report.same && report.notes.len() == 1, "{:?}", report.notes);
    let report = differences(&before, &write(["other", "-joint"], "joints.urdf"));
    let moved = places(&report);
    assert!(moved.iter().all(|it| it.starts_with("dofs/") && it.ends_with("/index")), "{moved:?}");
    assert_eq!(moved.len(), 6, "{moved:?}");
    assert!(!report.same);
}

#[test]
fn the_format_of_a_mesh_makes_no_difference_and_a_vertex_does() {
    let shop = Workshop::new();
    let name = "meshes/welding_arm/UPPER_ARM.STL";
    let bytes = std::fs::read(shop.path(name)).unwrap();
    let scene = read(&bytes, name, &mut |_| None).unwrap();
    let mut mesh = scene.parts[0].mesh.clone();
    mesh.weld();
    let before = open(&shop.path("welding_arm.urdf"));
    let text = shop.text("welding_arm");
    for end in ["obj", "glb"] {
        let other = format!("meshes/welding_arm/upper.{end}");
        let bytes = match end {
            "obj" => write::obj(&[mesh.clone().into()]).unwrap(),
            _ => write::glb(&[mesh.clone().into()]).unwrap(),
        };
        std::fs::write(shop.path(&other), bytes).unwrap();
        let text = text.replace("meshes/welding_arm/UPPER_ARM.STL", &other);
        let report = compare(&before, &open(&shop.write("other.urdf", &text)), 0.0).unwrap();
        // glTF is y-up: it is turned when it is read, which is another mesh.
        let expected = if end == "obj" { 0 } else { 2 };
        assert_eq!(places(&report).len(), expected, "{end}: {:?}", places(&report));
    }
    mesh.vertices[0][0] += 1e-3;
    std::fs::write(
        shop.path("meshes/welding_arm/moved.obj"),
        write::obj(&[mesh.clone().into()]).unwrap(),
    )
    .unwrap();
    let text = text.replace("UPPER_ARM.STL", "moved.obj");
    let report = compare(&before, &open(&shop.write("other.urdf", &text)), 0.0).unwrap();
    let expected = ["visual", "collision"].map(|kind| format!("links/upper_arm/{kind}[0].mesh"));
    assert_eq!(places(&report), expected);
}

#[test]
fn a_urdf_and_the_urdd_made_of_it_mean_the_same() {
    for (name, urdf) in sample(our_robots(), 3) {
        let (_folder, urdd) = made(&urdf);
        for (a, b) in [(&urdf, &urdd), (&urdd, &urdf), (&urdd, &urdd), (&urdf, &urdf)] {
            let report = differences(a, b);
            assert!(report.same, "{name}: {:?}", places(&report));
        }
    }
}

#[test]
fn the_example_urdds_differ_as_is_known() {
    let folder = repository().join("examples/urdds");
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|it| it.unwrap().path()).collect();
    names.retain(|path| path.is_dir());
    names.sort();
    assert_eq!(names.len(), 2);
    assert!(differences(&names[0], &names[0]).same);
    assert!(!differences(&names[0], &names[1]).same);
}
