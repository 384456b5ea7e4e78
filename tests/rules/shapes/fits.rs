//! SHP017 to SHP021: boxes, spheres and largest distances, compared with the hulls and pieces.

use serde_json::json;
use urdd_validate::code::Code::*;

use super::{APPROXIMATIONS, REACH, number, scale};
use crate::legacy_robot::LegacyRobot;
use crate::meshes::{boxy, legacy, robot_of};
use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::Fixture;
use testkit::robot::*;

/// One box; the second link is only a frame, without distances.
pub fn lone_box() -> Fixture {
    Fixture::full(&robot_of(vec![boxy("a"), link("b")]))
}

/// Half extents of the box that [`boxy`] shows.
pub const BOXY: [f64; 3] = [0.05, 0.1, 0.15];

/// Turns the box of the lone box about z, and enlarges it to fit.
pub fn turn_box(f: &mut Fixture, angle: f64) {
    let ([a, b, c], (sin, cos)) = (BOXY, angle.sin_cos());
    let half = [a * cos + b * sin, a * sin + b * cos, c];
    let reach = half.iter().map(|h| h * h).sum::<f64>().sqrt();
    f.set(APPROXIMATIONS, "/full_obbs/0/half_extents", json!(half));
    f.set(APPROXIMATIONS, "/full_obbs/0/offset_rpy/2", json!(angle));
    f.set(REACH, "/full_obbs_maximum_distances/0", json!(reach));
}

/// Moves the lower side along x of the box of the lone box away from the mesh.
fn margin_below(f: &mut Fixture, by: f64) {
    let [a, b, c] = BOXY;
    let reach = ((a + by) * (a + by) + b * b + c * c).sqrt();
    let half = [a + by / 2.0, b, c];
    f.set(APPROXIMATIONS, "/full_obbs/0/half_extents", json!(half));
    f.set(APPROXIMATIONS, "/full_obbs/0/offset_xyz/0", json!(-by / 2.0));
    f.set(REACH, "/full_obbs_maximum_distances/0", json!(reach));
}

/// Moves the centre of the sphere of the lone box along z, and enlarges it to fit.
pub fn move_sphere(f: &mut Fixture, shift: f64) {
    let [a, b, c] = BOXY;
    let radius = (a * a + b * b + (c + shift) * (c + shift)).sqrt();
    let sphere = json!({ "radius": radius, "offset_xyz": [0.0, 0.0, shift] });
    f.set(APPROXIMATIONS, "/full_bounding_spheres/0", sphere);
    f.set(REACH, "/full_bounding_spheres_maximum_distances/0", json!(radius + shift));
}

/// Makes a sphere of the toy larger, and its distance from the origin with it.
fn grow_sphere(f: &mut Fixture, factor: f64) {
    let radius = number(f, APPROXIMATIONS, "/full_bounding_spheres/0/radius");
    let reach = number(f, REACH, "/full_bounding_spheres_maximum_distances/0");
    let more = radius * (factor - 1.0);
    f.set(APPROXIMATIONS, "/full_bounding_spheres/0/radius", json!(radius + more));
    f.set(REACH, "/full_bounding_spheres_maximum_distances/0", json!(reach + more));
}

/// SHP017 to SHP021.
pub fn cases() -> Vec<Case> {
    vec![
        invalid(SHP017, "box-elsewhere", |f| {
            scale(f, APPROXIMATIONS, "/full_obbs/0/offset_xyz/2", 1.01);
        }),
        invalid(SHP017, "box-too-small", |f| {
            scale(f, APPROXIMATIONS, "/decomposition_obbs/0/1/half_extents/2", 0.99);
        }),
        invalid(SHP017, "sphere-too-small", |f| {
            scale(f, APPROXIMATIONS, "/full_bounding_spheres/0/radius", 1.0 - 1e-4);
        }),
        legacy(SHP017, "legacy-box-too-small", true, || {
            let mut robot = LegacyRobot::new("robot", 0.0).with_shapes(0.5);
            robot.doc(APPROXIMATIONS)["full_obbs"][1]["half_extents"][0] = json!(0.1);
            robot
        }),
        near_miss(SHP017, "rounded", |f| grow_sphere(f, 1.0 - 1e-7)),
        invalid(SHP018, "box-with-a-margin", |f| {
            scale(f, APPROXIMATIONS, "/full_obbs/0/half_extents/1", 1.01);
        }),
        changed(SHP018, "box-with-a-margin-below", true, lone_box, |f| {
            margin_below(f, 0.001);
        }),
        invalid(SHP018, "sphere-with-a-margin", |f| grow_sphere(f, 1.0 + 1e-4)),
        near_miss(SHP018, "rounded", |f| grow_sphere(f, 1.0 + 1e-7)),
        legacy(SHP018, "legacy-margin", false, || {
            let mut robot = LegacyRobot::new("robot", 0.0).with_shapes(0.5);
            for list in ["full_obbs_maximum_distances", "full_bounding_spheres_maximum_distances"] {
                robot.doc(REACH)[list][1] = json!(0.51);
            }
            robot.doc(APPROXIMATIONS)["full_bounding_spheres"][1]["radius"] = json!(0.51);
            let half = [0.3, 0.24, 0.32].map(|h| h * 1.02);
            robot.doc(APPROXIMATIONS)["full_obbs"][1]["half_extents"] = json!(half);
            robot
        }),
        changed(SHP019, "turned", true, lone_box, |f| turn_box(f, 0.3)),
        // 1 + sin(x) cos(x) (a / b + b / a) = 1.097 times the volume.
        changed(SHP019, "turned-a-little", false, lone_box, |f| turn_box(f, 0.039)),
        legacy(SHP019, "legacy-box-too-large", true, || {
            let mut robot = LegacyRobot::new("robot", 0.0).with_shapes(0.5);
            let wide: [f64; 3] = [0.34, 0.24, 0.32];
            robot.doc(APPROXIMATIONS)["full_obbs"][1]["half_extents"] = json!(wide);
            let reach = wide.iter().map(|h| h * h).sum::<f64>().sqrt();
            robot.doc(REACH)["full_obbs_maximum_distances"][1] = json!(reach);
            robot
        }),
        changed(SHP020, "aside", true, lone_box, |f| move_sphere(f, 0.02)),
        // sqrt(0.0125 + 0.159^2) / sqrt(0.035) = 1.039 times the radius.
        changed(SHP020, "a-little-aside", false, lone_box, |f| move_sphere(f, 0.009)),
        invalid(SHP021, "nearer", |f| {
            scale(f, REACH, "/full_convex_hulls_maximum_distances/0", 1.0 - 1e-4);
        }),
        invalid(SHP021, "a-pieces", |f| {
            let pointer = "/decomposition_convex_hulls_maximum_distances/0/0";
            scale(f, REACH, pointer, 0.5);
        }),
        legacy(SHP021, "legacy-nearer", true, || {
            let mut robot = LegacyRobot::new("robot", 0.0).with_shapes(0.5);
            robot.doc(REACH)["full_convex_hulls_maximum_distances"][0] = json!(0.49);
            robot
        }),
        near_miss(SHP021, "rounded", |f| {
            scale(f, REACH, "/full_convex_hulls_maximum_distances/0", 1.0 - 1e-7);
        }),
    ]
}
