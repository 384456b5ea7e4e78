//! USD of robots that are hard to write.

use testkit::usda::{Value, parsed};
use urdd_export::{Choices, ExportError, Format};

use crate::made::{export, exported, robot, urdf};
use crate::usd::Read;

pub fn link(name: &str, inertial: &str) -> String {
    format!(
        "<link name=\"{name}\">{inertial}<visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual></link>"
    )
}

pub fn joint(name: &str, kind: &str, parent: &str, child: &str, more: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{more}</joint>"
    )
}

pub const LIMIT: &str =
    "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"5\" velocity=\"2\"/>";

#[test]
fn names_that_usd_cannot_have_are_mended_and_shown() {
    let links = ["a-b", "a_b", "a b", "1", "é", "Joints"];
    let mut parts: String = links.iter().map(|name| link(name, "")).collect();
    for (k, child) in links.iter().enumerate().skip(1) {
        parts += &joint(&format!("{k}.j"), "revolute", links[k - 1], child, LIMIT);
    }
    let (_folder, robot) = robot(&urdf(&parts));
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    let names: Vec<[&str; 2]> =
        read.links().iter().map(|prim| [prim.name(), prim.shown()]).collect();
    // The link that has a name of USD keeps it.
    let expected = [
        ["a_b_2", "a-b"],
        ["a_b", "a_b"],
        ["a_b_3", "a b"],
        ["_1", "1"],
        ["_", "é"],
        ["Joints", "Joints"],
    ];
    assert_eq!(names, expected);
    assert_eq!(read.joint("1.j").name(), "_1_j");
    assert_eq!(read.joint("1.j").path, "/r/Joints_2/_1_j");
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.contains("`a-b`, `a b`, `1`, `é`")), "{notes:?}");
}

#[test]
fn three_hundred_links_are_there() {
    let mut parts = link("l0", "");
    for k in 1..300 {
        parts += &format!("<link name=\"l{k}\"/>");
        parts +=
            &joint(&format!("j{k}"), "revolute", &format!("l{}", k - 1), &format!("l{k}"), LIMIT);
    }
    let (_folder, robot) = robot(&urdf(&parts));
    let read = Read::new(&exported(&robot, Format::Usd).text);
    assert_eq!((read.links().len(), read.joints().len()), (300, 300));
}

#[test]
fn a_robot_without_shapes_and_masses_is_written_with_notes() {
    let parts =
        "<link name=\"a\"/><link name=\"b\"/>".to_owned() + &joint("j", "continuous", "a", "b", "");
    let (_folder, robot) = robot(&urdf(&parts));
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    for link in read.links() {
        assert_eq!(link.numbers("physics:mass"), [1e-6]);
        assert_eq!(link.numbers("physics:diagonalInertia"), [1e-9; 3]);
        assert!(link.children.is_empty());
    }
    assert!(!read.joint("j").properties.contains_key("physics:lowerLimit"));
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.starts_with("links `a`, `b` have no mass")), "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("no collision geometry")), "{notes:?}");
}

#[test]
fn inertias_that_no_body_has_are_said() {
    let inertial = |mass: &str, moments: [f64; 3]| {
        let [x, y, z] = moments;
        format!(
            "<inertial><mass value=\"{mass}\"/><inertia ixx=\"{x}\" ixy=\"0\" ixz=\"0\" iyy=\"{y}\" iyz=\"0\" izz=\"{z}\"/></inertial>"
        )
    };
    let cases = [
        ("point", "2", [0.0; 3], "a moment of inertia of 0"),
        ("rod", "2", [0.0, 0.5, 0.5], "a moment of inertia of 0"),
        ("wide", "2", [0.1, 0.1, 0.5], "more than the other two together"),
        ("negative", "2", [-0.1, 0.1, 0.1], "a negative principal moment"),
        ("light", "-2", [0.1, 0.1, 0.1], "its mass is negative"),
        ("ball", "2", [0.25; 3], ""),
    ];
    let mut parts = link("base", &inertial("1", [1.0; 3]));
    for (name, mass, moments, _) in &cases {
        parts += &link(name, &inertial(mass, *moments));
        parts += &joint(&format!("to_{name}"), "revolute", "base", name, LIMIT);
    }
    let (_folder, robot) = robot(&urdf(&parts));
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    for (name, _, _, said) in &cases {
        let prim = read.links().into_iter().find(|link| link.name() == *name).expect("a link");
        let moments = prim.numbers("physics:diagonalInertia");
        assert!(moments.iter().all(|moment| *moment >= 1e-9), "{name}: {moments:?}");
        assert!(prim.numbers("physics:mass")[0] > 0.0);
        let notes = made.notes.iter().map(ToString::to_string);
        let is_about = |note: &String| note.contains(&format!("`{name}`"));
        let notes = notes.filter(|note| !note.contains("no collision geometry"));
        let about: Vec<String> = notes.filter(is_about).collect();
        // Once, and by what is wrong.
        assert_eq!(about.len(), usize::from(!said.is_empty()), "{name}: {about:?}");
        assert!(about.iter().all(|note| note.contains(said)), "{name}: {about:?}");
    }
}

#[test]
fn joints_that_cannot_move_are_fixed_where_they_are_held() {
    let held =
        "<axis xyz=\"0 0 1\"/><limit lower=\"0.5\" upper=\"0.5\" effort=\"1\" velocity=\"1\"/>";
    let follows = format!("{LIMIT}<mimic joint=\"held\" multiplier=\"2\" offset=\"0.25\"/>");
    let crossed =
        "<axis xyz=\"0 0 1\"/><limit lower=\"1\" upper=\"-1\" effort=\"1\" velocity=\"1\"/>";
    let parts: String = ["a", "b", "c", "d"].map(|name| link(name, "")).concat()
        + &joint("held", "revolute", "a", "b", held)
        + &joint("follows", "prismatic", "b", "c", &follows)
        + &joint("crossed", "revolute", "c", "d", crossed);
    let (_folder, robot) = robot(&urdf(&parts));
    let read = Read::new(&exported(&robot, Format::Usd).text);
    let held = read.joint("held");
    assert_eq!(held.kind, "PhysicsFixedJoint");
    let [w, z] = [0.25f64.cos(), 0.25f64.sin()];
    let turned = held.numbers("physics:localRot0");
    assert!((turned[0] - w).abs() < 1e-7 && (turned[3] - z).abs() < 1e-7, "{turned:?}");
    let follows = read.joint("follows");
    assert_eq!(follows.kind, "PhysicsFixedJoint");
    assert_eq!(follows.numbers("physics:localPos0"), [0.0, 0.0, 1.25]);
    // Crossed limits would be a locked joint.
    assert!(!read.joint("crossed").properties.contains_key("physics:lowerLimit"));
}

#[test]
fn binary_files_are_refused_with_what_to_do() {
    let (_folder, robot) = robot(&urdf(&link("a", "")));
    for (file, advice) in [("r.usdc", ".Export("), ("r.usdz", "CreateNewUsdzPackage(")] {
        let options = Choices { output: Some(file.into()), ..Choices::default() };
        let error = export(&robot, Format::Usd, &options).expect_err("refused");
        assert!(matches!(error, ExportError::Binary { .. }));
        assert!(error.to_string().contains(advice), "{error}");
    }
}

#[test]
fn what_usd_has_no_place_for_is_custom_data() {
    let element = "<gazebo reference=\"a\"><note>a \"quote\" \\ and ü</note></gazebo>";
    let (_folder, robot) = robot(&urdf(&(link("a", "") + element)));
    let read = Read::new(&exported(&robot, Format::Usd).text);
    let Value::Dictionary(data) = &read.root.metadata["customData"] else { panic!("data") };
    let Value::Dictionary(data) = &data["urdd"] else { panic!("data") };
    assert_eq!(data["elements"].list()[0].text(), element);
}

/// A mesh of so many triangles, which is long.
pub fn grid(count: usize) -> String {
    let mut text = String::new();
    for k in 0..=count {
        text += &format!("v {k}.125 0 0\nv {k}.125 1 {}\n", k % 2);
    }
    for k in 0..count {
        let at = 2 * k + 1;
        text += &format!("f {} {} {}\nf {} {} {}\n", at, at + 1, at + 2, at + 1, at + 3, at + 2);
    }
    text
}

#[test]
fn long_and_repeated_visuals_are_files_that_links_share() {
    let folder = testkit::temporary::folder();
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    write("long.obj", &grid(2000));
    write("short.obj", &grid(3));
    write("once.obj", &grid(4));
    let visual = |mesh: &str| {
        format!(
            "<visual><geometry><mesh filename=\"{mesh}\"/></geometry><material name=\"m{mesh}\"><color rgba=\"0.5 0.02 1 0.25\"/></material></visual>"
        )
    };
    let mut parts = String::new();
    for (k, mesh) in ["long.obj", "short.obj", "short.obj", "once.obj"].iter().enumerate() {
        parts += &format!("<link name=\"l{k}\">{}</link>", visual(mesh));
        if k > 0 {
            parts += &joint(&format!("j{k}"), "fixed", "l0", &format!("l{k}"), "");
        }
    }
    write("r.urdf", &urdf(&parts));
    let target = folder.path().join("r");
    urdd_generate::generate(&folder.path().join("r.urdf"), &target, &Default::default(), &())
        .expect("a URDD");
    let robot = urdd_robot::Robot::open(&target).expect("a robot");
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    let payloads: Vec<Option<&str>> = read
        .links()
        .iter()
        .map(|link| link.child("visuals").metadata.get("payload").map(Value::text))
        .collect();
    let expected = [
        Some("./meshes/l0_visuals.usda"),
        Some("./meshes/l1_visuals.usda"),
        Some("./meshes/l1_visuals.usda"),
        None,
    ];
    assert_eq!(payloads, expected);
    let (_, bytes) =
        made.files.iter().find(|(path, _)| path == "meshes/l0_visuals.usda").expect("a file");
    let file = parsed(std::str::from_utf8(bytes).expect("text"));
    let mesh = file.children[0].child("mesh");
    assert_eq!(mesh.numbers("faceVertexIndices").len(), 3 * 4000);
    // The colour is linear: sRGB's curve, by its definition.
    let shader = file.children[0].child("Looks").children[0].child("surface").clone();
    let red = ((0.5f64 + 0.055) / 1.055).powf(2.4);
    for (found, expected) in
        shader.numbers("inputs:diffuseColor").iter().zip([red, 0.02 / 12.92, 1.0])
    {
        assert!((found - expected).abs() < 1e-7, "{found} {expected}");
    }
    assert_eq!(shader.numbers("inputs:opacity"), [0.25]);
    assert_eq!(mesh.get("material:binding").text(), "/visuals/Looks/colour_0");
    // A mesh in the file itself has the material of the robot.
    let own = read.links()[3].child("visuals").child("mesh");
    assert_eq!(own.get("material:binding").text(), "/r/Looks/colour_0");
}
