//! CMP.

use serde_json::{Value, json};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;
use urdd_validate::code::Code;
use urdd_validate::code::Code::*;

use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, link, origin, solid_box};

const COMPOSITION: &str = "composition_module";

/// A gripper on an arm on a base: links and joints in the order of the composition.
fn robot() -> Robot {
    let mut robot = Robot::new("arm_and_gripper");
    for name in ["world", "a_base", "a_tip", "g_hand", "g_finger"] {
        let mut link = link(name);
        link.inertial = Some(solid_box(1.0, [0.1; 3]));
        robot.urdf.links.push(link);
    }
    for (name, joint_type, parent, child) in [
        ("stand", JointType::Fixed, "world", "a_base"),
        ("a_elbow", JointType::Continuous, "a_base", "a_tip"),
        ("mount", JointType::Fixed, "a_tip", "g_hand"),
        ("g_slide", JointType::Fixed, "g_hand", "g_finger"),
    ] {
        let mut joint = joint(name, joint_type, parent, child);
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

fn base() -> Fixture {
    Fixture::core_with(&robot(), ModuleKind::Composition, composition())
}

/// A case with some values changed.
fn case(code: Code, name: &'static str, caught: bool, changes: &[(&'static str, Value)]) -> Case {
    let changes = changes.to_vec();
    changed(code, name, caught, base, move |fixture| {
        for (pointer, value) in &changes {
            fixture.set(COMPOSITION, pointer, value.clone());
        }
    })
}

/// The gripper was itself composed of two parts; this URDD contains nothing of it.
fn nested() -> Value {
    let mut nested = composition();
    nested["parts"][1]["links"][1]["link_idx"] = json!(400);
    nested["parts"][0]["id"] = json!("gripper");
    nested
}

pub fn cases() -> Vec<Case> {
    let hand_twice =
        json!([{ "name": "hand", "link_idx": 3 }, { "name": "finger", "link_idx": 3 }]);
    let turned = json!([{ "name": "finger", "link_idx": 4 }, { "name": "hand", "link_idx": 3 }]);
    vec![
        case(CMP001, "link-beyond-the-last", true, &[("/parts/1/links/1/link_idx", json!(5))]),
        case(CMP001, "part-beyond-the-last", true, &[("/parts/1/attachment/part_idx", json!(2))]),
        // Indices of a part's own composition are those of its own modules.
        case(CMP001, "beyond-the-last-within-a-part", false, &[("/parts/1/composition", nested())]),
        case(CMP002, "two-parts-of-one-id", true, &[("/parts/1/id", json!("arm"))]),
        case(CMP002, "id-with-a-slash", true, &[("/parts/1/id", json!("arm/gripper"))]),
        case(CMP002, "ids-that-differ-in-case", false, &[("/parts/1/id", json!("Arm"))]),
        case(
            CMP003,
            "link-in-no-part",
            true,
            &[("/parts/1/links/1/link_idx", json!(3)), ("/parts/1/links", hand_twice)],
        ),
        case(CMP003, "links-that-do-not-ascend", true, &[("/parts/1/links", turned)]),
        case(CMP003, "dropped-and-there", true, &[("/parts/0/dropped_links", json!(["tip"]))]),
        // Another part may use any names.
        case(
            CMP003,
            "dropped-of-another-part",
            false,
            &[("/parts/0/dropped_links", json!(["hand"]))],
        ),
        case(CMP004, "another-prefix", true, &[("/parts/1/prefix", json!("g"))]),
        case(
            CMP004,
            "another-prefix-and-other-names",
            false,
            &[
                ("/parts/1/prefix", json!("g")),
                ("/parts/1/links/0/name", json!("_hand")),
                ("/parts/1/links/1/name", json!("_finger")),
                ("/parts/1/joints/0/name", json!("_slide")),
            ],
        ),
        case(CMP005, "on-another-link", true, &[("/parts/1/attachment/link_idx", json!(1))]),
        case(CMP005, "on-another-part", true, &[("/parts/1/attachment/part_idx", json!(1))]),
        changed(CMP005, "parts-with-the-links-of-the-others", true, base, |fixture| {
            // One to one, with correct names, but the hand is assigned to the arm.
            let name = |name: &str, idx: u32| json!({ "name": name, "link_idx": idx });
            fixture.set(COMPOSITION, "/parts/0/prefix", json!(""));
            fixture.set(COMPOSITION, "/parts/1/prefix", json!(""));
            fixture.set(
                COMPOSITION,
                "/parts/0/links",
                json!([name("a_base", 1), name("g_hand", 3)]),
            );
            fixture.set(
                COMPOSITION,
                "/parts/1/links",
                json!([name("a_tip", 2), name("g_finger", 4)]),
            );
            fixture.set(COMPOSITION, "/parts/0/joints/0/name", json!("a_elbow"));
            fixture.set(COMPOSITION, "/parts/1/joints/0/name", json!("g_slide"));
        }),
        // A part of one link; the base's link is a part too.
        changed(CMP005, "no-base", false, base, |fixture| {
            let mut world = composition()["parts"][0].clone();
            world["id"] = json!("floor");
            world["prefix"] = json!("");
            world["links"] = json!([{ "name": "world", "link_idx": 0 }]);
            world["joints"] = json!([]);
            world["attachment"] = Value::Null;
            let mut parts = composition()["parts"].clone();
            parts[0]["attachment"]["part_idx"] = json!(2);
            parts.as_array_mut().expect("parts").push(world);
            fixture.set(COMPOSITION, "/base", Value::Null);
            fixture.set(COMPOSITION, "/parts", parts);
        }),
        case(
            CMP006,
            "frozen-and-moves",
            true,
            &[("/parts/0/frozen_joints", json!([{ "joint_idx": 1, "position": [0.0] }]))],
        ),
        case(
            CMP006,
            "frozen-of-another-part",
            true,
            &[("/parts/0/frozen_joints", json!([{ "joint_idx": 3, "position": [0.0] }]))],
        ),
        case(
            CMP006,
            "frozen-twice",
            true,
            &[(
                "/parts/1/frozen_joints",
                json!([
                    { "joint_idx": 3, "position": [0.01] },
                    { "joint_idx": 3, "position": [0.02] },
                ]),
            )],
        ),
        case(
            CMP006,
            "frozen-with-two-values",
            true,
            &[("/parts/1/frozen_joints/0/position", json!([0.01, 0.02]))],
        ),
        // Its original position is no longer known.
        case(
            CMP006,
            "frozen-elsewhere",
            false,
            &[("/parts/1/frozen_joints/0/position", json!([1e9, 0.0, 3.0]))],
        ),
    ]
}
