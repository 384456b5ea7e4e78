//! Small URDDs that have every place of the schemas between them.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde_json::{Value, json};
use testkit::fixture::Fixture;
use testkit::robot::*;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::*;

use crate::bases::in_a_line;
use crate::meshes::{boxy, robot_of};
use crate::{Make, canonical};

/// Name and URDD, the smallest first.
pub fn shared() -> Vec<(&'static str, Make)> {
    let base = |make: fn() -> Fixture| -> Make { Box::new(move || canonical(make())) };
    vec![
        ("every_element", base(every_element)),
        ("parts_of_parts", base(parts_of_parts)),
        ("loops", base(crate::loops::linkage)),
        ("mesh_and_box", base(mesh_and_box)),
        ("learned", base(testkit::model::fixture)),
        ("spheres", base(testkit::spheres::fixture)),
    ]
}

/// They, each made once.
pub fn all() -> &'static [(&'static str, Fixture)] {
    static BASES: OnceLock<Vec<(&str, Fixture)>> = OnceLock::new();
    BASES.get_or_init(|| shared().into_iter().map(|(name, make)| (name, make())).collect())
}

/// One of them.
pub fn named(name: &str) -> Fixture {
    let found = all().iter().find(|(one, _)| *one == name);
    found.unwrap_or_else(|| panic!("no base {name}")).1.clone()
}

/// Two links with every element of a URDF, a DOF, a mimic of it, and a configuration.
fn every_element() -> Fixture {
    let mut robot = Robot::new("parts");
    robot.urdf.version = Some("1.2".to_owned());
    robot.urdf.unknown_elements = vec!["<gazebo/>".to_owned()];
    let red = Material {
        name: Some("red".to_owned()),
        color: Some(Color { rgba: [0.8, 0.1, 0.1, 1.0] }),
        texture: Some(Texture { filename: "red.png".to_owned() }),
    };
    let at = origin([0.0, 0.0, 0.1], [0.0, 0.0, 0.5]);
    let turned =
        Origin { xyz: Some([0.1, 0.0, 0.0]), rpy: None, quat_xyzw: Some([0.0, 0.0, 0.0, 1.0]) };
    let mut arm = link("arm");
    arm.inertial = Some(Inertial { origin: at.clone(), ..solid_box(1.0, [0.1; 3]) });
    arm.visual = [
        cuboid([0.1, 0.2, 0.3]),
        Geometry::Cylinder(Cylinder { radius: 0.1, length: 0.2 }),
        Geometry::Capsule(Capsule { radius: 0.1, length: 0.2 }),
        Geometry::Sphere(Sphere { radius: 0.1 }),
        mesh("arm.stl", Some([0.001; 3])),
    ]
    .into_iter()
    .map(|geometry| Visual {
        name: Some("shown".to_owned()),
        material: Some(red.clone()),
        ..visual(at.clone(), geometry)
    })
    .collect();
    arm.collision = vec![Collision {
        name: Some("hit".to_owned()),
        ..collision(Some(turned), cuboid([0.1, 0.2, 0.3]))
    }];
    arm.unknown_elements = vec!["<sensor/>".to_owned()];
    robot.urdf.materials = vec![red];
    robot.urdf.links = vec![link("base"), arm, link("tip")];
    let axis = |xyz| Some(Axis { xyz: Some(xyz) });
    let turn = Joint {
        origin: at.clone(),
        axis: axis([0.0, 0.0, 1.0]),
        limit: Some(Limit {
            acceleration: Some(2.0),
            deceleration: Some(3.0),
            jerk: Some(40.0),
            ..limit(-1.0, 1.0).expect("a limit")
        }),
        dynamics: Some(Dynamics { damping: Some(0.1), friction: Some(0.2) }),
        safety_controller: Some(SafetyController {
            soft_lower_limit: Some(-0.9),
            soft_upper_limit: Some(0.9),
            k_position: Some(15.0),
            k_velocity: Some(10.0),
        }),
        calibration: Some(Calibration { rising: Some(0.1), falling: None }),
        unknown_elements: vec!["<motor/>".to_owned()],
        ..joint("turn", JointType::Revolute, "base", "arm")
    };
    let follow = Joint {
        origin: at,
        axis: axis([0.0, 1.0, 0.0]),
        limit: limit(-1.0, 1.0),
        mimic: Some(Mimic { joint: "turn".to_owned(), multiplier: Some(0.5), offset: Some(0.1) }),
        ..joint("follow", JointType::Revolute, "arm", "tip")
    };
    robot.urdf.joints = vec![turn, follow];
    let home = json!([{ "dof_name": "turn", "position": 0.5 }]);
    let home = json!({ "name": "home", "positions": home, "configuration": [0.5] });
    let document = json!({ "configurations": [home] });
    Fixture::core_with(&robot, ModuleKind::NamedConfigurations, document)
}

/// A gripper on an arm of two joints, which was itself put together.
fn parts_of_parts() -> Fixture {
    let links = ["world", "a_base", "a_tip", "a_end", "g_hand"];
    let robot = in_a_line(links, ["stand", "a_elbow", "a_slide", "mount"]);
    let part = |id: &str, source: Value| {
        json!({
            "id": id, "name": id, "source": source, "prefix": format!("{}_", &id[..1]),
            "links": [], "joints": [], "dropped_links": [], "dropped_joints": [], "frozen_joints": [],
            "attachment": null, "composition": null,
        })
    };
    let named = |key: &str, of: &[(&str, u32)]| -> Value {
        of.iter().map(|(name, idx)| json!({ "name": name, key: idx })).collect()
    };
    let attached = |part: Value, [link, joint]: [u32; 2]| json!({ "part_idx": part, "link_idx": link, "joint_idx": joint });
    let mut arm = part("arm", json!({ "Urdd": "0".repeat(64) }));
    arm["links"] = named("link_idx", &[("base", 1), ("tip", 2), ("end", 3)]);
    arm["joints"] = named("joint_idx", &[("elbow", 1), ("slide", 2)]);
    arm["dropped_links"] = json!(["spare"]);
    arm["dropped_joints"] = json!(["spare_joint"]);
    arm["frozen_joints"] = json!([{ "joint_idx": 2, "position": [0.01] }]);
    arm["attachment"] = attached(Value::Null, [0, 0]);
    let mut lower = part("lower", json!({ "Urdf": "2".repeat(64) }));
    lower["links"] = named("link_idx", &[("base", 0), ("tip", 1), ("end", 2)]);
    lower["joints"] = named("joint_idx", &[("elbow", 0), ("slide", 1)]);
    lower["prefix"] = json!("");
    arm["composition"] = json!({ "base": null, "parts": [lower] });
    let mut gripper = part("gripper", json!({ "Urdf": "1".repeat(64) }));
    gripper["links"] = named("link_idx", &[("hand", 4)]);
    gripper["attachment"] = attached(json!(0), [3, 3]);
    let document = json!({ "base": { "link_idx": 0 }, "parts": [arm, gripper] });
    Fixture::core_with(&robot, ModuleKind::Composition, document)
}

/// A link with a mesh, and a box 1 m away.
fn mesh_and_box() -> Fixture {
    let mut with_mesh = link("a");
    with_mesh.visual = vec![visual(None, mesh("a.obj", None))];
    let mut robot = robot_of(vec![with_mesh, boxy("b")]);
    robot.meshes = BTreeMap::from([("a.obj".to_owned(), [0.1, 0.2, 0.3])]);
    Fixture::full(&robot)
}
