//! What libsdformat 12 resolves.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;

use super::{body, fixture, joint, pose};
use crate::model::Model;
use crate::tests::Entries as _;

const TRUTH: &str = include_str!("truth.jsonl");
const NEAR: f64 = 1e-12;

fn truth(name: &str) -> Value {
    let mut lines = TRUTH.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
    lines.find(|line| line["name"] == name).expect("a fixture of libsdformat")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("numbers").iter().map(|one| one.as_f64().expect("a number")).collect()
}

fn isometry(value: &Value) -> Isometry3<f64> {
    let [x, y, z, w, i, j, k] = numbers(value)[..] else { panic!("no pose") };
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

fn is_near(left: &Isometry3<f64>, right: &Isometry3<f64>) -> bool {
    (left.to_homogeneous() - right.to_homogeneous()).amax() < NEAR
}

/// Compares a fixture with the truth: poses of links and frames, joints and their axes, limits, masses.
fn agrees(name: &str) -> Model {
    let model = fixture(&format!("{name}.sdf"));
    let truth = truth(name);
    // A URDF has `/` where names of libsdformat have `::`.
    let plain = |name: &str| name.replace("::", "/");
    let links = truth["links"].as_object().expect("links");
    let root = &model.bodies[0].name;
    let base = links.get(root).map_or_else(Isometry3::identity, |root| isometry(&root["pose"]));
    let of_root = |value: &Value| base.inv_mul(&isometry(value));
    for (name, link) in links {
        let name = &plain(name);
        assert!(is_near(&pose(&model, name), &of_root(&link["pose"])), "pose of {name}");
        let inertial = body(&model, name).inertial.as_ref().expect("a mass");
        assert_eq!(inertial.mass, link["mass"].as_f64().expect("a mass"), "mass of {name}");
        let centre = inertial.centre.coords - Vector3::from_vec(numbers(&link["centre"]));
        assert!(centre.amax() < NEAR, "centre of {name}");
        let [xx, xy, xz, yy, yz, zz] = numbers(&link["inertia"])[..] else { panic!("no inertia") };
        let wanted = nalgebra::Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        assert!((inertial.inertia - wanted).amax() < NEAR, "inertia of {name}");
        let shapes = &body(&model, name).shapes;
        let given = ["visuals", "collisions"].iter().flat_map(|kind| link[kind].as_array());
        let given = given.flatten().filter(|shape| shape["geometry"][0] != "other");
        for (shape, given) in shapes.iter().zip(given) {
            assert!(is_near(&shape.pose, &isometry(&given["pose"])), "shape of {name}");
        }
    }
    for (name, frame) in truth["frames"].as_object().expect("frames") {
        if name.starts_with("_merged__") {
            continue;
        }
        let name = &plain(name);
        assert!(is_near(&pose(&model, name), &of_root(&frame["pose"])), "pose of {name}");
        let parent = body(&model, name).parent.expect("a parent");
        let link = frame["link"].as_str().expect("a link");
        assert_eq!(model.bodies[parent].name, plain(link), "{name}");
    }
    for (name, given) in truth["joints"].as_object().expect("joints") {
        let name = &plain(name);
        let lost = ["closing", "gears"].contains(&name.as_str());
        let is_fixed = model.bodies.iter().any(|body| body.fixed_by.as_ref() == Some(name));
        if lost || is_fixed {
            continue;
        }
        let axes = given["axes"].as_array().expect("axes");
        for (which, axis) in axes.iter().enumerate() {
            let suffix = match axes.len() {
                1 => "",
                _ => ["/axis", "/axis2"][which],
            };
            let (moved, joint) = joint(&model, &format!("{name}{suffix}"));
            let is_turned = moved.name == plain(given["parent"].as_str().expect("a parent"));
            assert_eq!(is_turned, name == "turned", "direction of {name}");
            let frame = pose(&model, &moved.name) * joint.frame;
            let wanted = of_root(&given["pose"]);
            let shift = frame.translation.vector - wanted.translation.vector;
            assert!(shift.amax() < NEAR, "place of {name}");
            let direction = wanted.rotation * Vector3::from_vec(numbers(&axis["xyz"]));
            let direction = if is_turned { -direction } else { direction };
            assert!((frame.rotation * joint.axis - direction).amax() < NEAR, "axis of {name}");
            let limits = [&axis["lower"], &axis["upper"]].map(Value::as_f64);
            if let [Some(lower), Some(upper)] = limits
                && lower > -1e16
                && upper < 1e16
            {
                assert_eq!(joint.range, Some([lower, upper]), "limits of {name}");
            }
            let bound = |key: &str| axis[key].as_f64().filter(|value| *value >= 0.0);
            assert_eq!([joint.effort, joint.velocity], [bound("effort"), bound("velocity")]);
            assert_eq!(axis["damping"].as_f64(), Some(joint.damping), "damping of {name}");
            assert_eq!(axis["friction"].as_f64(), Some(joint.friction), "friction of {name}");
        }
    }
    model
}

#[test]
fn frames_and_poses_are_where_libsdformat_puts_them() {
    let model = agrees("frames");
    assert!(model.is_floating);
    // The joint of the arm is away from its frame.
    assert_ne!(joint(&model, "shoulder").1.frame, Isometry3::identity());
}

#[test]
fn axes_of_old_versions_are_along_the_model() {
    assert_eq!(joint(&agrees("old_axes"), "j").1.range, None);
    agrees("flagged_axes");
}

#[test]
fn nested_models_are_placed_by_their_frames() {
    agrees("nested");
}

#[test]
fn included_models_are_placed_and_merged() {
    let model = agrees("includes");
    assert_eq!(model.files.len(), 2);
    assert_eq!(body(&model, "left/palm").fixed_by.as_deref(), Some("hold_left"));
}

#[test]
fn joints_of_all_types_are_where_they_are() {
    agrees("joints");
}

#[test]
fn a_graph_becomes_a_tree() {
    let model = agrees("graph");
    let [world, stray] = ["world", "stray"].map(|name| body(&model, name));
    assert!(world.is_frame && world.parent.is_none() && !model.is_floating);
    assert_eq!((stray.parent, stray.joints.len()), (Some(0), 0));
}

#[test]
fn shapes_are_where_they_are() {
    agrees("shapes");
}
