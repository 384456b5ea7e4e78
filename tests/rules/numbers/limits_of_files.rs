//! Limits of the URDF, of names, of mesh files as they come, and of schemas of extensions.

use serde_json::json;
use urdd_format::urdf::JointType;
use urdd_validate::code::Code::*;

use super::{Number, Sides, count, number, there, wide};
use crate::dof::star;
use crate::mesh_files::{ALL, entry, read};
use crate::meshes::{HULLS, ORIGINAL, PIECES, PLAIN, boxy, rename, robot_of, text};
use testkit::fixture::{Fixture, URDF};
use testkit::robot::{link, mesh, visual};

/// A base, a revolute joint and a link: five elements or more, three levels.
fn small() -> Fixture {
    Fixture::core(&star(&[("j", JointType::Revolute)]))
}

/// Puts text into `<limit>` of the joint, where other elements say nothing.
fn in_limit(f: &mut Fixture, text: &str) {
    f.urdf_mut(|xml| {
        let start = xml.find("<limit").expect("a limit");
        let end = start + xml[start..].find("/>").expect("its end");
        xml.replace_range(end..end + 2, &format!(">{text}</limit>"));
    });
}

/// As many levels in all: `robot`, `joint` and `limit` are three.
fn levels(f: &mut Fixture, levels: f64) {
    let more = levels as usize - 3;
    in_limit(f, &format!("{}{}", "<a>".repeat(more), "</a>".repeat(more)));
}

/// As many elements in all.
fn elements(f: &mut Fixture, elements: f64) {
    let text = String::from_utf8(f.file(URDF).to_vec()).expect("text");
    let there = text.matches('<').count() - text.matches("</").count() - text.matches("<?").count();
    let there = there - text.matches("<!--").count();
    in_limit(f, &"<a/>".repeat(elements as usize - there));
}

/// As many attributes of one element; one of them declares a namespace.
fn attributes(f: &mut Fixture, attributes: f64) {
    let all: String = (1..attributes as usize).map(|i| format!(" a{i}=\"\"")).collect();
    in_limit(f, &format!("<a xmlns=\"n\"{all}/>"));
}

/// As many prefixes; one of them is declared twice.
fn prefixes(f: &mut Fixture, prefixes: f64) {
    let all: String = (0..prefixes as usize).map(|i| format!("<a xmlns:p{i}=\"n\"/>")).collect();
    in_limit(f, &format!("<a xmlns:p0=\"m\"/>{all}"));
}

/// A URDF of as many bytes: spaces at its end.
fn bytes(f: &mut Fixture, bytes: f64) {
    f.urdf_mut(|xml| {
        let more = bytes as usize - xml.len();
        xml.push_str(&" ".repeat(more));
    });
}

/// Two boxes whose second has a long name; its files are cut at this length.
fn named_to(f: &mut Fixture, length: f64) {
    let name = "n".repeat(length as usize);
    for module in [PLAIN, HULLS, PIECES] {
        for format in ALL {
            let pointer = format!("{}/{format}", entry(module, 1));
            let new = text(f, module, &pointer).replace(&"n".repeat(64), &name);
            if new != text(f, module, &pointer) {
                rename(f, module, &pointer, &new);
            }
        }
    }
}

fn long_name() -> Fixture {
    Fixture::full(&robot_of(vec![boxy("a"), boxy(&"n".repeat(70))]))
}

/// A link that shows a mesh file, and one that shows a box.
fn with_mesh() -> Fixture {
    let mut robot = robot_of(vec![link("a"), boxy("b")]);
    robot.meshes.insert("part.stl".to_owned(), [0.1; 3]);
    robot.link_mut("a").visual.push(visual(None, mesh("part.stl", None)));
    Fixture::full(&robot)
}

/// The mesh file as STL in text, whose first `facet` ends at this byte. Where that is beyond 64 KiB it is read as binary
/// STL, of other triangles.
fn facet_ends_at(f: &mut Fixture, end: f64) {
    let mesh = read(f, PLAIN, 0);
    let mut text = format!("solid {}\n", "a".repeat(end as usize - "solid \nfacet".len()));
    for triangle in &mesh.triangles {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in mesh.corners(*triangle) {
            text.push_str(&format!("vertex {x} {y} {z}\n"));
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid\n");
    let path = f.get(ORIGINAL, "/files/0/path").as_str().expect("a path").to_owned();
    f.put_file(&path, text);
}

/// A schema of as many bytes.
fn schema_of(f: &mut Fixture, bytes: f64) {
    const FOLDER: &str = "x_acme_gripper_module";
    let schema = format!("{{{}}}", " ".repeat(bytes as usize - 2));
    f.put_file(&format!("{FOLDER}/schema.json"), schema);
    f.add_module(FOLDER, json!({}));
}

/// A schema that takes some comparisons on a list of as many numbers.
fn work(f: &mut Fixture, comparisons: f64) {
    const FOLDER: &str = "x_acme_gripper_module";
    // On each of 100 values so many alternatives, of two keywords each.
    let alternatives = (comparisons / 200.0) as usize;
    let alternatives = vec![json!({"minimum": 5}); alternatives];
    let schema = json!({"properties": {"grip": {"items": {"not": {"anyOf": alternatives}}}}});
    f.put_file(&format!("{FOLDER}/schema.json"), schema.to_string());
    f.add_module(FOLDER, json!({ "grip": vec![1; 100] }));
}

pub fn numbers() -> Vec<Number> {
    vec![
        number(
            "urdf-bytes",
            "6.1.8",
            "64 MiB | the file",
            ("64 MiB", 67_108_864.0),
            vec![count(URD011, small, bytes, 67_108_864.0)],
        ),
        number(
            "urdf-levels",
            "6.1.8",
            "256 levels",
            ("256", 256.0),
            vec![count(URD011, small, levels, 256.0)],
        ),
        number(
            "urdf-elements",
            "6.1.8",
            "500,000 elements",
            ("500,000", 500_000.0),
            vec![count(URD011, small, elements, 500_000.0)],
        ),
        number(
            "urdf-attributes",
            "6.1.8",
            "256 attributes",
            ("256", 256.0),
            vec![count(URD011, small, attributes, 256.0)],
        ),
        number(
            "urdf-prefixes",
            "6.1.8",
            "64 prefixes",
            ("64", 64.0),
            vec![count(URD011, small, prefixes, 64.0)],
        ),
        number(
            "slug",
            "7.3",
            "cut to 64 characters",
            ("64", 64.0),
            vec![count(MSH006, long_name, named_to, 64.0)],
        ),
        number(
            "stl-records",
            "7.5",
            "has 84 + 50 n bytes, and n, little-endian, in bytes 80 to 83",
            ("84", 84.0),
            vec![there("MSH016/called-usable", "MSH016/without-a-surface")],
        ),
        number(
            "signatures",
            "7.5",
            "the bytes 1F 8B",
            ("8", 8.0),
            vec![Sides::Elsewhere(
                "eight hexadecimal digits, and no number: crates/urdd-geometry tests them",
            )],
        ),
        number(
            "first-bytes",
            "7.5",
            "or `endsolid` in its first 64 KiB; and",
            ("64 KiB", 65_536.0),
            vec![count(MSH015, with_mesh, facet_ends_at, 65_536.0)],
        ),
        number(
            "first-bytes-of-collada",
            "7.5",
            "has `COLLADA` in its first 64 KiB",
            ("64 KiB", 65_536.0),
            vec![Sides::Elsewhere("the same 64 KiB as of STL; crates/urdd-geometry tests it")],
        ),
        number(
            "first-bytes-of-text",
            "7.5",
            "in its first 64 KiB, no byte below that of a space",
            ("64 KiB", 65_536.0),
            vec![Sides::Elsewhere("the same 64 KiB as of STL; crates/urdd-geometry tests it")],
        ),
        number(
            "stl-header",
            "7.5",
            "is named `.stl` and has 84 bytes or more",
            ("84", 84.0),
            vec![Sides::Elsewhere("with 83 bytes or 84 no triangle is whole: neither is usable")],
        ),
        number(
            "triangles-of-a-file",
            "7.5",
            "more than 20 million triangles",
            ("20", 20.0),
            vec![Sides::Elsewhere(
                "MSH016/collada-of-20-million-triangles is beyond; within, it takes a GB: crates/urdd-geometry tests the limit",
            )],
        ),
        number(
            "thin-for-a-normal",
            "7.6",
            "8 * 2^-23 / 1e-3 of its largest absolute coordinate",
            ("8 * 2^-23", 8.0 * (-23_f64).exp2()),
            vec![Sides::Elsewhere(
                "no case yet: crates/urdd-validate/src/solids/file.rs judges it",
            )],
        ),
        number(
            "corners-of-a-fan",
            "7.8",
            "One of more than 10,000 corners",
            ("10,000", 10_000.0),
            vec![Sides::Elsewhere("crates/urdd-geometry tests the limit")],
        ),
        number(
            "visits-of-nodes",
            "7.5",
            "More than 100,000 visits of nodes, or 200 nodes in one another",
            ("100,000", 100_000.0),
            vec![Sides::Elsewhere("crates/urdd-geometry tests the limits")],
        ),
        number(
            "offset-of-an-input",
            "7.5",
            "a whole number below 1,024",
            ("1,024", 1_024.0),
            vec![Sides::Elsewhere("crates/urdd-geometry tests the limit")],
        ),
        number(
            "collada-limits",
            "13.2",
            "a COLLADA file with more than 256 levels, 4,000,000 nodes (elements, texts, comments and instructions), 256 attributes of one element, 64 prefixes",
            ("256", 256.0),
            vec![Sides::Elsewhere("crates/urdd-xml tests the limits of both kinds of XML")],
        ),
        number(
            "schema-bytes",
            "11.1",
            "at most 1 MiB",
            ("1 MiB", 1_048_576.0),
            vec![count(EXT001, Fixture::toy, schema_of, 1_048_576.0)],
        ),
        number(
            "schema-work",
            "11.1",
            "no more than 1,000,000 comparisons, or 20 for each value",
            ("1,000,000", 1_000_000.0),
            vec![wide(
                EXT001,
                Fixture::toy,
                work,
                1_000_000.0,
                [4_000_000.0, 100_000.0],
                "implementations count otherwise; a tenth is safe",
            )],
        ),
        number(
            "characters-of-a-comparison",
            "11.1",
            "floor(p / 32)",
            ("32", 32.0),
            vec![Sides::Elsewhere("a part of what is counted: the whole has its cases")],
        ),
    ]
}
