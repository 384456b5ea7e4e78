//! Fixtures of MJCF, held to what MuJoCo's compiled model has of them: `tests/figures/imports/make_mjcf.py`.

use std::path::{Path, PathBuf};

use nalgebra::{
    Isometry3, Matrix3, Point3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3,
};
use serde_json::Value;
use urdd_source::gate::Gate;
use urdd_source::{ImportOptions, Settings};

use crate::mjcf;
use crate::model::{Body, Geometry, Joint, JointKind, Model, Shape, Use};
use crate::place::{Placed, TextFile};
use crate::tests::Entries as _;

const NEAR: f64 = 1e-9;
/// MuJoCo keeps vertices in 32 bits.
const SINGLE: f64 = 1e-5;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/figures/imports")
}

fn read(name: &str, body: Option<&str>) -> Model {
    let path = folder().join("mjcf").join(name).with_extension("xml").canonicalize().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    of_text(&path, text, body).unwrap_or_else(|fault| panic!("{name}: {fault:?}"))
}

/// Reads a text as if it were in a file.
pub fn of_text(path: &Path, text: String, body: Option<&str>) -> Result<Model, Placed> {
    let gate = Gate::of_project(path.parent().unwrap(), &Settings::default());
    gate.account().deposit(text.len());
    let bytes = text.as_bytes().into();
    let file = TextFile { shown: "m.xml".to_owned(), path: path.to_owned(), text, bytes };
    let options = ImportOptions { body: body.map(str::to_owned), ..ImportOptions::default() };
    mjcf::read(file, &gate, &options)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|of| of.as_f64().unwrap()).collect()
}

fn rotation(q: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(q[0], q[1], q[2], q[3]))
}

fn pose(of: &[f64]) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(of[0], of[1], of[2]), rotation(&of[3..]))
}

fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance, "{what}: {found:?}, MuJoCo has {expected:?}");
    }
}

fn assert_pose(found: &Isometry3<f64>, expected: &Isometry3<f64>, tolerance: f64, what: &str) {
    let off = found.inverse() * expected;
    let far = off.translation.vector.norm().max(off.rotation.angle());
    assert!(far <= tolerance, "{what}: {found}, MuJoCo has {expected}");
}

/// The bodies of a model that are those of MuJoCo, each with its own.
fn pairs<'m>(model: &'m Model, expected: &'m Value) -> Vec<(usize, &'m Body, &'m Value)> {
    let is_world = |body: &Body| body.name == "world";
    let ours =
        model.bodies.iter().enumerate().filter(|(_, body)| !body.is_frame && !is_world(body));
    let ours: Vec<_> = ours.collect();
    let theirs = expected["bodies"].as_array().unwrap();
    let is_whole = ours.len() == theirs.len();
    let find = |at: usize, body: &Body| match is_whole {
        true => &theirs[at],
        false => theirs.iter().find(|of| of["name"] == body.name.as_str()).unwrap(),
    };
    ours.iter().enumerate().map(|(at, (index, body))| (*index, *body, find(at, body))).collect()
}

fn moved(joint: &Joint, values: &[f64]) -> Isometry3<f64> {
    let axis = Unit::new_normalize(joint.axis);
    let by = values[0] - joint.reference;
    let motion = match joint.kind {
        JointKind::Hinge => {
            let turn = UnitQuaternion::from_axis_angle(&axis, by);
            Isometry3::from_parts(Translation3::identity(), turn)
        }
        JointKind::Slide => Translation3::from(axis.into_inner() * by).into(),
        JointKind::Ball => Isometry3::from_parts(Translation3::identity(), rotation(values)),
        other => panic!("MJCF has no {other:?}"),
    };
    joint.frame * motion * joint.frame.inverse()
}

fn joints(expected: &Value) -> impl Iterator<Item = &Value> {
    expected["joints"].as_array().unwrap().iter().filter(|joint| joint["kind"] != "free")
}

fn compare(name: &str, model: &Model, expected: &Value) {
    let pairs = pairs(model, expected);
    assert!(!pairs.is_empty());
    for turn in 0..3 {
        let mut poses = vec![Isometry3::identity(); model.bodies.len()];
        for (index, body, expected) in &pairs {
            let mut pose = body.parent.map_or(body.pose, |parent| poses[parent] * body.pose);
            if body.parent.is_some() {
                for (joint, of) in body.joints.iter().zip(joints(expected)) {
                    pose *= moved(joint, &numbers(&of["values"][turn]));
                }
            }
            poses[*index] = pose;
        }
        let (first, body, root) = &pairs[0];
        let root = match body.parent {
            Some(_) => Isometry3::identity(),
            None => pose(&numbers(&root["poses"][turn])) * poses[*first].inverse(),
        };
        for (index, body, expected) in &pairs {
            let what = format!("{name}: pose of {}", body.name);
            assert_pose(
                &(root * poses[*index]),
                &pose(&numbers(&expected["poses"][turn])),
                NEAR,
                &what,
            );
        }
    }
    for (_, body, expected) in pairs {
        let what = format!("{name}: {}", body.name);
        let has_mesh = body.shapes.iter().any(|of| matches!(of.geometry, Geometry::Mesh { .. }));
        let tolerance = if has_mesh || name.starts_with("fitted") { SINGLE } else { NEAR };
        let (mass, centre, inertia) = match &body.inertial {
            Some(of) => (of.mass, of.centre, of.inertia),
            None => (0.0, Point3::origin(), Matrix3::zeros()),
        };
        let expected_mass = expected["mass"].as_f64().unwrap();
        assert_near(&[mass], &[expected_mass], tolerance * expected_mass, &format!("{what}: mass"));
        if mass > 0.0 {
            let centre_of = numbers(&expected["centre"]);
            assert_near(
                centre.coords.as_slice(),
                &centre_of,
                tolerance,
                &format!("{what}: centre"),
            );
        }
        let inertia_of = numbers(&expected["inertia"]);
        let size = inertia_of.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        assert_near(inertia.as_slice(), &inertia_of, tolerance * size, &format!("{what}: inertia"));
        let moving: Vec<&Value> = joints(expected).collect();
        assert_eq!(body.joints.len(), moving.len(), "{what}");
        for (joint, of) in body.joints.iter().zip(moving) {
            let kind = match joint.kind {
                JointKind::Hinge => "hinge",
                JointKind::Slide => "slide",
                JointKind::Ball => "ball",
                other => panic!("MJCF has no {other:?}"),
            };
            assert_eq!(of["kind"], kind, "{what}");
            if let Some(named) = of["name"].as_str().filter(|name| !name.is_empty()) {
                assert_eq!(joint.name, named);
            }
            match (joint.range, of["range"].as_array()) {
                (Some(range), Some(_)) => assert_near(&range, &numbers(&of["range"]), NEAR, &what),
                (found, expected) => {
                    assert!(found.is_none() && expected.is_none(), "{what}: range")
                }
            }
            assert_near(&[joint.friction], &[of["friction"].as_f64().unwrap()], NEAR, &what);
        }
        shapes(&what, model, body, expected["shapes"].as_array().unwrap());
    }
}

fn shapes(what: &str, model: &Model, body: &Body, expected: &[Value]) {
    assert_eq!(body.shapes.len(), expected.len(), "{what}");
    for (shape, of) in body.shapes.iter().zip(expected) {
        let [a, b, c] = numbers(&of["size"])[..] else { panic!("three sizes") };
        let (kind, found, size): (&str, Vec<f64>, Vec<f64>) = match &shape.geometry {
            Geometry::Sphere(radius) => ("sphere", vec![*radius], vec![a]),
            Geometry::Capsule { radius, length } => {
                ("capsule", vec![*radius, *length], vec![a, 2.0 * b])
            }
            Geometry::Cylinder { radius, length } => {
                ("cylinder", vec![*radius, *length], vec![a, 2.0 * b])
            }
            Geometry::Ellipsoid(radii) => ("ellipsoid", radii.to_vec(), vec![a, b, c]),
            Geometry::Box(lengths) => ("box", lengths.to_vec(), vec![2.0 * a, 2.0 * b, 2.0 * c]),
            Geometry::Mesh { .. } => {
                assert_eq!(of["kind"], "mesh", "{what}");
                let expected = numbers(&of["box"]);
                assert_near(&bounds(model, shape), &expected, SINGLE, &format!("{what}: mesh"));
                continue;
            }
        };
        assert_eq!(of["kind"], kind, "{what}");
        assert_near(&found, &size, SINGLE * 1e-2, &format!("{what}: size"));
        let rotation = numbers(&of["rotation"]);
        let found = shape.pose.rotation.to_rotation_matrix();
        assert_near(
            found.matrix().transpose().as_slice(),
            &rotation,
            1e-7,
            &format!("{what}: rotation"),
        );
        let position = numbers(&of["position"]);
        assert_near(shape.pose.translation.vector.as_slice(), &position, 1e-7, what);
    }
}

/// The box around the vertices of a mesh, in the frame of its body.
fn bounds(model: &Model, shape: &Shape) -> Vec<f64> {
    let Geometry::Mesh { asset, scale } = shape.geometry else { panic!("a mesh") };
    let asset = &model.assets[asset];
    let mesh =
        urdd_geometry::read::read(&asset.bytes, &asset.path, &mut |_| None).unwrap().merged();
    let points = mesh.vertices.iter().map(|vertex| {
        let scaled = Vector3::from(*vertex).component_mul(&Vector3::from(scale));
        (shape.pose * Point3::from(scaled)).coords.into()
    });
    let bounds = urdd_geometry::mesh::Bounds::of(points);
    [bounds.min, bounds.max].concat()
}

#[test]
fn fixtures_are_what_mujoco_makes_of_them() {
    let text = std::fs::read_to_string(folder().join("mjcf.json")).unwrap();
    let all: serde_json::Map<String, Value> = serde_json::from_str(&text).unwrap();
    assert!(all.len() >= 17, "{}", all.len());
    for (name, expected) in &all {
        compare(name, &read(name, None), expected);
    }
}

#[test]
fn sites_and_cameras_are_frames() {
    let model = read("frames", None);
    let text = std::fs::read_to_string(folder().join("mjcf.json")).unwrap();
    let all: Value = serde_json::from_str(&text).unwrap();
    let sites = all["frames"]["sites"].as_array().unwrap();
    assert_eq!(sites.len(), 8);
    for site in sites {
        let name = site[0].as_str().unwrap();
        let body = model.bodies.iter().find(|body| body.name == name).unwrap();
        assert!(body.is_frame && body.inertial.is_none());
        let expected = pose(&[numbers(&site[1]), numbers(&site[2])].concat());
        assert_pose(&body.pose, &expected, NEAR, name);
    }
    assert_eq!(model.bodies.iter().filter(|body| body.is_frame).count(), 9);
}

fn joint<'m>(model: &'m Model, name: &str) -> &'m Joint {
    let mut joints = model.bodies.iter().flat_map(|body| body.joints.all());
    joints.find(|joint| joint.name == name).unwrap()
}

#[test]
fn linear_equalities_are_mimics() {
    let model = read("equalities", None);
    let mimic = |name| joint(&model, name).mimic.as_ref();
    // b + 0.1 = 0.05 - 2 (a - 0.2)
    let b = mimic("b").unwrap();
    assert_eq!((&*b.joint, b.multiplier), ("a", -2.0));
    assert!((b.offset - 0.35).abs() < 1e-15, "{}", b.offset);
    // c = 0.1 (b + 0.1)
    let c = mimic("c").unwrap();
    assert_eq!((&*c.joint, c.multiplier), ("b", 0.1));
    assert!((c.offset - 0.01).abs() < 1e-15, "{}", c.offset);
    assert!([mimic("a"), mimic("d"), mimic("e")].iter().all(Option::is_none));
    let remarks: Vec<&str> = model.tally.remarks.iter().map(|of| &*of.text).collect();
    assert!(remarks[0].contains("not active"), "{remarks:?}");
    // One of a joint that is held, one that is not linear, and one of a circle.
    assert_eq!((model.couplings.len(), model.closings.len()), (3, 1));
}

#[test]
fn actuators_give_forces_speeds_and_gains() {
    let model = read("actuators", None);
    let of = |name| {
        let joint = joint(&model, name);
        (joint.effort, joint.velocity, joint.kp, joint.kv)
    };
    // A gear multiplies forces, its square gains; what has no limit has no greatest force. The dampings of `a` and `c` are
    // ratios: 2 ratio sqrt(kp M), 1 / M the diagonal of the inverse of the matrix of masses. So MuJoCo 4.0.0 compiles them.
    let ratio = |name, gear: f64, damping: f64| {
        let kv = joint(&model, name).kv.unwrap();
        assert!((kv - damping * gear * gear).abs() < 1e-7, "{name}: {kv}");
    };
    ratio("a", 2.0, 1.1474118698);
    ratio("c", 1.0, 1.3035151257);
    assert_eq!((of("a").0, of("a").2), (Some(10.0), Some(80.0)));
    assert_eq!(of("b"), (Some(3.0), None, None, None));
    assert_eq!((of("c").0, of("c").2), (None, Some(30.0)));
    assert_eq!(of("d"), (Some(9.0), None, Some(100.0), Some(5.0)));
    assert_eq!(of("e"), (None, Some(1.0), Some(0.0), Some(36.0)));
    // 3 times 2 of one motor, 4 of another; nobody knows how much of the muscle.
    assert_eq!(of("f"), (None, None, None, None));
    // Of a class with motors and servos of speed, a servo of position takes the gear, but not the gain.
    assert_eq!(of("h"), (None, None, Some(80.0), Some(4.0)));
    assert_eq!(of("i"), (None, None, Some(0.0), Some(12.0)));
    let e = joint(&model, "e");
    assert!((e.damping - 1.2).abs() < 1e-12 && (e.armature.unwrap() - 1.8).abs() < 1e-12);
    assert!(model.tally.all_unread().is_empty());
}

#[test]
fn pairs_that_never_collide_are_those_of_mujoco() {
    let model = read("contacts", None);
    let name = |index: usize| model.bodies[index].name.as_str();
    let found: Vec<(&str, &str, &str)> =
        model.apart.iter().map(|of| (name(of.bodies[0]), name(of.bodies[1]), of.reason)).collect();
    // c has the bits 2, and 4 or 8; e has 4, and 1. d is in a `<pair>` with b alone.
    let expected = [
        ("base", "fixed", "Adjacent"),
        ("base", "c", "Never"),
        ("base", "d", "Never"),
        ("base", "f", "User"),
        ("fixed", "c", "Never"),
        ("fixed", "d", "Never"),
        ("a", "b", "Adjacent"),
        ("a", "c", "Never"),
        ("a", "d", "Never"),
        ("a", "e", "User"),
        ("b", "c", "Adjacent"),
        ("b", "e", "Adjacent"),
        ("c", "d", "Never"),
        ("d", "e", "Never"),
    ];
    assert_eq!(found, expected);
}

#[test]
fn keyframes_are_configurations() {
    let model = read("keys", None);
    assert!(model.is_floating);
    let names: Vec<&str> = model.configurations.iter().map(|of| &*of.name).collect();
    assert_eq!(names, ["home", "up", "key_2"]);
    let value = |at: usize, joint: &str| {
        let values = &model.configurations[at].values;
        values.iter().find(|value| value.name == joint).unwrap().values.clone()
    };
    assert_near(&value(0, "a"), &[20.0_f64.to_radians()], 1e-15, "a at home");
    assert_near(&value(0, "b"), &[0.0; 3], 0.0, "b at home");
    assert_near(&value(1, "a"), &[0.5], 0.0, "a up");
    // 2 acos 0.6 about y.
    assert_near(&value(1, "b"), &[0.0, 2.0 * 0.6_f64.acos(), 0.0], 1e-12, "b up");
    assert_near(&value(2, "c"), &[0.2], 0.0, "c");
}

#[test]
fn the_robot_of_a_scene_is_what_is_driven() {
    let names = |body: Option<&str>| -> Vec<String> {
        read("scene", body).bodies.iter().map(|body| body.name.clone()).collect()
    };
    assert_eq!(names(None), ["world", "left", "left_arm", "right", "right_arm"]);
    assert_eq!(names(Some("drawer")), ["world", "drawer", "door", "lid"]);
    assert_eq!(names(Some("left_arm")), ["left_arm"]);
    assert_eq!(names(Some("world")).len(), 9);
    let world = read("scene", Some("world"));
    assert!(matches!(world.bodies[0].shapes.all(), [Shape { used: Use::Both, .. }]));
    let remarks = read("scene", None).tally.remarks;
    assert!(remarks.iter().any(|of| of.text.contains("`drawer`, `target`")), "{remarks:?}");
}

#[test]
fn attached_models_bring_what_is_theirs() {
    // Poses, masses, shapes and limits are those of `mjcf.json`.
    let model = read("attached", None);
    let mimic = |name| joint(&model, name).mimic.clone().map(|of| (of.joint, of.multiplier));
    assert_eq!(mimic("left/curl"), Some(("left/bend".to_owned(), 2.0)));
    assert_eq!(mimic("right/curl"), Some(("right/bend".to_owned(), 2.0)));
    let bend = joint(&model, "right/bend");
    assert_eq!((bend.kp, bend.actuator.name.as_deref()), (Some(7.0), Some("right/grip")));
    // MuJoCo's own.
    assert!((bend.kv.unwrap() - 0.01126647).abs() < 1e-8, "{:?}", bend.kv);
    let excluded = model.apart.iter().filter(|of| of.reason == "User");
    let name = |index: usize| model.bodies[index].name.as_str();
    let excluded: Vec<[&str; 2]> = excluded.map(|of| of.bodies.map(name)).collect();
    assert_eq!(excluded, [["left/thumb", "left/finger"], ["right/thumb", "right/finger"]]);
    let shell =
        model.bodies.iter().find(|body| body.name == "left/palm").unwrap().shapes[0].clone();
    assert_eq!(shell.material.unwrap().name.as_deref(), Some("left/red"));
    assert_eq!(model.tally.all_unread().get("keys of attached models"), Some(&2));
}
