//! SHP.

mod distances;
mod exact;
pub mod fits;

use serde_json::{Value, json};
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::urdf::{Axis, Joint, JointType, Link};
use urdd_validate::code::Code::*;

use crate::meshes::{boxy, robot_of};
use crate::{Case, changed};
use testkit::fixture::{Fixture, toy_robot};
use testkit::robot::*;

pub const APPROXIMATIONS: &str = "link_shapes_approximations_module";
pub const REACH: &str = "link_shapes_max_distance_from_origin_module";
pub const STATISTICS: &str = "link_shapes_distance_statistics_module";
pub const SIMPLE: &str = "link_shapes_simple_skips_module";
pub const SKIPS: &str = "link_shapes_skips_module";

pub fn number(fixture: &Fixture, module: &str, pointer: &str) -> f64 {
    fixture.get(module, pointer).as_f64().expect("a number")
}

/// Sets both elements of a pair.
pub fn set_pair(
    fixture: &mut Fixture,
    module: &str,
    matrix: &str,
    (i, j): (usize, usize),
    to: Value,
) {
    fixture.set(module, &format!("{matrix}/{i}/{j}"), to.clone());
    fixture.set(module, &format!("{matrix}/{j}/{i}"), to);
}

/// Two boxes that stay 0.9 m apart.
pub fn two_boxes() -> Fixture {
    Fixture::full(&robot_of(vec![boxy("a"), boxy("b")]))
}

/// Two boxes of 0.1 m; one slides towards the other. Their centres are `apart` at 0. A link without a shape is between
/// them.
fn sliding(apart: f64, lower: f64, upper: f64) -> Fixture {
    let mut robot = robot_of(vec![boxy("a"), link("b"), boxy("c")]);
    robot.urdf.joints[1] = Joint {
        origin: origin([apart - 1.0, 0.0, 0.0], [0.0; 3]),
        axis: Some(Axis { xyz: Some([1.0, 0.0, 0.0]) }),
        limit: limit(lower, upper),
        ..joint("slide", JointType::Prismatic, "b", "c")
    };
    Fixture::full_with_edits(&robot, Vec::new())
}

/// The smallest distance of the boxes in samples is that at the bound, within the tolerance of distances.
fn just_never(f: &mut Fixture) {
    let min = number(f, STATISTICS, "/full_obbs/min_distances/0/1");
    assert!((0.001..0.004).contains(&min), "{min}");
    let near = 0.001_005;
    if min - near < 2e-5 {
        set_pair(f, STATISTICS, "/full_obbs/min_distances", (0, 1), json!(near));
    }
}

fn edit(link_a: &str, link_b: &str, skip: bool) -> SkipEdit {
    SkipEdit { link_a: link_a.to_owned(), link_b: link_b.to_owned(), skip, reason: String::new() }
}

pub fn cases() -> Vec<Case> {
    let mut cases = distances::cases();
    cases.extend(exact::cases());
    cases.extend([
        changed(
            SHP003,
            "very-thin",
            false,
            || {
                let thin =
                    Link { visual: vec![visual(None, cuboid([0.1, 0.2, 1e-6]))], ..link("a") };
                Fixture::full(&robot_of(vec![thin, boxy("b")]))
            },
            |_| {},
        ),
        // Their boxes are 0.9 mm apart.
        changed(
            SHP011,
            "just-in-contact",
            false,
            || {
                let mut robot = robot_of(vec![boxy("a"), boxy("b")]);
                robot.urdf.joints[0].origin = origin([0.1009, 0.0, 0.0], [0.0; 3]);
                Fixture::full_with_edits(&robot, Vec::new())
            },
            |f| {
                let skip = f.get(SIMPLE, "/full_obbs_simple_skips/0/1");
                assert_eq!(skip, &json!(true));
            },
        ),
        changed(
            SHP012,
            "adjacent-and-always",
            false,
            || {
                let mut robot = robot_of(vec![boxy("a"), boxy("b")]);
                robot.urdf.joints[0].origin = None;
                Fixture::full(&robot)
            },
            |f| {
                let reason = f.get(SIMPLE, "/reasons/full_obbs/0/1");
                assert_eq!(reason, &json!("Always"));
            },
        ),
        changed(
            SHP026,
            "touching-at-zero-is-default",
            true,
            || sliding(0.1, -0.3, 0.3),
            |f| {
                let pair = (0, 1);
                assert_eq!(f.get(SIMPLE, "/reasons/full_obbs/0/1"), &json!("Default"));
                set_pair(f, SIMPLE, "/reasons/full_obbs", pair, json!("None"));
                set_pair(f, SKIPS, "/full_obbs_skips", pair, json!(false));
            },
        ),
        changed(
            SHP026,
            "apart-at-zero-is-not",
            true,
            || sliding(0.3, -0.3, 0.1),
            |f| {
                set_pair(f, SIMPLE, "/reasons/full_obbs", (0, 1), json!("Default"));
                set_pair(f, SKIPS, "/full_obbs_skips", (0, 1), json!(true));
            },
        ),
        // Distances agree to 1e-5 of twice the reach and both boxes' sizes: 3e-5 m here.
        changed(
            SHP026,
            "just-apart-at-zero",
            true,
            || sliding(0.10105, -0.3, 0.3),
            |f| {
                set_pair(f, SIMPLE, "/reasons/full_obbs", (0, 1), json!("Default"));
                set_pair(f, SKIPS, "/full_obbs_skips", (0, 1), json!(true));
            },
        ),
        changed(
            SHP026,
            "just-touching-at-zero-and-not-default",
            true,
            || sliding(0.10095, -0.3, 0.3),
            |f| {
                assert_eq!(f.get(SIMPLE, "/reasons/full_obbs/0/1"), &json!("Default"));
                set_pair(f, SIMPLE, "/reasons/full_obbs", (0, 1), json!("None"));
                set_pair(f, SKIPS, "/full_obbs_skips", (0, 1), json!(false));
            },
        ),
        changed(SHP026, "just-touching-at-zero", false, || sliding(0.10095, -0.3, 0.3), |_| {}),
        // Apart by 1.005 mm and 5 mm more.
        changed(
            SHP012,
            "just-never-said-to-be-none",
            true,
            || sliding(0.101005, 0.0, 0.005),
            |f| {
                just_never(f);
                set_pair(f, SIMPLE, "/reasons/full_obbs", (0, 1), json!("None"));
            },
        ),
        changed(SHP012, "just-never", false, || sliding(0.101005, 0.0, 0.005), just_never),
        // 0 is out of bounds: at the nearest bound, the boxes are in contact.
        changed(
            SHP026,
            "touching-at-the-nearest-bound",
            false,
            || sliding(0.3, -0.9, -0.2),
            |f| {
                assert_eq!(f.get(SIMPLE, "/reasons/full_obbs/0/1"), &json!("Default"));
            },
        ),
        changed(
            SHP013,
            "edited-twice",
            false,
            || {
                let edits = vec![
                    edit("base", "arm", true),
                    edit("arm", "base", false),
                    edit("arm", "arm", false),
                ];
                Fixture::full_with_edits(&toy_robot(), edits)
            },
            |_| {},
        ),
        changed(
            SHP014,
            "link-without-shapes",
            false,
            || Fixture::full_with_edits(&toy_robot(), vec![edit("frame", "base", true)]),
            |_| {},
        ),
    ]);
    cases
}
