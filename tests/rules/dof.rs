//! DOF: robots of other joints.

use serde_json::json;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{JointType, Mimic};
use urdd_validate::code::Code::*;

use crate::{Case, changed, valid};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, limit, link, solid_box};

/// A robot of a base and these joints; each attaches its own link to the base.
pub fn star(joints: &[(&str, JointType)]) -> Robot {
    let mut robot = Robot::new("star");
    let mut base = link("base");
    base.inertial = Some(solid_box(1.0, [0.1; 3]));
    robot.urdf.links.push(base);
    for (name, joint_type) in joints {
        let child = format!("link of {name}");
        let mut joint = joint(name, *joint_type, "base", &child);
        if matches!(joint_type, JointType::Revolute | JointType::Prismatic) {
            joint.limit = limit(-1.0, 1.0);
        }
        let mut link = link(&child);
        link.inertial = Some(solid_box(1.0, [0.1; 3]));
        robot.urdf.links.push(link);
        robot.urdf.joints.push(joint);
    }
    robot
}

/// A prismatic joint that is locked at 0, a mimic of it by 1e200, and a mimic of that one by `last`.
fn locked_driver(last: f64) -> Fixture {
    let mut robot = star(&[
        ("a", JointType::Prismatic),
        ("b", JointType::Prismatic),
        ("c", JointType::Prismatic),
    ]);
    robot.joint_mut("a").limit = limit(0.0, 0.0);
    for (joint, driver, multiplier) in [("b", "a", 1e200), ("c", "b", last)] {
        let follower = robot.joint_mut(joint);
        follower.limit = None;
        follower.mimic =
            Some(Mimic { joint: driver.to_owned(), multiplier: Some(multiplier), offset: None });
    }
    Fixture::core(&robot)
}

/// Two DOFs of one name, `a/rot`, which a named configuration sets: that of the planar joint is the first.
fn of_one_name(configuration: [f64; 4]) -> Fixture {
    let robot = star(&[("a", JointType::Planar), ("a/rot", JointType::Revolute)]);
    let document = json!({ "configurations": [{
        "name": "turned",
        "positions": [{ "dof_name": "a/rot", "position": 0.5 }],
        "configuration": configuration,
    }]});
    Fixture::core_with(&robot, ModuleKind::NamedConfigurations, document)
}

pub fn cases() -> Vec<Case> {
    vec![
        changed(
            CNF004,
            "two-dofs-of-one-name",
            false,
            || of_one_name([0.0, 0.0, 0.5, 0.0]),
            |_| {},
        ),
        changed(
            CNF004,
            "second-of-two-dofs-of-one-name",
            true,
            || of_one_name([0.0, 0.0, 0.5, 0.0]),
            |f| {
                let name = "named_configurations_module";
                f.set(name, "/configurations/0/configuration", json!([0.0, 0.0, 0.0, 0.5]));
            },
        ),
        valid(DOF004, "only-fixed-joints-and-mimics-of-them", || {
            let mut robot = star(&[("a", JointType::Fixed), ("b", JointType::Revolute)]);
            robot.joint_mut("b").mimic =
                Some(Mimic { joint: "a".to_owned(), multiplier: None, offset: Some(0.5) });
            robot
        }),
        valid(DOF005, "fixed-joints-between", || {
            star(&[
                ("z", JointType::Floating),
                ("y", JointType::Fixed),
                ("x", JointType::Planar),
                ("w", JointType::Fixed),
            ])
        }),
        valid(DOF006, "joint-named-as-a-dof", || {
            star(&[("a", JointType::Spherical), ("a/rot_x", JointType::Revolute)])
        }),
        // Both mimics stand at 0, as their driver does: no pose is wrong.
        changed(
            DOF007,
            "product-beyond-binary64",
            true,
            || locked_driver(1.0),
            |f| {
                f.urdf_replace(
                    "<mimic joint=\"b\" multiplier=\"1\"/>",
                    "<mimic joint=\"b\" multiplier=\"1e200\"/>",
                );
                f.set("urdf_module", "/joints/2/mimic/multiplier", json!(1e200));
            },
        ),
        // The product is finite, the sum is not.
        changed(
            DOF007,
            "sum-beyond-binary64",
            true,
            || locked_driver(1.0),
            |f| {
                for (at, driver) in [(1, "a"), (2, "b")] {
                    let mimic = format!("<mimic joint=\"{driver}\"");
                    f.urdf_replace(&mimic, &format!("{mimic} offset=\"1e308\""));
                    f.set("urdf_module", &format!("/joints/{at}/mimic/offset"), json!(1e308));
                    let resolved = format!("/joint_idx_to_mimic_mapping/{at}/offset");
                    f.set("dof_module", &resolved, json!(1e308));
                }
            },
        ),
    ]
}
