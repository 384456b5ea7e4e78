//! SHP.

mod distances;
pub mod fits;

use serde_json::{Value, json};
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::urdf::{Axis, Joint, JointType, Link};
use urdd_validate::code::Code::*;

use crate::legacy_robot::LegacyRobot;
use crate::meshes::{boxy, legacy, robot_of, without_shapes};
use crate::{Case, changed, invalid, near_miss};
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

fn scale(fixture: &mut Fixture, module: &str, pointer: &str, factor: f64) {
    let old = number(fixture, module, pointer);
    assert_ne!(old, 0.0);
    fixture.set(module, pointer, json!(old * factor));
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

fn exchange_rows(fixture: &mut Fixture, module: &str, matrix: &str, i: usize, j: usize) {
    let rows = fixture.doc_mut(module).pointer_mut(matrix);
    let rows = rows.and_then(Value::as_array_mut).expect("a matrix");
    assert_ne!(rows[i], rows[j]);
    rows.swap(i, j);
}

/// The first pair of hulls whose contact is never, sometimes or always, according to `reason`.
fn pair_that_is(fixture: &Fixture, reason: &str) -> (usize, usize) {
    let rows = fixture.get(SIMPLE, "/reasons/full_convex_hulls").as_array();
    let rows = rows.expect("a matrix");
    let size = rows.len();
    let mut pairs = (0..size).flat_map(|i| (i + 1..size).map(move |j| (i, j)));
    let found = pairs.find(|(i, j)| rows[*i][*j] == json!(reason));
    found.expect("the toy has every reason")
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
    let mut cases = lists();
    cases.extend(fits::cases());
    cases.extend(distances::cases());
    cases.extend(matrices());
    cases.extend(skips());
    cases.extend(legacy_cases());
    cases
}

/// SHP001 to SHP004.
fn lists() -> Vec<Case> {
    vec![
        invalid(SHP001, "box-too-many", |f| {
            f.set(APPROXIMATIONS, "/full_obbs/-", Value::Null);
        }),
        invalid(SHP001, "distance-missing", |f| {
            f.remove(REACH, "/decomposition_obbs_maximum_distances/14");
        }),
        changed(SHP001, "no-shapes", false, without_shapes, |_| {}),
        invalid(SHP002, "sphere-missing", |f| {
            f.set(APPROXIMATIONS, "/full_bounding_spheres/1", Value::Null);
        }),
        invalid(SHP002, "distance-of-nothing", |f| {
            f.set(REACH, "/full_obbs_maximum_distances/4", json!(0.5));
        }),
        changed(SHP002, "no-shapes", false, without_shapes, |_| {}),
        invalid(SHP003, "negative-half-extent", |f| {
            scale(f, APPROXIMATIONS, "/full_obbs/1/half_extents/2", -1.0);
        }),
        invalid(SHP003, "no-extent", |f| {
            f.set(APPROXIMATIONS, "/full_obbs/1/half_extents", json!([0, 0, 0]));
        }),
        invalid(SHP003, "no-radius", |f| {
            let pointer = "/decomposition_bounding_spheres/0/1/radius";
            f.set(APPROXIMATIONS, pointer, json!(0.0));
        }),
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
        invalid(SHP004, "box-reaches-farther", |f| {
            scale(f, REACH, "/full_obbs_maximum_distances/0", 1.0 + 1e-7);
        }),
        invalid(SHP004, "sphere-reaches-less", |f| {
            let pointer = "/decomposition_bounding_spheres_maximum_distances/0/1";
            scale(f, REACH, pointer, 1.0 - 1e-7);
        }),
        invalid(SHP004, "hull-out-of-its-box", |f| {
            let pointer = "/full_convex_hulls_maximum_distances/0";
            scale(f, REACH, pointer, 1.5);
        }),
        invalid(SHP004, "negative-for-a-piece", |f| {
            let pointer = "/decomposition_convex_hulls_maximum_distances/0/0";
            scale(f, REACH, pointer, -1.0);
        }),
        near_miss(SHP004, "rounded", |f| {
            scale(f, REACH, "/full_obbs_maximum_distances/0", 1.0 + 1e-10);
            let pointer = "/full_bounding_spheres_maximum_distances/0";
            scale(f, REACH, pointer, 1.0 - 1e-10);
        }),
    ]
}

/// SHP005 to SHP010, SHP015, SHP016.
fn matrices() -> Vec<Case> {
    vec![
        invalid(SHP005, "row-missing", |f| {
            f.remove(STATISTICS, "/full_obbs/min_distances/3");
        }),
        invalid(SHP005, "element-too-many", |f| {
            f.set(SKIPS, "/decomposition_obbs_skips/3/-", json!(true));
        }),
        changed(SHP005, "no-shapes", false, without_shapes, |_| {}),
        invalid(SHP006, "distance-one-way", |f| {
            let (i, j) = pair_that_is(f, "Never");
            let pointer = format!("/full_convex_hulls/max_distances/{i}/{j}");
            scale(f, STATISTICS, &pointer, 1.0 + 1e-6);
        }),
        invalid(SHP006, "skip-one-way", |f| {
            let pointer = "/full_obbs_skips/0/1";
            let old = f.get(SKIPS, pointer).as_bool().expect("a skip");
            f.set(SKIPS, pointer, json!(!old));
        }),
        invalid(SHP006, "simple-skip-one-way", |f| {
            let pointer = "/decomposition_obbs_simple_skips/0/4";
            let old = f.get(SIMPLE, pointer).as_bool().expect("a skip");
            f.set(SIMPLE, pointer, json!(!old));
        }),
        invalid(SHP006, "reason-one-way", |f| {
            let (i, j) = pair_that_is(f, "Never");
            let pointer = format!("/reasons/full_convex_hulls/{j}/{i}");
            f.set(SIMPLE, &pointer, json!("None"));
        }),
        // Rows in another order also make the diagonal and pairs of entries wrong: one mistake.
        invalid(SHP006, "rows-of-skips-exchanged", |f| {
            exchange_rows(f, SKIPS, "/full_obbs_skips", 0, 1);
        }),
        invalid(SHP006, "rows-of-simple-skips-exchanged", |f| {
            exchange_rows(f, SIMPLE, "/full_convex_hulls_simple_skips", 0, 1);
        }),
        invalid(SHP006, "rows-of-reasons-exchanged", |f| {
            exchange_rows(f, SIMPLE, "/reasons/full_convex_hulls", 0, 1);
        }),
        invalid(SHP006, "rows-of-distances-exchanged", |f| {
            exchange_rows(f, STATISTICS, "/full_obbs/max_distances", 1, 3);
        }),
        near_miss(SHP006, "rounded-one-way", |f| {
            let (i, j) = pair_that_is(f, "None");
            let pointer = format!("/full_convex_hulls/mean_distances/{i}/{j}");
            scale(f, STATISTICS, &pointer, 1.0 + 1e-12);
        }),
        invalid(SHP007, "distance-to-itself", |f| {
            f.set(STATISTICS, "/full_obbs/mean_distances/3/3", json!(0.1));
        }),
        invalid(SHP007, "not-skipped-against-itself", |f| {
            f.set(SKIPS, "/full_obbs_skips/2/2", json!(false));
        }),
        // These two shapes are alike with respect to all others, and not skipped with respect to each other.
        invalid(SHP007, "rows-exchanged-and-symmetric", |f| {
            exchange_rows(f, SIMPLE, "/full_convex_hulls_simple_skips", 6, 7);
        }),
        near_miss(SHP007, "rounded-to-itself", |f| {
            f.set(STATISTICS, "/full_obbs/mean_distances/3/3", json!(1e-15));
        }),
        invalid(SHP008, "mean-above-largest", |f| {
            let (i, j) = pair_that_is(f, "Never");
            let max = number(f, STATISTICS, &format!("/full_convex_hulls/max_distances/{i}/{j}"));
            let matrix = "/full_convex_hulls/mean_distances";
            set_pair(f, STATISTICS, matrix, (i, j), json!(max * (1.0 + 1e-10)));
        }),
        invalid(SHP008, "smallest-above-mean", |f| {
            let (i, j) = pair_that_is(f, "Never");
            let max = number(f, STATISTICS, &format!("/full_convex_hulls/max_distances/{i}/{j}"));
            let matrix = "/full_convex_hulls/min_distances";
            set_pair(f, STATISTICS, matrix, (i, j), json!(max * 1.1));
        }),
        changed(SHP008, "mean-rounded", false, two_boxes, |f| {
            let mean = number(f, STATISTICS, "/full_obbs/mean_distances/0/1");
            let matrix = "/full_obbs/mean_distances";
            set_pair(f, STATISTICS, matrix, (0, 1), json!(mean * (1.0 + 4.5e-16)));
        }),
        invalid(SHP009, "depth", |f| {
            let pair = pair_that_is(f, "None");
            set_pair(f, STATISTICS, "/full_convex_hulls/min_distances", pair, json!(-0.01));
        }),
        near_miss(SHP009, "negative-zero", |f| {
            let pair = pair_that_is(f, "None");
            set_pair(f, STATISTICS, "/full_convex_hulls/min_distances", pair, json!(-0.0));
        }),
        invalid(SHP010, "links-exchanged", |f| {
            f.set(SIMPLE, "/full_shapes/0", json!(1));
            f.set(SIMPLE, "/full_shapes/1", json!(0));
        }),
        invalid(SHP010, "another-piece", |f| {
            f.set(SKIPS, "/decomposition_shapes/1/piece_idx", json!(0));
        }),
        invalid(SHP010, "shape-missing", |f| {
            f.remove(STATISTICS, "/full_shapes/3");
        }),
        changed(SHP010, "no-shapes", false, without_shapes, |_| {}),
        invalid(SHP015, "left-out", |f| {
            f.set(STATISTICS, "/decomposition_obbs", Value::Null);
        }),
        invalid(SHP015, "reasons-left-out", |f| {
            let pointer = "/reasons/decomposition_bounding_spheres";
            f.set(SIMPLE, pointer, Value::Null);
        }),
        invalid(SHP015, "skips-left-out-with-the-statistics", |f| {
            for shapes in ["convex_hulls", "obbs", "bounding_spheres"] {
                f.set(STATISTICS, &format!("/decomposition_{shapes}"), Value::Null);
                f.set(SIMPLE, &format!("/decomposition_{shapes}_simple_skips"), Value::Null);
                f.set(SIMPLE, &format!("/reasons/decomposition_{shapes}"), Value::Null);
                f.set(SKIPS, &format!("/decomposition_{shapes}_skips"), Value::Null);
            }
        }),
        changed(SHP015, "empty", false, without_shapes, |f| {
            assert_eq!(f.get(SKIPS, "/decomposition_obbs_skips"), &json!([]));
        }),
        invalid(SHP016, "none", |f| {
            f.set(STATISTICS, "/num_samples", json!(0));
        }),
        // Two boxes that do not move are equally far apart in one sample and in eight.
        changed(SHP016, "one", false, two_boxes, |f| {
            f.set(STATISTICS, "/num_samples", json!(1));
        }),
    ]
}

/// SHP011 to SHP014.
fn skips() -> Vec<Case> {
    vec![
        invalid(SHP011, "skip-too-many", |f| {
            let pair = pair_that_is(f, "None");
            set_pair(f, SIMPLE, "/full_convex_hulls_simple_skips", pair, json!(true));
        }),
        invalid(SHP011, "skip-too-few", |f| {
            let pair = pair_that_is(f, "Always");
            set_pair(f, SIMPLE, "/full_convex_hulls_simple_skips", pair, json!(false));
        }),
        invalid(SHP011, "pieces-of-one-link", |f| {
            let matrix = "/decomposition_obbs_simple_skips";
            set_pair(f, SIMPLE, matrix, (0, 1), json!(false));
        }),
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
        invalid(SHP012, "never-for-none", |f| {
            let pair = pair_that_is(f, "None");
            set_pair(f, SIMPLE, "/reasons/full_convex_hulls", pair, json!("Never"));
        }),
        invalid(SHP012, "adjacent-for-always", |f| {
            let pair = pair_that_is(f, "Always");
            set_pair(f, SIMPLE, "/reasons/full_convex_hulls", pair, json!("Adjacent"));
        }),
        invalid(SHP012, "diagonal", |f| {
            f.set(SIMPLE, "/reasons/full_obbs/2/2", json!("Always"));
        }),
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
        invalid(SHP013, "adjacent-and-not-skipped", |f| {
            let pair = pair_that_is(f, "Adjacent");
            set_pair(f, SKIPS, "/full_convex_hulls_skips", pair, json!(false));
        }),
        invalid(SHP013, "reason-no-longer-skipped", |f| {
            let reasons = json!(["SameLink", "Always", "Default"]);
            f.set(SKIPS, "/skipped_reasons", reasons);
        }),
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
        invalid(SHP027, "out-of-order", |f| {
            let reasons = json!(["SameLink", "Adjacent", "Always", "Default"]);
            f.set(SKIPS, "/skipped_reasons", reasons);
        }),
        invalid(SHP027, "twice", |f| {
            f.set(SKIPS, "/skipped_reasons/-", json!("Default"));
        }),
        changed(SHP027, "never-too", false, two_boxes, |f| {
            assert_eq!(f.get(SIMPLE, "/reasons/full_obbs/0/1"), &json!("Adjacent"));
            f.set(SKIPS, "/skipped_reasons/-", json!("Never"));
        }),
        invalid(SHP013, "skipped-without-an-edit", |f| {
            let pair = pair_that_is(f, "None");
            let old = f.get(SKIPS, &format!("/full_convex_hulls_skips/{}/{}", pair.0, pair.1));
            let new = json!(!old.as_bool().expect("a skip"));
            set_pair(f, SKIPS, "/full_convex_hulls_skips", pair, new);
        }),
        invalid(SHP013, "edit-without-effect", |f| {
            f.set(SKIPS, "/edits/0/skip", json!(false));
        }),
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
        invalid(SHP014, "unknown-link", |f| {
            f.set(SKIPS, "/edits/0/link_b", json!("nobody"));
        }),
        changed(
            SHP014,
            "link-without-shapes",
            false,
            || Fixture::full_with_edits(&toy_robot(), vec![edit("frame", "base", true)]),
            |_| {},
        ),
    ]
}

/// The published modules: spheres measured on tessellated ones, negative distances, edits unrecorded.
fn legacy_cases() -> Vec<Case> {
    let reach = |sphere: f64| move || LegacyRobot::new("robot", 0.0).with_shapes(sphere);
    let matrices = |max: f64, simple: bool, skips: [[bool; 2]; 2]| {
        move || LegacyRobot::new("robot", 0.0).with_matrices(max, simple, skips)
    };
    let edited = [[true, true], [true, true]];
    vec![
        legacy(SHP004, "legacy-sphere-too-small", true, reach(0.49)),
        legacy(SHP004, "legacy-sphere-too-large", true, reach(0.501)),
        legacy(SHP004, "legacy-sphere-just-too-small", true, reach(0.5 - 0.5 * 0.00503)),
        legacy(SHP004, "legacy-sphere-just-tessellated", false, reach(0.5 - 0.5 * 0.00497)),
        legacy(SHP004, "legacy-sphere-tessellated", false, reach(0.499)),
        legacy(SHP006, "legacy-edit-of-one-element", true, {
            matrices(0.3, false, [[true, true], [false, true]])
        }),
        legacy(SHP011, "legacy-skip-too-few", true, matrices(-0.01, false, edited)),
        legacy(SHP011, "legacy-depth", false, matrices(-0.01, true, edited)),
        legacy(SHP009, "legacy-depth", false, matrices(-0.01, true, edited)),
        legacy(SHP013, "legacy-edit", false, matrices(0.3, false, edited)),
    ]
}
