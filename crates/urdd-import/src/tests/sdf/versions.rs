//! What libsdformat honours in every version of SDF; poses by hand.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use super::{body, inside, joint, pose};
use crate::model::Model;
use crate::tests::Entries as _;

const OLD: [&str; 5] = ["1.2", "1.3", "1.4", "1.5", "1.6"];

#[track_caller]
fn is_at(model: &Model, name: &str, wanted: [f64; 3]) {
    let found = pose(model, name).translation.vector;
    assert!((found - Vector3::from(wanted)).amax() < 1e-12, "{name} is at {found:?}");
}

#[test]
fn poses_are_relative_to_what_they_say() {
    // The joint is 2 m before `a`; `b` 0.5 m above the joint, its shape 0.7 m above it.
    let text = "<link name='a'/><link name='b'><pose relative_to='j'>0 0 0.5 0 0 0</pose>\
        <visual name='v'><pose relative_to='j'>0 0 0.7 0 0 0</pose>\
        <geometry><sphere><radius>1</radius></sphere></geometry></visual></link>\
        <joint name='j' type='revolute'><pose relative_to='a'>2 0 0 0 0 0</pose><parent>a</parent><child>b</child>\
        <axis><xyz expressed_in='a'>1 0 0</xyz></axis></joint>";
    for version in OLD.iter().chain(&["1.7", "1.9", "1.12"]) {
        let model = inside(version, text).expect("a model");
        is_at(&model, "b", [2.0, 0.0, 0.5]);
        let shape = body(&model, "b").shapes[0].pose.translation.vector;
        assert!((shape - Vector3::new(0.0, 0.0, 0.2)).amax() < 1e-12, "{version}: {shape:?}");
        let frame = pose(&model, "b") * joint(&model, "j").1.frame;
        let wanted = Isometry3::translation(2.0, 0.0, 0.0);
        assert!((frame.to_homogeneous() - wanted.to_homogeneous()).amax() < 1e-12, "{version}");
    }
}

#[test]
fn the_older_name_goes_before_the_newer_one() {
    let model = |version: &str, attributes: &str| {
        let text = format!(
            "<link name='a'><pose>1 0 0 0 0 0</pose></link>\
             <link name='b'><pose {attributes}>0 1 0 0 0 0</pose></link>"
        );
        inside(version, &text).expect("a model")
    };
    for version in OLD {
        // The root is `a`: relative to the model, `b` is at 0 1 0.
        is_at(&model(version, "frame='' relative_to='a'"), "b", [-1.0, 1.0, 0.0]);
        is_at(&model(version, "frame='a' relative_to='nobody'"), "b", [0.0, 1.0, 0.0]);
        is_at(&model(version, "frame='a'"), "b", [0.0, 1.0, 0.0]);
        is_at(&model(version, "relative_to=''"), "b", [-1.0, 1.0, 0.0]);
    }
    is_at(&model("1.7", "frame='' relative_to='a'"), "b", [0.0, 1.0, 0.0]);
    is_at(&model("1.8", "frame='a'"), "b", [-1.0, 1.0, 0.0]);
}

/// The axis in the frame of the joint, which is that of `b`, turned about z by a quarter.
fn axis(version: &str, xyz: &str, beside: &str, around: [&str; 2]) -> Vector3<f64> {
    let text = format!(
        "{}<link name='a'/><link name='b'><pose>0 0 0 0 0 {FRAC_PI_2}</pose></link>\
         <joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz {xyz}>1 0 0</xyz>{beside}\
         </axis></joint>{}",
        around[0], around[1]
    );
    let model = inside(version, &text).expect("a model");
    let name = if around[0].is_empty() { "j" } else { "n/j" };
    let (moved, joint) = joint(&model, name);
    assert_eq!(joint.frame.rotation, UnitQuaternion::identity());
    let parent = moved.parent.expect("a parent");
    assert!(model.bodies[parent].name.ends_with('a'));
    joint.axis
}

#[test]
fn axes_are_along_what_they_say() {
    let (own, of_a) = (Vector3::x(), -Vector3::y());
    let flag = |value: &str| format!("<use_parent_model_frame>{value}</use_parent_model_frame>");
    let alone = ["", ""];
    let nested = ["<link name='z'/><model name='n'>", "</model>"];
    for version in OLD {
        let is_first = version < "1.5";
        let cases = [
            ("expressed_in='a'", flag("0"), alone, of_a),
            ("expressed_in='a'", String::new(), nested, of_a),
            ("expressed_in=''", flag("0"), alone, own),
            ("", flag("0"), alone, own),
            ("", flag("true"), alone, of_a),
            ("expressed_in='b'", flag("1"), alone, of_a),
            ("", String::new(), alone, if is_first { of_a } else { own }),
            // libsdformat asks axes of nested models for the flag alone.
            ("", String::new(), nested, own),
        ];
        for (xyz, beside, around, wanted) in cases {
            let found = axis(version, xyz, &beside, around);
            assert!((found - wanted).amax() < 1e-12, "{version} {xyz} {beside}: {found:?}");
        }
    }
    assert!((axis("1.7", "", &flag("1"), alone) - own).amax() < 1e-12);
}

#[test]
fn kept_elements_are_where_they_were() {
    // The sensor is 1 m beside the model's frame, `a` 3 m above it.
    let of = |version: &str, attributes: &str| {
        let text = format!(
            "<link name='a'><pose>0 0 3 0 0 0</pose><sensor name='s' type='imu'>\
             <pose {attributes}>1 0 0 0 0 0</pose></sensor></link>"
        );
        let model = inside(version, &text).expect("a model");
        let kept: Vec<&str> = model.elements.iter().map(|element| &*element.0).collect();
        kept.concat()
    };
    for version in ["1.6", "1.9"] {
        let kept = of(version, "relative_to='__model__'");
        assert!(kept.contains("<pose>1 0 -3 0 0 0</pose>"), "{kept}");
        assert!(of(version, "").contains("<pose>1 0 0 0 0 0</pose>"));
        assert!(of(version, "relative_to=''").contains("<pose>1 0 0 0 0 0</pose>"));
    }
    assert!(of("1.6", "frame='__model__'").contains("<pose>1 0 -3 0 0 0</pose>"));
    assert!(of("1.6", "frame=''").contains("<pose>1 0 0 0 0 0</pose>"));
    let turned = of("1.9", "degrees='true' relative_to='a'");
    assert!(turned.contains("<pose>1 0 0 0 0 0</pose>"), "{turned}");
    let text = "<link name='a'><sensor name='s' type='imu'><pose relative_to='nobody'>1 0 0 0 0 0</pose></sensor></link>";
    let model = inside("1.9", text).expect("a model");
    let said = &model.tally.remarks[0].text;
    assert!(said.contains("names no frame: `nobody`"), "{said}");
}
