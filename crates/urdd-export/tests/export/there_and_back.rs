//! Robots go to MJCF, to SDF and to USD, and come back by an import: the same poses, masses, limits and followers.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use nalgebra::Isometry3;
use urdd_export::{Choices, Format, Setup};
use urdd_format::urdf::UrdfModule;
use urdd_generate::{Selection, Settings};
use urdd_robot::Robot;

use crate::made::export;
use testkit::robots::made_named;

/// m and rad; the same of masses and limits, to their size.
const TOLERANCE: f64 = 1e-9;
/// The same of USD, whose numbers are binary32.
const SINGLE: f64 = 2e-6;
const CONFIGURATIONS: u64 = 20;

/// A robot as it comes back from a format.
fn back(robot: &Robot, format: Format, folder: &Path) -> Robot {
    let choices = Choices { samples: 100, ..Choices::default() };
    let made = export(robot, format, &choices).expect("an export");
    let file = folder.join("there/robot.xml");
    for (path, bytes) in &made.files {
        let path = folder.join("there").join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, bytes).expect("written");
    }
    fs::create_dir_all(folder.join("there")).expect("a folder");
    fs::write(&file, made.text).expect("written");
    let settings =
        Settings { selection: Selection::parse(["core"]).expect("a class"), ..Settings::default() };
    urdd_generate::generate(&file, &folder.join("back"), &settings, &()).expect("a URDD");
    Robot::open(folder.join("back")).expect("a robot")
}

/// The poses of links in that of one of them.
fn poses(robot: &Robot, q: &[f64], root: &str) -> BTreeMap<String, Isometry3<f64>> {
    let names = robot.link_names().expect("names");
    let poses = robot.link_poses(q).expect("poses");
    let at = names.iter().position(|name| name == root).expect("the root");
    let inverse = poses[at].inverse();
    names.iter().cloned().zip(poses.iter().map(|pose| inverse * pose)).collect()
}

/// Mass, centre and inertia of links whose inertias are along the axes of the link.
fn masses(robot: &UrdfModule) -> BTreeMap<&str, Vec<f64>> {
    let links = robot.links.iter().filter_map(|link| {
        let inertial = link.inertial.as_ref()?;
        let origin = inertial.origin.as_ref();
        let is_along = origin.and_then(|origin| origin.rpy).is_none_or(|rpy| rpy == [0.0; 3]);
        let [x, y, z] = origin.and_then(|origin| origin.xyz).unwrap_or_default();
        let of = inertial.inertia.as_ref()?;
        let values = vec![inertial.mass.as_ref()?.value, x, y, z];
        let moments = [of.ixx, of.ixy, of.ixz, of.iyy, of.iyz, of.izz];
        let moments = moments.map(|moment| moment.unwrap_or_default());
        is_along.then(|| (link.name.as_str(), [values, moments.to_vec()].concat()))
    });
    links.collect()
}

#[test]
fn poses_masses_limits_and_followers_come_back() {
    for name in ["six_axis_arm", "welding_arm", "hand", "quadruped"] {
        let (_folder, path) = made_named(name);
        let robot = Robot::open(&path).expect("a robot");
        let description = robot.description().expect("a description");
        let dofs = robot.dof_names().expect("names").to_vec();
        let root = robot.link_names().expect("names")[0].clone();
        for format in [Format::Mjcf, Format::Sdf, Format::Usd] {
            // The joint of its base, which moves in all ways, is a chain there.
            if (name, format) == ("quadruped", Format::Usd) {
                continue;
            }
            let most = if format == Format::Usd { SINGLE } else { TOLERANCE };
            let shown = format!("{name} by {}", format.name());
            let folder = tempfile::tempdir().expect("a folder");
            let other = back(&robot, format, folder.path());
            assert_eq!(other.dof_names().expect("names"), dofs, "{shown}");
            let after = other.description().expect("a description");
            let (a, b) = (masses(&description), masses(&after));
            let mut compared = 0;
            for (link, values) in &a {
                let Some(others) = b.get(link) else { continue };
                let scale = values.iter().fold(1e-3_f64, |most, value| most.max(value.abs()));
                for (value, other) in values.iter().zip(others) {
                    assert!((value - other).abs() <= most * scale, "{shown}: {link}: {values:?}");
                }
                compared += 1;
            }
            assert!(compared > 0, "{shown}: no mass");
            let joints = &after.joints;
            for joint in &description.joints {
                let of = joints.iter().find(|of| of.name == joint.name);
                let (Some(limit), Some(of)) = (&joint.limit, of) else { continue };
                let back = of.limit.as_ref().expect("a limit");
                let ends = [(limit.lower, back.lower), (limit.upper, back.upper)];
                for (end, back) in ends {
                    let far = end.zip(back).map(|(end, back)| (end - back).abs());
                    assert_eq!(end.is_some(), back.is_some(), "{shown}: {}", joint.name);
                    let is_near =
                        if format == Format::Usd { far <= Some(SINGLE * 7.0) } else { end == back };
                    assert!(is_near, "{shown}: {}: {back:?} for {end:?}", joint.name);
                }
                assert_eq!(joint.mimic.is_some(), of.mimic.is_some(), "{shown}: {}", joint.name);
            }
            for k in 0..CONFIGURATIONS {
                let q = robot.configurations().expect("configurations").random(k);
                let (here, there) = (poses(&robot, &q, &root), poses(&other, &q, &root));
                for (link, pose) in &here {
                    let Some(other) = there.get(link) else { continue };
                    let apart = pose.inverse() * other;
                    let apart = apart.translation.vector.norm().max(apart.rotation.angle());
                    assert!(apart < most, "{shown}: {link} is {apart} off");
                }
            }
        }
    }
}

/// A keyframe of a free root has its pose, in the URDD's setup and in the MJCF that is made of it.
#[test]
fn the_pose_of_a_free_root_in_a_keyframe_comes_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("hopper.xml");
    // A quaternion that is not of length 1, as MuJoCo takes it.
    fs::write(
        &file,
        "<mujoco model='hopper'><worldbody><body name='hip' pos='0 0 1'><freejoint/><geom size='0.1' mass='1'/>\
         <body name='shin'><joint name='knee' axis='0 1 0'/><geom size='0.05' mass='1'/></body></body></worldbody>\
         <keyframe><key name='home' qpos='0.25 -0.5 0.75 0 0 2 0 0.3'/></keyframe></mujoco>",
    )
    .expect("written");
    let path = folder.path().join("hopper");
    urdd_generate::generate(&file, &path, &Default::default(), &()).expect("a URDD");
    let robot = Robot::open(&path).expect("a robot");
    let setup = Setup::find(None, &path, &robot).expect("read");
    assert!(setup.is_some());
    let choices = Choices { setup, ..Choices::default() };
    let made = export(&robot, Format::Mjcf, &choices).expect("an export");
    let key = "<key name=\"home\" qpos=\"0.25 -0.5 0.75 0 0 1 0 0.3\"/>";
    assert!(made.text.contains(key), "{}", made.text);
}
