//! Poses from closed forms, and parsed values compared with a peer, urdf-rs.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use nalgebra::Vector3;

use urdd_validate::reference::{MimicDofs, Reference};
use urdd_validate::urdf_text;

fn reference(urdf: &str) -> Reference {
    let reading = urdf_text::read(urdf);
    assert_eq!(reading.problems, []);
    Reference::new(&reading.robot.expect("a robot"), MimicDofs::Follow).expect("a tree")
}

/// Two links and a joint.
fn with_joint(kind: &str, inside: &str) -> Reference {
    reference(&format!(
        "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='{kind}'>\
         <parent link='a'/><child link='b'/>{inside}</joint></robot>"
    ))
}

/// The columns of the rotation of a fixed joint with this origin: the images of x, y and z.
fn axes(version: &str, origin: &str) -> [Vector3<f64>; 3] {
    let urdf = format!(
        "<robot name='r' {version}><link name='a'/><link name='b'/><joint name='j' type='fixed'>\
         <origin {origin}/><parent link='a'/><child link='b'/></joint></robot>"
    );
    let poses = reference(&urdf).link_poses(&[]).expect("no DOFs");
    [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| poses[1].rotation * axis)
}

#[test]
fn a_quaternion_is_x_y_z_w_and_exact() {
    let turned = |version, origin, expected: [[f64; 3]; 3]| {
        for (found, expected) in axes(version, origin).iter().zip(expected) {
            let apart = (found - Vector3::from(expected)).norm();
            assert!(apart < 1e-15, "{version} {origin}: {found}, expected {expected:?}");
        }
    };
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let minus = |v: [f64; 3]| v.map(|c| -c);
    // A quarter turn about x, of any length and sign.
    turned("version='1.1'", "quat_xyzw='3 0 0 3'", [x, z, minus(y)]);
    turned("version='1.2'", "quat_xyzw='-1 0 0 -1'", [x, z, minus(y)]);
    turned("version='1.1'", "quat_xyzw='2e-200 0 0 2e-200'", [x, z, minus(y)]);
    // A third of a turn about (1, 1, 1): x to y to z to x.
    turned("version='1.1'", "quat_xyzw='.5 .5 .5 .5'", [y, z, x]);
    // Before version 1.1 it has no meaning.
    turned("", "quat_xyzw='3 0 0 3'", [x, y, z]);
    turned("version='1.0'", "quat_xyzw='1 0 0 1' rpy='0 0 0'", [x, y, z]);
    turned("version='1.1'", "quat_xyzw='0 0 0 0'", [x, y, z]);
}

#[test]
fn a_pitch_of_nearly_a_quarter_turn_keeps_its_digits() {
    // 0.001 rad short of a quarter turn about y: z goes to (cos 0.001, 0, sin 0.001).
    let half = std::f64::consts::FRAC_PI_4 - 0.0005;
    let origin = format!("quat_xyzw='0 {} 0 {}'", half.sin(), half.cos());
    let [_, _, z] = axes("version='1.1'", &origin);
    let expected = Vector3::new(0.001_f64.cos(), 0.0, 0.001_f64.sin());
    assert!((z - expected).norm() < 1e-15, "{z}");
    assert!(half.sin() < FRAC_1_SQRT_2);
}

#[test]
fn what_is_not_finite_is_absent() {
    let poses = with_joint("fixed", "<origin xyz='nan 1 2' rpy='0 1e999 0'/>").link_poses(&[]);
    let pose = poses.expect("no DOFs")[1];
    assert_eq!(pose.translation.vector, Vector3::zeros());
    assert_eq!(pose.rotation * Vector3::x(), Vector3::x());
    // About x, the default: a quarter turn takes y to z.
    let turn = with_joint("continuous", "<axis xyz='inf 0 1'/>");
    let pose = turn.link_poses(&[PI / 2.0]).expect("one DOF")[1];
    assert!((pose.rotation * Vector3::y() - Vector3::z()).norm() < 1e-15);
    let limits = with_joint("revolute", "<limit lower='-inf' upper='2'/>");
    assert_eq!(limits.intervals(), [[0.0, 2.0]]);
}

#[test]
fn numbers_near_the_largest_are_numbers() {
    let huge =
        with_joint("revolute", "<axis xyz='0 0 1e300'/><limit lower='-1e200' upper='1e200'/>");
    assert_eq!(huge.intervals(), [[-PI, PI]]);
    let pose = huge.link_poses(&[PI]).expect("one DOF")[1];
    assert!((pose.rotation * Vector3::x() + Vector3::x()).norm() < 1e-15);
    let slide = with_joint("prismatic", "<limit lower='-1e200' upper='1e200'/>");
    let pose = slide.link_poses(&[1e200]).expect("one DOF")[1];
    assert_eq!(pose.translation.vector, Vector3::new(1e200, 0.0, 0.0));
}

#[test]
fn chains_may_be_as_long_as_the_file() {
    const JOINTS: usize = 30_000;
    let mut urdf = "<robot name='r'><link name='l0'/>".to_owned();
    for joint in 0..JOINTS {
        let mimic = match joint + 1 < JOINTS {
            true => format!("<mimic joint='j{}' multiplier='-1'/>", joint + 1),
            false => String::new(),
        };
        urdf += &format!(
            "<link name='l{}'/><joint name='j{joint}' type='prismatic'><parent link='l{joint}'/>\
             <child link='l{}'/><limit lower='-1' upper='1'/>{mimic}</joint>",
            joint + 1,
            joint + 1,
        );
    }
    let reference = reference(&(urdf + "</robot>"));
    assert_eq!(reference.num_dofs(), 1);
    let poses = reference.link_poses(&[0.5]).expect("one DOF");
    // Every other joint moves in the opposite direction.
    assert_eq!(poses[JOINTS].translation.vector, Vector3::zeros());
    assert_eq!(poses[JOINTS - 1].translation.vector.x, -0.5);
}

#[test]
fn joints_are_read_as_a_peer_reads_them() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots");
    let mut compared = 0;
    for entry in std::fs::read_dir(folder).expect("our robots") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "urdf") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a text");
        let ours = urdf_text::read(&text).robot.expect("a robot");
        let theirs = urdf_rs::read_from_string(&text).expect("urdf-rs reads it");
        assert_eq!(ours.joints.len(), theirs.joints.len());
        for (ours, theirs) in ours.joints.iter().zip(&theirs.joints) {
            let place = format!("{}: {}", path.display(), theirs.name);
            assert_eq!(ours.name, theirs.name);
            let kind = format!("{:?}", theirs.joint_type);
            assert_eq!(ours.joint_type.as_str(), kind, "{place}");
            let [parent, child] = [&theirs.parent.link, &theirs.child.link];
            assert_eq!([&ours.parent.link, &ours.child.link], [parent, child], "{place}");
            let origin = ours.origin.clone();
            let of = |pick: fn(&urdd_format::urdf::Origin) -> Option<[f64; 3]>| {
                origin.as_ref().and_then(pick).unwrap_or_default()
            };
            assert_eq!(of(|origin| origin.xyz), theirs.origin.xyz.0, "{place}");
            if origin.as_ref().is_none_or(|origin| origin.quat_xyzw.is_none()) {
                assert_eq!(of(|origin| origin.rpy), theirs.origin.rpy.0, "{place}");
            }
            if let Some(axis) = ours.axis.as_ref().and_then(|axis| axis.xyz) {
                assert_eq!(axis, theirs.axis.xyz.0, "{place}");
            }
            if let Some(limit) = &ours.limit {
                let limits = [limit.lower, limit.upper].map(Option::unwrap_or_default);
                assert_eq!(limits, [theirs.limit.lower, theirs.limit.upper], "{place}");
            }
            let mimic = |joint: &String, multiplier: Option<f64>, offset: Option<f64>| {
                (joint.clone(), multiplier, offset)
            };
            let ours = (ours.mimic.as_ref()).map(|m| mimic(&m.joint, m.multiplier, m.offset));
            let theirs = (theirs.mimic.as_ref()).map(|m| mimic(&m.joint, m.multiplier, m.offset));
            assert_eq!(ours, theirs, "{place}");
            compared += 1;
        }
    }
    assert!(compared > 50, "{compared}");
}
