//! Bases that many cases change, and the robots in them that only they have. Bases of before version 1 (`legacy…`) are
//! not made here: they are files, and stay as they are.

use serde_json::{Value, json};
use testkit::fixture::{Fixture, toy_robot};
use testkit::robot::{Robot, joint, link, origin, solid_box};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;

use crate::shapes::{fits, two_boxes};
use crate::{Make, canonical, loops, mesh_files, meshes, schemas};

/// Name and URDD. Files that several bases share are stored in the first of them.
pub fn shared() -> Vec<(&'static str, Make)> {
    let base = |make: fn() -> Fixture| -> Make { Box::new(move || canonical(make())) };
    let mut bases = vec![
        ("toy", base(Fixture::toy)),
        ("toy_core", base(|| Fixture::core(&toy_robot()))),
        ("composition", base(composed)),
        ("extension", base(|| extended(Fixture::toy()))),
        ("extension_core", base(|| extended(Fixture::core(&toy_robot())))),
        ("learned", base(testkit::model::fixture)),
        ("lone_box", base(fits::lone_box)),
        ("named_configurations", base(configured)),
        ("no_shapes", base(meshes::without_shapes)),
        ("placed_scenes", base(mesh_files::placed_scenes::base)),
        ("two_boxes", base(two_boxes)),
    ];
    bases.extend(loops::shared().into_iter().map(|(name, make)| (name, base(make))));
    bases.extend(schemas::shared().into_iter().filter(|(name, _)| *name != "learned"));
    bases
}

/// A toy and an extension whose schema allows everything.
pub fn extended(mut toy: Fixture) -> Fixture {
    const EXTENSION: &str = "x_acme_gripper_module";
    toy.put_file(&format!("{EXTENSION}/schema.json"), *b"true\n");
    toy.add_module(EXTENSION, json!({"grip": 1}));
    toy
}

/// A gripper on an arm on a base: links and joints in the order of the composition.
fn arm_and_gripper() -> Robot {
    in_a_line(
        ["world", "a_base", "a_tip", "g_hand", "g_finger"],
        ["stand", "a_elbow", "mount", "g_slide"],
    )
}

/// A robot of five links in a line. Its second joint turns, the others are fixed.
pub fn in_a_line(links: [&str; 5], joints: [&str; 4]) -> Robot {
    let mut robot = Robot::new("arm_and_gripper");
    for name in links {
        let mut link = link(name);
        link.inertial = Some(solid_box(1.0, [0.1; 3]));
        robot.urdf.links.push(link);
    }
    for (idx, name) in joints.into_iter().enumerate() {
        let joint_type = if idx == 1 { JointType::Continuous } else { JointType::Fixed };
        let mut joint = joint(name, joint_type, links[idx], links[idx + 1]);
        joint.origin = origin([0.0, 0.0, 0.1], [0.0; 3]);
        robot.urdf.joints.push(joint);
    }
    robot
}

fn composition() -> Value {
    let links =
        |of: [(&str, u32); 2]| of.map(|(name, idx)| json!({ "name": name, "link_idx": idx }));
    json!({
        "base": { "link_idx": 0 },
        "parts": [
            {
                "id": "arm", "name": "arm", "source": { "Urdf": "0".repeat(64) }, "prefix": "a_",
                "links": links([("base", 1), ("tip", 2)]),
                "joints": [{ "name": "elbow", "joint_idx": 1 }],
                "dropped_links": ["spare"], "dropped_joints": ["spare_joint"], "frozen_joints": [],
                "attachment": { "part_idx": null, "link_idx": 0, "joint_idx": 0 },
                "composition": null,
            },
            {
                "id": "gripper", "name": "gripper", "source": { "Urdd": "1".repeat(64) }, "prefix": "g_",
                "links": links([("hand", 3), ("finger", 4)]),
                "joints": [{ "name": "slide", "joint_idx": 3 }],
                "dropped_links": [], "dropped_joints": [],
                "frozen_joints": [{ "joint_idx": 3, "position": [0.01] }],
                "attachment": { "part_idx": 0, "link_idx": 2, "joint_idx": 2 },
                "composition": null,
            },
        ],
    })
}

pub fn composed() -> Fixture {
    Fixture::core_with(&arm_and_gripper(), ModuleKind::Composition, composition())
}

/// A small robot with two configurations. 0 is not within the bounds of the last DOF, which is locked at 0.25.
fn configured() -> Fixture {
    let mut rest = [0.0; 18];
    rest[17] = 0.25;
    let mut home = rest;
    home[..3].copy_from_slice(&[0.5, -0.25, 0.1]);
    let document = json!({ "configurations": [
        {
            "name": "home",
            "positions": [
                { "dof_name": "turn", "position": 0.5 },
                { "dof_name": "shoulder", "position": -0.25 },
                { "dof_name": "slide", "position": 0.1 },
            ],
            "configuration": home,
        },
        { "name": "rest", "positions": [], "configuration": rest },
    ]});
    Fixture::core_with(&toy_robot(), ModuleKind::NamedConfigurations, document)
}
