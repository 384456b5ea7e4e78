//! `fit`: a primitive in the place of each convex mesh that it encloses tightly.

use urdd_export::{Choices, Export, Fit, Format, Note};
use urdd_robot::Robot;

use crate::made::{export, robot, urdf};

fn fitted(robot: &Robot, format: Format, fit: Fit) -> Export {
    export(robot, format, &Choices { fit: Some(fit), ..Choices::default() }).expect("an export")
}

fn link(name: &str, elements: &[(&str, &str)]) -> String {
    let shape = |(pose, geometry): &(&str, &str)| {
        format!("<collision><origin {pose}/><geometry>{geometry}</geometry></collision>")
    };
    format!("<link name='{name}'>{}</link>", elements.iter().map(shape).collect::<String>())
}

fn fixed(parent: &str, child: &str) -> String {
    format!(
        "<joint name='{child}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>"
    )
}

const CYLINDER: &str = "<cylinder radius='0.1' length='0.5'/>";
const SPHERE: &str = "<sphere radius='0.25'/>";

/// A box, a cylinder, a sphere, and a capsule as URDF has it: what `generate` made of them are meshes of triangles.
fn primitives() -> (tempfile::TempDir, Robot) {
    let box_ = [("xyz='0.3 0 0' rpy='0.1 0.2 0.3'", "<box size='0.2 0.4 0.6'/>")];
    let cylinder = [("xyz='0 0 1'", CYLINDER)];
    let sphere = [("xyz='0 0 0'", SPHERE)];
    let names = ["b", "c", "s"];
    let links: Vec<String> =
        names.iter().zip([&box_, &cylinder, &sphere]).map(|(name, of)| link(name, of)).collect();
    let joints = [fixed("b", "c"), fixed("b", "s")].concat();
    robot(&urdf(&(links.concat() + &joints)))
}

/// `type`, `size` and `pos` of each collision geom.
fn geoms(text: &str) -> Vec<(String, Vec<f64>, Vec<f64>)> {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
    let numbers = |text: Option<&str>| {
        text.unwrap_or("0 0 0").split(' ').map(|word| word.parse().expect("a number")).collect()
    };
    let is_collision = |node: &urdd_xml::Node| {
        node.has_tag_name("geom") && node.attribute("class") == Some("collision")
    };
    let all = document.descendants().filter(is_collision);
    let of = |node: urdd_xml::Node| {
        let kind = node.attribute("type").unwrap_or("mesh").to_owned();
        (kind, numbers(node.attribute("size")), numbers(node.attribute("pos")))
    };
    all.map(of).collect()
}

#[test]
fn primitives_that_were_made_meshes_are_primitives_again() {
    let (_folder, robot) = primitives();
    let made = fitted(&robot, Format::Mjcf, Fit::default());
    let expected = [
        ("box", vec![0.1, 0.2, 0.3], [0.3, 0.0, 0.0]),
        ("cylinder", vec![0.1, 0.25], [0.0, 0.0, 1.0]),
        ("sphere", vec![0.25], [0.0; 3]),
    ];
    let found = geoms(&made.text);
    assert_eq!(found.len(), 3, "{}", made.text);
    for ((kind, sizes, at), (known, known_sizes, place)) in found.iter().zip(&expected) {
        assert_eq!(kind, known);
        let mut sizes = sizes.clone();
        if *known == "box" {
            // Its axes may be named otherwise.
            sizes.sort_by(f64::total_cmp);
        }
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(sizes.len() == known_sizes.len() && near(&sizes, known_sizes), "{sizes:?}");
        assert!(near(at, place), "{at:?}");
    }
    let said = "3 of 3 convex meshes are primitives that enclose them (1 box, 1 cylinder, 1 sphere), each with at \
                most 1.2 times its volume, and at most 0.005 m off it;";
    assert!(made.notes.iter().any(|note| note.to_string().contains(said)), "{:?}", made.notes);
    assert!(made.text.contains(said), "{}", made.text);
    assert!(!made.files.iter().any(|(path, _)| path.contains("piece")), "no mesh");
}

/// Each cost alone keeps the mesh: a prism of 32 sides lacks 0.64 % of its cylinder, and its sides 0.48 % of the radius.
#[test]
fn a_primitive_that_costs_too_much_is_not_taken() {
    let (_folder, robot) = robot(&urdf(&link("c", &[("", CYLINDER)])));
    for (volume, standoff, kind) in [
        (1.0065, 0.01, "cylinder"),
        (1.0064, 0.01, "mesh"),
        (2.0, 0.000_61, "cylinder"),
        (2.0, 0.000_47, "mesh"),
    ] {
        let made = fitted(&robot, Format::Mjcf, Fit::new(volume, standoff).unwrap());
        assert_eq!(geoms(&made.text)[0].0, kind, "{volume}, {standoff}: {}", made.text);
        let count = made.notes.iter().find_map(|note| match note {
            Note::Fitted { counts, of, .. } => Some((counts.total(), *of)),
            _ => None,
        });
        assert_eq!(count, Some((usize::from(kind == "cylinder"), 1)));
        // Where nothing is fitted, the pairs are those of the URDD.
        let said = made.notes.iter().any(|note| note.to_string().contains("judged by these"));
        assert_eq!(said, kind == "cylinder");
    }
}

/// URDF has no capsules: one stays a mesh there, and is one in Drake, SDF, MJCF and USD.
#[test]
fn capsules_are_for_formats_that_have_them() {
    let ends = [
        ("xyz='0 0 0.25'", "<sphere radius='0.1'/>"),
        ("xyz='0 0 -0.25'", "<sphere radius='0.1'/>"),
    ];
    let parts = link("a", &[ends[0], ends[1], ("", CYLINDER)]);
    let (_folder, robot) = robot(&urdf(&parts));
    let hulls = |format| {
        let fit = Some(Fit::default());
        let shapes = urdd_robot::ShapeKind::Hulls.into();
        export(&robot, format, &Choices { shapes, fit, ..Choices::default() }).expect("an export")
    };
    for (format, word) in [
        (Format::Mjcf, "type=\"capsule\""),
        (Format::Drake, "<drake:capsule"),
        (Format::Sdf, "<capsule>"),
        (Format::Usd, "def Capsule"),
    ] {
        let made = hulls(format);
        assert!(made.text.contains(word), "{}", made.text);
    }
    let made = hulls(Format::Urdf);
    assert!(!made.text.contains("capsule"), "{}", made.text);
}

/// A box 0.5 mm beside a cylinder is 5.3 mm from the prism in its place: only the cylinder touches it (SPEC 8.6: 1 mm).
#[test]
fn pairs_are_judged_by_what_is_written() {
    let turn = format!("rpy='0 0 {}'", std::f64::consts::PI / 32.0);
    let cylinder = link("c", &[(&turn, "<cylinder radius='1' length='1'/>")]);
    let cuboid = link("b", &[("xyz='1.1005 0 0'", "<box size='0.2 0.05 0.05'/>")]);
    let parts = cylinder + "<link name='m'/>" + &cuboid + &fixed("c", "m") + &fixed("m", "b");
    let (_folder, robot) = robot(&urdf(&parts));
    let reason = |made: Export| {
        let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
        let pair = document.descendants().find(|node| node.has_tag_name("disable_collisions"));
        pair.and_then(|pair| pair.attribute("reason")).map(ToOwned::to_owned)
    };
    let plain = export(&robot, Format::Srdf, &Choices::default()).expect("an export");
    assert_eq!(reason(plain), None);
    let made = fitted(&robot, Format::Srdf, Fit::new(1.2, 0.01).unwrap());
    assert_eq!(reason(made).as_deref(), Some("Always"));
}

/// Links that become one keep the primitives of each.
#[test]
fn primitives_of_merged_links_are_on_one_body() {
    let (_folder, robot) = primitives();
    let choices = Choices { fit: Some(Fit::default()), merge_fixed: true, ..Choices::default() };
    let made = export(&robot, Format::Mjcf, &choices).expect("an export");
    let kinds: Vec<String> = geoms(&made.text).into_iter().map(|(kind, ..)| kind).collect();
    assert_eq!(kinds, ["box", "cylinder", "sphere"]);
}

#[test]
fn costs_that_are_none_are_refused() {
    for (volume, standoff) in [(0.99, 0.1), (f64::NAN, 0.1), (1.1, -0.1), (1.1, f64::INFINITY)] {
        assert!(Fit::new(volume, standoff).is_err(), "{volume}, {standoff}");
    }
    assert_eq!("1.5, 0.01".parse(), Fit::new(1.5, 0.01));
    for word in ["", "1.2", "1.2,", "a,b", "1.2,0.1,3", "0.5,0.1"] {
        assert!(word.parse::<Fit>().is_err(), "{word}");
    }
}
