use std::path::Path;

use crate::made::export;
use urdd_export::{Choices, Detail, Export, Format, Note};
use urdd_format::urdf::{Joint, JointType};
use urdd_generate::{Selection, Settings, generate};
use urdd_robot::{Robot, ShapeKind, Solid};

use testkit::robots::{made, made_of, our_robots};

fn write(folder: &Path, made: &Export) -> std::path::PathBuf {
    let file = folder.join("exported.urdf");
    std::fs::write(&file, &made.text).expect("a file");
    for (path, bytes) in &made.files {
        let path = folder.join(path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, bytes).expect("a mesh");
    }
    file
}

/// A URDD of the exported URDF has the same joints and masses as that of the source, and its collision geometry is the
/// shapes.
#[test]
fn joints_and_masses_stay_and_shapes_are_the_collision_geometry() {
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let source = robot.description().expect("a description");
        for kind in [ShapeKind::Hulls, ShapeKind::PieceBoxes, ShapeKind::Spheres] {
            let options = Choices { shapes: kind.into(), ..Choices::default() };
            let exported = export(&robot, Format::Urdf, &options).expect("an export");
            let folder = testkit::temporary::folder();
            let file = write(folder.path(), &exported);
            let target = folder.path().join("again");
            let core = Settings {
                selection: Selection::parse(["core"]).expect("a selection"),
                ..Settings::default()
            };
            generate(&file, &target, &core, &()).expect("a URDD");
            let again =
                Robot::open(&target).expect("a robot").description().expect("a description");
            assert_same_motion(&again.joints, &source.joints, &name);
            assert_eq!(again.unknown_elements, source.unknown_elements, "{name}");
            for (new, old) in again.links.iter().zip(&source.links) {
                assert_eq!((&new.name, &new.inertial), (&old.name, &old.inertial), "{name}");
            }
            let count = robot.shapes(kind).expect("shapes").len();
            let collisions: usize = again.links.iter().map(|link| link.collision.len()).sum();
            assert_eq!(collisions, count, "{name}");
        }
    }
}

/// The joints are the source's, except that a mimic of a mimic follows the end of the chain.
fn assert_same_motion(again: &[Joint], source: &[Joint], name: &str) {
    let find = |joints: &'_ [Joint], wanted: &str| {
        joints.iter().find(|joint| joint.name == wanted).cloned()
    };
    for (new, old) in again.iter().zip(source) {
        let without = |joint: &Joint| Joint { mimic: None, ..joint.clone() };
        assert_eq!(without(new), without(old), "{name}");
        let (mut factor, mut offset, mut at) = (1.0, 0.0, old.clone());
        while let Some(mimic) = at.mimic.clone().filter(|_| at.joint_type != JointType::Fixed) {
            offset += factor * mimic.offset.unwrap_or(0.0);
            factor *= mimic.multiplier.unwrap_or(1.0);
            at = find(source, &mimic.joint).expect("a joint");
        }
        match (&new.mimic, at.name == old.name) {
            (None, true) => {}
            (Some(mimic), false) => {
                assert_eq!(mimic.joint, at.name, "{name}");
                assert!((mimic.multiplier.unwrap_or(1.0) - factor).abs() < 1e-12, "{name}");
                assert!((mimic.offset.unwrap_or(0.0) - offset).abs() < 1e-12, "{name}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

/// Chains of mimics, mimics on and of fixed joints, quaternions: the URDD of the export moves as the robot does.
#[test]
fn an_awkward_robot_moves_as_before() {
    let urdf = testkit::repository().join("tests/figures/exports/awkward.urdf");
    let (_folder, path) = made(&urdf);
    let robot = Robot::open(path).expect("a robot");
    let exported = export(&robot, Format::Urdf, &Choices::default()).expect("an export");
    assert!(!exported.text.contains("quat_xyzw"));
    let document = urdd_xml::parse(&exported.text, urdd_xml::Kind::Other).expect("well-formed");
    let mimics: Vec<_> = document.descendants().filter(|n| n.has_tag_name("mimic")).collect();
    assert_eq!(mimics.len(), 3);
    assert!(mimics.iter().all(|mimic| mimic.attribute("joint") == Some("j1")));
    let stand =
        document.descendants().find(|n| n.attribute("name") == Some("stand")).expect("a joint");
    assert_eq!(stand.attribute("type"), Some("fixed"));
    let folder = testkit::temporary::folder();
    let target = folder.path().join("again");
    generate(&write(folder.path(), &exported), &target, &Settings::default(), &()).expect("a URDD");
    let again = Robot::open(&target).expect("a robot");
    for k in 0..50 {
        let q = robot.configurations().expect("bounds").random(k);
        let (one, other) =
            (robot.link_poses(&q).expect("poses"), again.link_poses(&q).expect("poses"));
        for (one, other) in one.iter().zip(&other) {
            let apart = (one.inverse() * other).to_homogeneous() - nalgebra::Matrix4::identity();
            assert!(apart.abs().max() < 1e-12, "{apart}");
        }
    }
}

#[test]
fn a_robot_without_shapes_is_exported_without_collision_geometry() {
    let (_folder, path) = made_of(
        "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/>\
         <joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>",
    );
    let robot = Robot::open(path).expect("a robot");
    for format in [Format::Urdf, Format::Drake, Format::Mjcf] {
        let made = export(&robot, format, &Choices::default()).expect("an export");
        assert!(made.notes.contains(&Note::NoShapes(ShapeKind::Pieces.into())), "{format:?}");
        assert!(made.text.contains("no link has pieces"), "{format:?}");
        assert!(made.files.is_empty());
    }
    let made = export(&robot, Format::Srdf, &Choices::default()).expect("an export");
    assert!(made.notes.is_empty());
    let made = export(&robot, Format::Curobo, &Choices::default()).expect("an export");
    assert!(made.text.contains("# No link has shapes"), "{}", made.text);
    assert!(made.text.contains("\ncollision_spheres: {}\n"), "{}", made.text);
    let made = export(&robot, Format::Foam, &Choices::default()).expect("an export");
    let foam: serde_json::Value = serde_json::from_str(&made.text).expect("JSON");
    assert_eq!(foam["links"], serde_json::json!({}));
}

/// Boxes come back in place: their corners are the same.
#[test]
fn boxes_stand_where_the_module_has_them() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).expect("a robot");
    let options =
        Choices { shapes: ShapeKind::Boxes.into(), visuals: Detail::Nothing, ..Choices::default() };
    let made = export(&robot, Format::Urdf, &options).expect("an export");
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    let numbers = |node: urdd_xml::Node, key: &str| -> Vec<f64> {
        let text = node.attribute(key).expect("an attribute");
        text.split(' ').map(|word| word.parse().expect("a number")).collect()
    };
    let collisions: Vec<_> =
        document.descendants().filter(|n| n.has_tag_name("collision")).collect();
    let shapes = robot.shapes(ShapeKind::Boxes).expect("boxes");
    assert_eq!(collisions.len(), shapes.len());
    for (collision, shape) in collisions.iter().zip(&shapes) {
        let Solid::Box { pose, half_extents } = &shape.solid else {
            panic!("a box");
        };
        let child =
            |name: &str| collision.descendants().find(|n| n.has_tag_name(name)).expect("there");
        let (xyz, rpy) = (numbers(child("origin"), "xyz"), numbers(child("origin"), "rpy"));
        let size = numbers(child("box"), "size");
        // Fixed-axis roll, pitch, yaw, by hand (SPEC 5.4).
        let (cr, sr) = (rpy[0].cos(), rpy[0].sin());
        let (cp, sp) = (rpy[1].cos(), rpy[1].sin());
        let (cy, sy) = (rpy[2].cos(), rpy[2].sin());
        let rows = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ];
        for corner in 0..8u32 {
            let sign = |axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
            let local: [f64; 3] = std::array::from_fn(|axis| sign(axis) * size[axis] / 2.0);
            let expected = pose
                * nalgebra::Point3::from(std::array::from_fn(|axis| {
                    sign(axis) * half_extents[axis]
                }));
            for axis in 0..3 {
                let got = xyz[axis] + (0..3).map(|k| rows[axis][k] * local[k]).sum::<f64>();
                assert!((got - expected[axis]).abs() < 1e-7, "{got} for {}", expected[axis]);
            }
        }
    }
}

#[test]
fn a_line_break_in_an_attribute_is_a_space() {
    let (_folder, path) = made_of(
        "<robot name=\"r\"><link name=\"a\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual></link>\
         <gazebo:plugin xmlns:gazebo=\"urn:g\" name=\"p\"/><link name=\"b\nc\"/>\
         <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\nc\"/></joint></robot>",
    );
    let robot = Robot::open(path).expect("a robot");
    // A line break in an attribute is a space to XML, so the name is `b c`, which every format holds.
    assert!(export(&robot, Format::Urdf, &Choices::default()).is_ok());
}

#[test]
fn the_same_urdd_gives_the_same_bytes() {
    let (_folder, path) = made(&our_robots()[0].1);
    let options = Choices { samples: 2_000, ..Choices::default() };
    let exports = || {
        let robot = Robot::open(&path).expect("a robot");
        Format::ALL
            .iter()
            .map(|format| export(&robot, *format, &options).expect("an export"))
            .collect::<Vec<_>>()
    };
    let one = rayon_of(1).install(exports);
    let two = rayon_of(3).install(exports);
    assert_eq!(one, two);
}

fn rayon_of(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool")
}
