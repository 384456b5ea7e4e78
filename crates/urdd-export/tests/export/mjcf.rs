use std::collections::HashMap;

use crate::made::export;
use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use urdd_export::{Choices, Format, Note};
use urdd_kinematics::rotation::from_rotation_vector;
use urdd_robot::{Robot, ShapeKind};
use urdd_xml::{Document, Node};

use testkit::robots::{made, made_of, our_robots};

fn numbers(node: Node, key: &str) -> Option<Vec<f64>> {
    let text = node.attribute(key)?;
    Some(text.split(' ').map(|word| word.parse().expect("a number")).collect())
}

fn pose(node: Node) -> Isometry3<f64> {
    let p = numbers(node, "pos").unwrap_or(vec![0.0; 3]);
    let q = numbers(node, "quat").unwrap_or(vec![1.0, 0.0, 0.0, 0.0]);
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]));
    Isometry3::from_parts(Translation3::new(p[0], p[1], p[2]), rotation)
}

/// MuJoCo's documentation on bodies and joints: the body's pose in its parent, then its joints in order.
fn walk(
    body: Node,
    parent: Isometry3<f64>,
    values: &HashMap<String, Vec<f64>>,
    found: &mut HashMap<String, Isometry3<f64>>,
) {
    let mut frame = parent * pose(body);
    for joint in body.children().filter(|child| child.has_tag_name("joint")) {
        let value = &values[joint.attribute("name").expect("a name")];
        let axis = numbers(joint, "axis").map(|axis| Unit::new_normalize(Vector3::from_vec(axis)));
        frame *= match joint.attribute("type") {
            Some("hinge") => Isometry3::from_parts(
                Translation3::identity(),
                UnitQuaternion::from_axis_angle(&axis.expect("an axis"), value[0]),
            ),
            Some("slide") => {
                Translation3::from(axis.expect("an axis").into_inner() * value[0]).into()
            }
            Some("ball") => Isometry3::from_parts(
                Translation3::identity(),
                from_rotation_vector([value[0], value[1], value[2]]),
            ),
            other => panic!("a joint of type {other:?}"),
        };
    }
    if let Some(name) = body.attribute("name") {
        found.insert(name.to_owned(), frame);
    }
    for child in body.children().filter(|child| child.has_tag_name("body")) {
        walk(child, frame, values, found);
    }
}

/// The positions of MuJoCo's joints: by DOF, three of a rotation for a ball, and mimics by their equality.
fn values(document: &Document, robot: &Robot, q: &[f64]) -> HashMap<String, Vec<f64>> {
    let dofs = robot.dof_names().expect("DOFs");
    let mut values = HashMap::new();
    let joints =
        document.descendants().filter(|n| n.has_tag_name("joint") && n.has_attribute("type"));
    for joint in joints {
        let name = joint.attribute("name").expect("a name");
        let at = |dof: &str| dofs.iter().position(|known| known == dof).map(|dof| q[dof]);
        let value = match joint.attribute("type") {
            Some("ball") => ["rot_x", "rot_y", "rot_z"]
                .iter()
                .map(|part| at(&format!("{name}/{part}")))
                .collect(),
            _ => at(name).map(|value| vec![value]),
        };
        if let Some(value) = value {
            values.insert(name.to_owned(), value);
        }
    }
    let equality: Vec<Node> = document
        .descendants()
        .filter(|n| n.has_tag_name("equality"))
        .flat_map(|n| n.children().filter(Node::is_element))
        .collect();
    // Mimicked joints may be mimics themselves.
    for _ in 0..equality.len() {
        for one in &equality {
            let factors = numbers(*one, "polycoef").expect("five numbers");
            let driver = one.attribute("joint2").map(|driver| values.get(driver).cloned());
            let position = match driver {
                None => Some(factors[0]),
                Some(driver) => driver.map(|driver| factors[0] + factors[1] * driver[0]),
            };
            if let Some(position) = position {
                let name = one.attribute("joint1").expect("a joint");
                values.insert(name.to_owned(), vec![position]);
            }
        }
    }
    values
}

fn assert_moves_alike(robot: &Robot, text: &str, name: &str) {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
    let world = document.descendants().find(|n| n.has_tag_name("worldbody")).expect("a world");
    for k in 0..20 {
        let q = robot.configurations().expect("bounds").random(k);
        let mut found = HashMap::new();
        walk(world, Isometry3::identity(), &values(&document, robot, &q), &mut found);
        let links = robot.link_names().expect("links");
        let expected = robot.link_poses(&q).expect("poses");
        for (link, expected) in links.iter().zip(expected) {
            let got = match link.as_str() {
                "world" => Isometry3::identity(),
                link => found[link],
            };
            let apart = (got.inverse() * expected).to_homogeneous() - nalgebra::Matrix4::identity();
            assert!(apart.abs().max() < 1e-9, "{name}, {link}: {got} for {expected}");
        }
    }
}

#[test]
fn bodies_move_as_links_do() {
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        for shapes in [ShapeKind::Pieces, ShapeKind::Boxes] {
            let options = Choices { shapes: shapes.into(), ..Choices::default() };
            let made = export(&robot, Format::Mjcf, &options).expect("an export");
            assert_moves_alike(&robot, &made.text, &name);
        }
    }
}

#[test]
fn a_root_called_world_is_the_world() {
    let (_folder, path) = made_of(
        r#"<robot name="r"><link name="world"/>
        <link name="arm"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
        <joint name="j" type="revolute"><parent link="world"/><child link="arm"/><axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#,
    );
    let robot = Robot::open(path).expect("a robot");
    let made = export(&robot, Format::Mjcf, &Choices::default()).expect("an export");
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    let names: Vec<_> = document
        .descendants()
        .filter(|n| n.has_tag_name("body"))
        .filter_map(|n| n.attribute("name"))
        .collect();
    assert_eq!(names, ["arm"]);
    assert_moves_alike(&robot, &made.text, "world");
    // The arm has no mass in the URDF, and moves.
    assert!(
        made.notes.iter().any(|note| matches!(note, Note::Inertia { link, .. } if link == "arm"))
    );
    assert!(made.text.contains("mass=\"1e-9\""));
}

#[test]
fn every_mesh_that_is_named_is_there() {
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        for format in [Format::Mjcf, Format::Urdf, Format::Drake] {
            let made = export(&robot, format, &Choices::default()).expect("an export");
            let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
            let mut named: Vec<&str> = document
                .descendants()
                .filter(|n| n.has_tag_name("mesh"))
                .filter_map(|n| n.attribute("file").or(n.attribute("filename")))
                .collect();
            named.sort_unstable();
            named.dedup();
            let files: Vec<&str> = made.files.iter().map(|(path, _)| path.as_str()).collect();
            assert_eq!(named, files, "{name}");
            assert!(!files.is_empty(), "{name}");
        }
    }
}

/// The file has the masses of the URDF, whatever the inertias, and a note names what is assumed.
#[test]
fn masses_stay_whatever_the_inertia() {
    let total = |text: &str| -> f64 {
        let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
        let inertials = document.descendants().filter(|n| n.has_tag_name("inertial"));
        inertials.map(|n| numbers(n, "mass").expect("a mass")[0]).sum()
    };
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let made = export(&robot, Format::Mjcf, &Choices::default()).expect("an export");
        let links = robot.description().expect("a description").links;
        let mass =
            |link: &urdd_format::urdf::Link| Some(link.inertial.as_ref()?.mass.as_ref()?.value);
        let expected: f64 = links.iter().filter(|link| link.name != "world").filter_map(mass).sum();
        let assumed = 1e-9
            * made.notes.iter().filter(|note| note.to_string().contains("1e-9 kg and")).count()
                as f64;
        assert!((total(&made.text) - expected - assumed).abs() < 1e-12, "{name}");
    }
    let inertial = |mass: &str, inertia: &str| {
        format!("<inertial><mass value=\"{mass}\"/>{inertia}</inertial>")
    };
    let zero = r#"<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>"#;
    let full = r#"<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>"#;
    // A group that moves: its own inertia is 0, but not that of the links fixed to it.
    for (own, fixed, noted) in [(zero, full, 0), (zero, zero, 1), (full, zero, 0), ("", "", 1)] {
        let (_folder, path) = made_of(&format!(
            r#"<robot name="r"><link name="a"/><link name="b">{}</link><link name="c">{}</link>
            <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
            <joint name="k" type="fixed"><parent link="b"/><child link="c"/></joint></robot>"#,
            inertial("0.25", own),
            inertial("0.5", fixed)
        ));
        let robot = Robot::open(path).expect("a robot");
        let made = export(&robot, Format::Mjcf, &Choices::default()).expect("an export");
        assert_eq!(total(&made.text), 0.75, "{own} {fixed}");
        let notes = made.notes.iter().filter(|note| matches!(note, Note::Inertia { .. }));
        assert_eq!(notes.count(), noted, "{own} {fixed}: {:?}", made.notes);
        let said = made.notes.iter().filter(|note| matches!(note, Note::Inertia { .. }));
        assert!(said.into_iter().all(|note| made.text.contains(&note.to_string())));
    }
}
