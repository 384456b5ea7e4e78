//! DOF. Joints of the toy: 0 tip (mimic of right), 1 turn, 2 shoulder, 3 flange (fixed), 4 slide,
//! 5 plane, 6 air (floating), 7 socket/ü, 8 spin, 9 left, 10 right (mimic of left), 11 bolt (fixed),
//! 12 locked, 13 frozen (mimic of bolt).

use serde_json::json;
use urdd_format::urdf::{JointType, Mimic};
use urdd_validate::code::Code::*;

use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, limit, link, solid_box};

const DOF: &str = "dof_module";

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

pub fn cases() -> Vec<Case> {
    let valid = |code, name, robot: fn() -> Robot| {
        changed(code, name, false, move || Fixture::core(&robot()), |_| {})
    };
    vec![
        invalid(DOF001, "one-too-few", |f| f.set(DOF, "/num_dofs", json!(17))),
        invalid(DOF001, "joint-missing", |f| {
            f.remove(DOF, "/dof_idx_to_joint_idx_mapping/4");
        }),
        invalid(DOF001, "description-missing", |f| {
            f.remove(DOF, "/dofs/17");
        }),
        near_miss(DOF001, "written-as-a-fraction", |f| {
            f.set(DOF, "/num_dofs", json!(18.0));
        }),
        invalid(DOF002, "joint-left-out", |f| {
            f.remove(DOF, "/joint_idx_to_dof_idxs_mapping/3");
        }),
        invalid(DOF002, "mimic-too-many", |f| {
            f.set(DOF, "/joint_idx_to_mimic_mapping/-", json!(null));
        }),
        valid(DOF002, "no-joints", || star(&[])),
        invalid(DOF003, "joint-has-another-dof", |f| {
            f.set(DOF, "/joint_idx_to_dof_idxs_mapping/4/0", json!(3));
        }),
        invalid(DOF003, "dof-of-another-joint", |f| {
            f.set(DOF, "/dof_idx_to_joint_idx_mapping/0", json!(2));
        }),
        invalid(DOF003, "dof-out-of-range", |f| {
            f.set(DOF, "/joint_idx_to_dof_idxs_mapping/4/0", json!(18));
        }),
        invalid(DOF003, "joint-out-of-range", |f| {
            f.set(DOF, "/dof_idx_to_joint_idx_mapping/17", json!(14));
        }),
        near_miss(DOF003, "written-as-fractions", |f| {
            f.set(DOF, "/joint_idx_to_dof_idxs_mapping/4/0", json!(2.0));
            f.set(DOF, "/dof_idx_to_joint_idx_mapping/2", json!(4.0));
        }),
        invalid(DOF004, "mimic-with-a-dof", |f| {
            f.set(DOF, "/joint_idx_to_dof_idxs_mapping/10", json!([17]));
        }),
        invalid(DOF004, "planar-joint-with-two", |f| {
            f.remove(DOF, "/joint_idx_to_dof_idxs_mapping/5/2");
        }),
        valid(DOF004, "only-fixed-joints-and-mimics-of-them", || {
            let mut robot = star(&[("a", JointType::Fixed), ("b", JointType::Revolute)]);
            robot.joint_mut("b").mimic =
                Some(Mimic { joint: "a".to_owned(), multiplier: None, offset: Some(0.5) });
            robot
        }),
        invalid(DOF005, "two-joints-swapped", |f| {
            f.set(DOF, "/dof_idx_to_joint_idx_mapping/16", json!(12));
            f.set(DOF, "/dof_idx_to_joint_idx_mapping/17", json!(9));
            f.set(DOF, "/joint_idx_to_dof_idxs_mapping/12/0", json!(16));
            f.set(DOF, "/joint_idx_to_dof_idxs_mapping/9/0", json!(17));
        }),
        invalid(DOF005, "dofs-of-one-joint-swapped", |f| {
            f.set(DOF, "/joint_idx_to_dof_idxs_mapping/5", json!([4, 3, 5]));
        }),
        valid(DOF005, "fixed-joints-between", || {
            star(&[
                ("z", JointType::Floating),
                ("y", JointType::Fixed),
                ("x", JointType::Planar),
                ("w", JointType::Fixed),
            ])
        }),
        invalid(DOF006, "another-joint", |f| {
            f.set(DOF, "/dofs/4/joint_idx", json!(6));
        }),
        invalid(DOF006, "another-joint-name", |f| {
            f.set(DOF, "/dofs/0/joint_name", json!("Turn"));
        }),
        invalid(DOF006, "planar-rotation-named-as-floating", |f| {
            f.set(DOF, "/dofs/5/name", json!("plane/rot_z"));
        }),
        invalid(DOF006, "length-for-an-angle", |f| {
            f.set(DOF, "/dofs/5/quantity", json!("Length"));
        }),
        valid(DOF006, "joint-named-as-a-dof", || {
            star(&[("a", JointType::Spherical), ("a/rot_x", JointType::Revolute)])
        }),
        invalid(DOF007, "unresolved-factor", |f| {
            f.set(DOF, "/joint_idx_to_mimic_mapping/0/multiplier", json!(10.0));
        }),
        invalid(DOF007, "offset-not-carried", |f| {
            f.set(DOF, "/joint_idx_to_mimic_mapping/0/offset", json!(0.0));
        }),
        invalid(DOF007, "another-driver", |f| {
            f.set(DOF, "/joint_idx_to_mimic_mapping/10/dof_idx", json!(15));
        }),
        invalid(DOF007, "dof-of-a-fixed-driver", |f| {
            f.set(DOF, "/joint_idx_to_mimic_mapping/13/dof_idx", json!(0));
        }),
        invalid(DOF007, "mimic-forgotten", |f| {
            f.set(DOF, "/joint_idx_to_mimic_mapping/10", json!(null));
        }),
        invalid(DOF007, "mimic-of-nothing", |f| {
            let mimic = json!({ "dof_idx": 0, "multiplier": 1.0, "offset": 0.0 });
            f.set(DOF, "/joint_idx_to_mimic_mapping/1", mimic);
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
        changed(DOF007, "product-within-binary64", false, || locked_driver(1e100), |_| {}),
        near_miss(DOF007, "factor-rounded", |f| {
            let pointer = "/joint_idx_to_mimic_mapping/10/multiplier";
            f.set(DOF, pointer, json!(-1.000_000_000_1));
        }),
    ]
}
