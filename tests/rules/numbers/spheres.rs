//! Numbers of clause 8.9: spheres of links.

use serde_json::json;
use urdd_validate::code::Code::*;

use super::agreement::add;
use super::{Number, Sides, most, number, there};
use crate::shapes::number as value;
use crate::spheres::{
    beside_a_point, camera_diagonal, camera_farthest, camera_radius, in_a_sphere, move_small,
    set_apart, set_camera, set_outermost, tight, touching,
};
use testkit::fixture::Fixture;
use testkit::spheres::{SPHERES, fixture as base};

/// The reach of the base, m: the slider's offset, and how far it slides.
const REACH: f64 = 1.0;

/// Makes an outer sphere smaller, so that one in it sticks out by this part of it.
fn shrink(f: &mut Fixture, part: f64) {
    let radius = "/levels/0/spheres/1/0/radius";
    let before = value(f, SPHERES, radius);
    f.set(SPHERES, radius, json!(before / (1.0 + part)));
}

/// Adds to a length of the camera's fit this part of the diagonal.
fn add_to_camera(f: &mut Fixture, key: &str, part: f64) {
    add(f, SPHERES, &format!("/levels/0/fits/5/{key}"), part * camera_diagonal());
}

pub fn numbers() -> Vec<Number> {
    vec![
        number(
            "levels",
            "8.9.2",
            "1 to 16 levels",
            ("16", 16.0),
            vec![
                there("SPH001/seventeen-levels", "SPH001/sixteen-levels"),
                there("SPH001/no-levels", "SPH001/one-level"),
            ],
        ),
        number(
            "spheres-of-a-level",
            "8.9.2",
            "at most 65,536 spheres",
            ("65,536", 65_536.0),
            vec![Sides::Elsewhere(
                "cases of 10 MB: crates/urdd-validate/tests/validate/spheres.rs judges 65,536 and 65,537",
            )],
        ),
        number(
            "samples-of-spheres",
            "8.9.2",
            "from 1 to 100,000",
            ("100,000", 100_000.0),
            vec![
                there("SPH001/no-samples", "SPH001/one-sample"),
                Sides::Elsewhere(
                    "a case that takes minutes: SPH001/100001-samples, and crates/urdd-validate/tests/validate/spheres.rs",
                ),
            ],
        ),
        number(
            "sphere-in-sphere",
            "8.9.3",
            "exceeds it by at most 1e-9 of the outer radius",
            ("1e-9", 1e-9),
            vec![most(SPH004, base, shrink, 1e-9)],
        ),
        number(
            "outside-of-spheres",
            "8.9.4",
            "outside by 1e-6 of the distance of the piece's farthest vertex",
            ("1e-6", 1e-6),
            vec![most(
                SPH005,
                tight,
                |f, part| set_camera(f, 0, camera_radius() - part * camera_farthest()),
                1e-6,
            )],
        ),
        number(
            "point-in-another-sphere",
            "8.9.5",
            "than 1 - 1e-6 times its radius",
            ("1e-6", 1e-6),
            vec![most(SPH006, beside_a_point, move_small, 1e-6)],
        ),
        number(
            "centroid-in-another-piece",
            "8.9.5",
            "of the link by more than 1e-6 D",
            ("1e-6", 1e-6),
            vec![there(
                "SPH007/faces-of-a-cut-counted-that-are-inside",
                "SPH007/faces-of-a-cut-that-are-barely-inside",
            )],
        ),
        number(
            "centroid-out-of-spheres",
            "8.9.5",
            "outside by more than 1e-6 D",
            ("1e-6", 1e-6),
            vec![most(SPH007, in_a_sphere, set_outermost, 1e-6)],
        ),
        number(
            "lengths-of-a-fit",
            "8.9.5",
            "Lengths agree within 1e-6 D",
            ("1e-6", 1e-6),
            vec![
                most(SPH006, base, |f, part| add_to_camera(f, "max_standoff", part), 1e-6),
                most(SPH006, base, |f, part| add_to_camera(f, "mean_standoff", -part), 1e-6),
                most(SPH007, base, |f, part| add_to_camera(f, "max_uncovered", part), 1e-6),
            ],
        ),
        number(
            "lengths-of-a-far-fit",
            "8.9.5",
            "within 1e-7 of the distance of the pieces' farthest vertex",
            ("1e-7", 1e-7),
            vec![Sides::Elsewhere("the robots of tests/program/generate/slivers.rs")],
        ),
        number(
            "fraction-of-a-fit",
            "8.9.5",
            "and fractions within 1e-4",
            ("1e-4", 1e-4),
            vec![most(
                SPH007,
                base,
                |f, by| add(f, SPHERES, "/levels/2/fits/0/uncovered_fraction", by),
                1e-4,
            )],
        ),
        number(
            "undecided-by-rounding",
            "8.9.5",
            "a difference of less than 1e-10 D",
            ("1e-10", 1e-10),
            vec![most(SPH007, in_a_sphere, |f, more| set_outermost(f, 1e-6 + more), 1e-10)],
        ),
        number(
            "touching-spheres",
            "8.9.6",
            "larger or smaller by 1e-9 of twice the robot's reach",
            ("1e-9", 1e-9),
            vec![most(SPH008, touching, |f, part| set_apart(f, part * 2.0 * REACH), 1e-9)],
        ),
        number(
            "tolerance-of-a-count-of-spheres",
            "8.9.7",
            "by n / 10,000, rounded up",
            ("10,000", 10_000.0),
            vec![there("SPH012/two-more-colliding", "SPH012/one-more-colliding")],
        ),
    ]
}
