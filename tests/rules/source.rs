use serde_json::json;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{Axis, Inertia, Inertial, JointType, Limit, Mass, Mimic};
use urdd_validate::code::Code::{self, *};

use crate::{Case, changed};
use testkit::fixture::{Fixture, toy_robot};
use testkit::robot::{Robot, cuboid, joint, limit, link, mesh, visual};

/// A faithful URDD of class Core of a changed toy. All its modules follow the change.
fn robot(code: Code, name: &'static str, odd: bool, change: impl Fn(&mut Robot) + 'static) -> Case {
    let base = move || {
        let mut robot = toy_robot();
        change(&mut robot);
        Fixture::core(&robot)
    };
    changed(code, name, odd, base, |_| {})
}

fn odd(code: Code, name: &'static str, change: impl Fn(&mut Robot) + 'static) -> Case {
    robot(code, name, true, change)
}

fn fine(code: Code, name: &'static str, change: impl Fn(&mut Robot) + 'static) -> Case {
    robot(code, name, false, change)
}

pub fn cases() -> Vec<Case> {
    let mut cases = limits();
    cases.extend(files());
    cases
}

/// Up to 1.
fn limit_of(lower: f64, effort: Option<f64>, velocity: Option<f64>) -> Option<Limit> {
    Some(Limit { upper: Some(1.0), effort, velocity, ..limit_from(Some(lower))? })
}

fn limit_from(lower: Option<f64>) -> Option<Limit> {
    Some(Limit {
        lower,
        upper: None,
        effort: Some(1.0),
        velocity: Some(1.0),
        acceleration: None,
        deceleration: None,
        jerk: None,
    })
}

fn mimic(joint: &str, multiplier: f64, offset: f64) -> Option<Mimic> {
    Some(Mimic { joint: joint.to_owned(), multiplier: Some(multiplier), offset: Some(offset) })
}

fn limits() -> Vec<Case> {
    vec![
        odd(SRC001, "crossed", |robot| {
            robot.joint_mut("turn").limit = limit(1.0, -1.0);
        }),
        odd(SRC001, "absent-upper-is-zero", |robot| {
            robot.joint_mut("turn").limit = limit_from(Some(0.5));
        }),
        fine(SRC001, "lower-equals-upper", |robot| {
            robot.joint_mut("turn").limit = limit(-0.5, -0.5);
            robot.joint_mut("slide").limit = limit_from(Some(-0.5));
            // They have no meaning for a continuous joint.
            robot.joint_mut("spin").limit = limit(1.0, -1.0);
        }),
        fine(SRC002, "to-the-very-end", |robot| {
            robot.joint_mut("tip").limit = limit(-0.299_999_9, 0.1);
            robot.joint_mut("frozen").limit = limit(0.5, 0.5);
        }),
        fine(SRC002, "driver-without-limits", |robot| {
            robot.joint_mut("frozen").mimic = mimic("spin", 5.0, 0.0);
        }),
        odd(SRC006, "revolute-without-limit", |robot| {
            robot.joint_mut("turn").limit = None;
        }),
        odd(SRC006, "prismatic-with-an-empty-limit", |robot| {
            robot.joint_mut("slide").limit = limit_from(None);
        }),
        odd(SRC009, "revolute-without-effort-and-speed", |robot| {
            robot.joint_mut("turn").limit = limit_of(-1.0, Some(0.0), Some(0.0));
        }),
        fine(SRC009, "one-of-the-two", |robot| {
            robot.joint_mut("turn").limit = limit_of(-1.0, Some(0.0), Some(1.0));
            robot.joint_mut("slide").limit = limit_of(0.0, Some(0.0), None);
        }),
        fine(SRC009, "locked-or-left-out-or-a-mimic", |robot| {
            robot.joint_mut("locked").limit = limit_of(1.0, Some(0.0), Some(0.0));
            robot.joint_mut("turn").limit = limit_of(-1.0, None, None);
            let limit = robot.joint_mut("right").limit.as_mut().expect("it has");
            (limit.effort, limit.velocity) = (Some(0.0), Some(0.0));
        }),
        fine(SRC006, "mimic-without-limit", |robot| {
            robot.joint_mut("right").limit = None;
            robot.joint_mut("turn").limit = limit_from(Some(-1.0));
        }),
    ]
}

pub fn of(mass: f64, [ixx, iyy, izz]: [f64; 3]) -> Option<Inertial> {
    Some(Inertial {
        origin: None,
        mass: Some(Mass { value: mass }),
        inertia: Some(Inertia {
            ixx: Some(ixx),
            ixy: Some(0.0),
            ixz: Some(0.0),
            iyy: Some(iyy),
            iyz: Some(0.0),
            izz: Some(izz),
        }),
    })
}

fn files() -> Vec<Case> {
    let with_mesh = |file: &'static str| {
        move || {
            let mut robot = Robot::new("meshes");
            robot.meshes.insert("found.stl".to_owned(), [0.1; 3]);
            robot.urdf.links = vec![link("a"), link("b")];
            robot.urdf.joints = vec![joint("j", JointType::Fixed, "a", "b")];
            robot.link_mut("a").visual = vec![visual(None, cuboid([0.1; 3]))];
            robot.link_mut("b").visual = vec![visual(None, mesh(file, None))];
            Fixture::full(&robot)
        }
    };
    // Which of two bounds is the larger does not matter to the default configuration (SPEC 9.4): 0 is between the first
    // two, and 0.5 is the nearer one of the others.
    let crossed = || {
        let mut robot = toy_robot();
        robot.joint_mut("turn").limit = limit(1.0, -1.0);
        robot.joint_mut("shoulder").limit = limit(1.0, 0.5);
        let mut rest = [0.0; 18];
        (rest[1], rest[17]) = (0.5, 0.25);
        let rest = json!([{"name": "rest", "positions": [], "configuration": rest}]);
        let document = json!({ "configurations": rest });
        Fixture::core_with(&robot, ModuleKind::NamedConfigurations, document)
    };
    vec![
        changed(SRC001, "crossed-and-a-default-configuration", true, crossed, |_| {}),
        changed(SRC007, "not-found", true, with_mesh("lost.stl"), |_| {}),
        changed(SRC007, "found", false, with_mesh("found.stl"), |_| {}),
        changed(
            SRC008,
            "the-first-counts-that-says-nothing",
            true,
            || {
                let mut robot = toy_robot();
                robot.joint_mut("spin").axis = Some(Axis { xyz: None });
                Fixture::core(&robot)
            },
            |urdd| urdd.urdf_replace("<axis/>", "<axis/><axis xyz=\"0 0 2\"/>"),
        ),
    ]
}
