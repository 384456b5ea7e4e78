//! Numbers about boxes, spheres, distances, skips and the model of self-collision.

use serde_json::{Value, json};
use urdd_validate::code::Code::*;

use super::agreement::add;
use super::{Number, Sides, most, number, sides, there, wide};
use crate::meshes::{boxy, robot_of};
use crate::shapes::fits::{BOXY, lone_box, move_sphere, turn_box};
use crate::shapes::{
    APPROXIMATIONS, REACH, SIMPLE, SKIPS, STATISTICS, number as value, set_pair, two_boxes,
};
use testkit::fixture::Fixture;
use testkit::robot::origin;

/// The distance of the farthest vertex of the lone box from its link's origin, which is in its middle.
fn reach_of_box() -> f64 {
    BOXY.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The box of the lone box smaller along z by this (larger, if negative), and its farthest corner.
fn shrink_box(f: &mut Fixture, by: f64) {
    let old =
        [0, 1, 2].map(|i| value(f, APPROXIMATIONS, &format!("/full_obbs/0/half_extents/{i}")));
    let half = [old[0], old[1], old[2] - by];
    f.set(APPROXIMATIONS, "/full_obbs/0/half_extents", json!(half));
    let reach = half.iter().map(|h| h * h).sum::<f64>().sqrt();
    f.set(REACH, "/full_obbs_maximum_distances/0", json!(reach));
}

/// The sphere of the lone box, likewise.
fn shrink_sphere(f: &mut Fixture, by: f64) {
    add(f, APPROXIMATIONS, "/full_bounding_spheres/0/radius", -by);
    add(f, REACH, "/full_bounding_spheres_maximum_distances/0", -by);
}

/// A box of this many times the least volume: 1 + sin x cos x (a / b + b / a).
fn large_box(f: &mut Fixture, volume: f64) {
    let [a, b, _] = BOXY;
    turn_box(f, (2.0 * (volume - 1.0) / (a / b + b / a)).asin() / 2.0);
}

/// A sphere of this many times the least radius, whose centre is moved along z.
fn large_sphere(f: &mut Fixture, radius: f64) {
    let [a, b, c] = BOXY;
    let most = radius * reach_of_box();
    move_sphere(f, (most * most - a * a - b * b).sqrt() - c);
}

/// Multiplies a number by this and 1 more.
fn scale(f: &mut Fixture, module: &str, pointer: &str, by: f64) {
    let old = value(f, module, pointer);
    f.set(module, pointer, json!(old * (1.0 + by)));
}

fn hull_reach(f: &mut Fixture, by: f64) {
    scale(f, REACH, "/full_convex_hulls_maximum_distances/0", by);
}

/// The tolerance of distances of [`two_boxes`]: the reach is 1 m.
fn distance() -> f64 {
    1e-5 * (2.0 + 2.0 * reach_of_box())
}

/// Two boxes whose sides are this far from each other.
fn boxes_at(gap: f64) -> Fixture {
    let mut robot = robot_of(vec![boxy("a"), boxy("b")]);
    robot.urdf.joints[0].origin = origin([0.1 + gap, 0.0, 0.0], [0.0; 3]);
    Fixture::full_with_edits(&robot, Vec::new())
}

/// Two boxes that far apart, with the skips of two that touch.
fn skipped_at(f: &mut Fixture, gap: f64) {
    *f = boxes_at(gap);
    let touching = boxes_at(0.0009);
    for module in [SIMPLE, SKIPS] {
        *f.doc_mut(module) = touching.doc(module).clone();
    }
}

/// The mean of two boxes that do not move, above the largest by so many times its last place.
fn mean_above(f: &mut Fixture, by: f64) {
    let mean = value(f, STATISTICS, "/full_obbs/mean_distances/0/1");
    let max = value(f, STATISTICS, "/full_obbs/max_distances/0/1");
    assert!((mean - max).abs() < 1e-15);
    set_pair(f, STATISTICS, "/full_obbs/mean_distances", (0, 1), json!(max * (1.0 + by)));
}

pub fn numbers() -> Vec<Number> {
    let mut numbers = fits();
    numbers.extend(distances());
    numbers
}

fn fits() -> Vec<Number> {
    let at = 1e-6 * reach_of_box();
    vec![
        number(
            "fit",
            "8.2",
            "to a tolerance of 1e-6 of the distance",
            ("1e-6", 1e-6),
            vec![
                most(SHP017, lone_box, shrink_box, at),
                most(SHP017, lone_box, shrink_sphere, at),
                most(SHP018, lone_box, |f, by| shrink_box(f, -by), at),
                most(SHP018, lone_box, |f, by| shrink_sphere(f, -by), at),
            ],
        ),
        number(
            "large-box",
            "8.2",
            "at most 1.1 times that of the box",
            ("1.1", 1.1),
            vec![sides(SHP019, lone_box, large_box, 1.1, [1.1005, 1.0995])],
        ),
        number(
            "large-sphere",
            "8.2",
            "at most 1.05 times that of the least sphere",
            ("1.05", 1.05),
            vec![sides(SHP020, lone_box, large_sphere, 1.05, [1.0505, 1.0495])],
        ),
        number(
            "hull-in-its-box",
            "8.3",
            "than 1 + 1e-6 times the smaller",
            ("1e-6", 1e-6),
            vec![most(SHP004, lone_box, hull_reach, 1e-6)],
        ),
        number(
            "reach-of-a-hull",
            "8.3",
            "within 1e-6 of that distance",
            ("1e-6", 1e-6),
            vec![most(SHP021, lone_box, |f, by| hull_reach(f, -by), 1e-6)],
        ),
    ]
}

fn distances() -> Vec<Number> {
    let all = |f: &mut Fixture, by: f64| {
        for key in ["mean", "min", "max"] {
            let matrix = format!("/full_obbs/{key}_distances");
            let old = value(f, STATISTICS, &format!("{matrix}/0/1"));
            set_pair(f, STATISTICS, &matrix, (0, 1), json!(old + by));
        }
    };
    vec![
        number(
            "symmetry",
            "8.4",
            "within 1e-9 of the larger absolute value, or within 1e-12",
            ("1e-9", 1e-9),
            vec![
                most(
                    SHP006,
                    two_boxes,
                    |f, by| scale(f, STATISTICS, "/full_obbs/max_distances/0/1", by),
                    1e-9,
                ),
                most(
                    SHP007,
                    two_boxes,
                    |f, by| f.set(STATISTICS, "/full_obbs/mean_distances/1/1", json!(by)),
                    1e-12,
                ),
            ],
        ),
        number(
            "pieces",
            "8.4",
            "up to 500 pieces",
            ("500", 500.0),
            vec![Sides::Elsewhere("no case yet: 500 pieces are 1,500 mesh files")],
        ),
        number(
            "samples",
            "8.5",
            "MUST be at least 1",
            ("1", 1.0),
            vec![there("SHP016/none", "SHP016/one")],
        ),
        number(
            "mean-of-samples",
            "8.5",
            "times 2^-52 of the larger absolute value",
            ("2^-52", f64::EPSILON),
            // Of eight samples; a distance of 0.9 m has its last place at 2^-53.
            vec![wide(
                SHP008,
                two_boxes,
                mean_above,
                8.0 * f64::EPSILON,
                [9.0 * f64::EPSILON, 7.0 * f64::EPSILON],
                "numbers are binary64",
            )],
        ),
        number(
            "distance",
            "8.5",
            "distances agree within 1e-5",
            ("1e-5", 1e-5),
            vec![
                most(
                    SHP022,
                    two_boxes,
                    |f, by| {
                        let old = value(f, STATISTICS, "/full_obbs/min_distances/0/1");
                        set_pair(
                            f,
                            STATISTICS,
                            "/full_obbs/min_distances",
                            (0, 1),
                            json!(old - by),
                        );
                    },
                    distance(),
                ),
                most(SHP024, two_boxes, all, distance()),
            ],
        ),
        number(
            "contact",
            "8.6",
            "the pair's `max_distances` is at most 0.001 m",
            ("0.001", 0.001),
            vec![most(SHP011, two_boxes, skipped_at, 0.001)],
        ),
        number(
            "contact-in-samples",
            "8.6",
            "more than 0.001 m plus the tolerance of 8.5 in another",
            ("0.001", 0.001),
            vec![there("SHP025/legacy-stale", "SHP025/legacy-always-in-contact")],
        ),
        number(
            "always",
            "8.6",
            "its largest sampled distance is at most 0.001 m",
            ("0.001", 0.001),
            vec![most(SHP012, two_boxes, always_at, 0.001)],
        ),
        number(
            "contact-at-rest",
            "8.6",
            "(9.4) is at most 0.001 m",
            ("0.001", 0.001),
            vec![there("SHP026/just-apart-at-zero", "SHP026/just-touching-at-zero")],
        ),
        number(
            "never",
            "8.6",
            "its smallest sampled distance is more than 0.001 m",
            ("0.001", 0.001),
            vec![there("SHP012/just-never-said-to-be-none", "SHP012/just-never")],
        ),
        number(
            "legacy-sphere",
            "10.5",
            "up to 0.5 % of the radius",
            ("0.5 %", 0.005),
            vec![there(
                "SHP004/legacy-sphere-just-too-small",
                "SHP004/legacy-sphere-just-tessellated",
            )],
        ),
    ]
}

/// Two boxes that far apart that are said to be skipped rightly, with the reason of two that touch.
fn always_at(f: &mut Fixture, gap: f64) {
    *f = boxes_at(gap);
    let touching = boxes_at(0.0009);
    let reasons = touching.get(SIMPLE, "/reasons/full_obbs").clone();
    if gap > 0.001 {
        f.set(SIMPLE, "/reasons/full_obbs", reasons);
        let skips: Value = touching.get(SKIPS, "/full_obbs_skips").clone();
        f.set(SKIPS, "/full_obbs_skips", skips);
    }
}
