//! A box that fits its mesh less and less.

use serde_json::json;

use super::{APPROXIMATIONS, REACH};
use crate::meshes::{boxy, robot_of};
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

/// Moves the centre of the sphere of the lone box along z, and enlarges it to fit.
pub fn move_sphere(f: &mut Fixture, shift: f64) {
    let [a, b, c] = BOXY;
    let radius = (a * a + b * b + (c + shift) * (c + shift)).sqrt();
    let sphere = json!({ "radius": radius, "offset_xyz": [0.0, 0.0, shift] });
    f.set(APPROXIMATIONS, "/full_bounding_spheres/0", sphere);
    f.set(REACH, "/full_bounding_spheres_maximum_distances/0", json!(radius + shift));
}
