//! SPH: spheres of links whose figures follow from them.

use serde_json::{Value, json};
use urdd_validate::code::Code;
use urdd_validate::code::Code::*;

use crate::mesh_files::{ALL, put, read};
use crate::meshes::PIECES;
use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::meshes::{Meshes, Solid, minus};
use testkit::robot::Robot;
use testkit::spheres::{
    Ball, Level, SAMPLES, SPHERES, centroids, diagonal, document, fixture_of, levels, robot,
};
use testkit::transform::norm;

/// The robot with changed spheres, and what is true of them.
fn with(change: impl Fn(&mut Robot, &mut Vec<Level>)) -> Fixture {
    let (mut robot, mut levels) = (robot(), levels());
    change(&mut robot, &mut levels);
    fixture_of(&robot, &levels, SAMPLES)
}

/// A case whose figures are right.
fn right(code: Code, name: &'static str, change: fn(&mut Robot, &mut Vec<Level>)) -> Case {
    changed(code, name, false, move || with(change), |_| {})
}

fn ball(at: [f64; 3], radius: f64) -> Ball {
    Ball { at, radius, outer: Some(0) }
}

const SLIDER: usize = 4;
const CAMERA: usize = 5;

/// The camera's box, as it is in the files.
fn camera() -> Solid {
    let of = Meshes::new(&robot()).solids.remove(CAMERA);
    of.expect("a camera").whole
}

/// The diagonal of the camera's box, m.
pub fn camera_diagonal() -> f64 {
    diagonal(&[camera()])
}

/// The distance of the camera's farthest corner from its origin, m.
pub fn camera_farthest() -> f64 {
    camera().corners.map(norm).into_iter().fold(0.0, f64::max)
}

/// The distance of the camera's farthest corner from its middle, m.
pub fn camera_radius() -> f64 {
    let of = camera();
    of.corners.map(|corner| norm(minus(corner, of.centre))).into_iter().fold(0.0, f64::max)
}

/// How far the outermost centroid is from the middle of the camera, m.
fn outermost() -> f64 {
    let of = camera();
    let centroids = centroids(&of, camera_diagonal()).into_iter();
    centroids.map(|(point, _)| norm(minus(point, of.centre))).fold(0.0, f64::max)
}

/// One level with one sphere a link, that of the camera no larger than it must be.
pub fn tight() -> Fixture {
    with(|_, levels| {
        levels.truncate(1);
        levels[0].balls[CAMERA][0] =
            Ball { at: camera().centre, radius: camera_radius(), outer: None };
    })
}

/// Sets the radius of the camera's first sphere.
pub fn set_camera(f: &mut Fixture, level: usize, radius: f64) {
    f.set(SPHERES, &format!("/levels/{level}/spheres/{CAMERA}/0/radius"), json!(radius));
}

/// A level that covers the slider's cube by spheres around 26 of its 27 parts, or around all of them.
fn around_parts(levels: &mut [Level], also_the_middle: bool) {
    let side = 0.1 / 3.0;
    let mut balls = Vec::new();
    for part in 0..27 {
        let at = [part / 9, part / 3 % 3, part % 3].map(|k| side * (f64::from(k) - 1.0));
        if part != 13 || also_the_middle {
            balls.push(ball(at, side * 0.866_026));
        }
    }
    levels[1].balls[SLIDER] = balls;
}

/// The small sphere whose surface a point of a large one is on, but for a part of its radius.
fn small(inside: f64) -> Ball {
    // Point 0, above.
    let z: f64 = 1.0 - 1.0 / 64.0;
    let way = [(1.0 - z * z).sqrt(), 0.0, z];
    ball(way.map(|x| x * (LARGE - SMALL * (1.0 - inside))), SMALL)
}

const LARGE: f64 = 0.07;
const SMALL: f64 = 0.02;

/// A sphere whose surface a point of another one is on, so that it counts.
pub fn beside_a_point() -> Fixture {
    with(|_, levels| levels[2].balls[SLIDER] = vec![ball([0.0; 3], LARGE), small(0.5e-6)])
}

/// Moves the small one, so that the point is inside by this part of its radius.
pub fn move_small(f: &mut Fixture, inside: f64) {
    let pointer = format!("/levels/2/spheres/{SLIDER}/1/offset_xyz");
    f.set(SPHERES, &pointer, json!(small(inside).at));
}

/// The radius of a sphere of the camera that reaches one of the post, m.
const REACHING: f64 = 0.045;

/// Spheres of the camera and the post that touch: nothing moves between them.
pub fn touching() -> Fixture {
    with(|_, levels| {
        let x = 0.8 - 0.105 - REACHING;
        levels[2].balls[CAMERA] = vec![ball([x, 0.0, 0.01], REACHING + 1e-9)];
        levels[0].balls[CAMERA][0].radius = 0.8;
    })
}

/// Sets how far the two are apart, m.
pub fn set_apart(f: &mut Fixture, gap: f64) {
    set_camera(f, 2, REACHING - gap);
}

/// Halves of the post that reach into each other by this part of its diagonal.
fn overlapping(part: f64) -> Fixture {
    with(move |robot, _| robot.overlap = part * 0.2 * 3.0_f64.sqrt() / 2.0)
}

/// The same, with the fit of halves of which the faces of the cut count.
fn with_faces_of_the_cut(part: f64) -> Fixture {
    let (mut of, counts) = (overlapping(part), overlapping(0.5e-6));
    for level in 0..3 {
        let pointer = format!("/levels/{level}/fits/0/uncovered_fraction");
        of.set(SPHERES, &pointer, counts.get(SPHERES, &pointer).clone());
    }
    of
}

/// A sphere that the camera's outermost centroid is in, within what counts.
pub fn in_a_sphere() -> Fixture {
    with(|_, levels| {
        let radius = outermost() - 0.5e-6 * camera_diagonal();
        levels[2].balls[CAMERA] = vec![ball(camera().centre, radius)];
    })
}

/// Sets by which part of the diagonal it is outside.
pub fn set_outermost(f: &mut Fixture, part: f64) {
    set_camera(f, 2, outermost() - part * camera_diagonal());
}

pub fn cases() -> Vec<Case> {
    vec![
        right(SPH001, "as-it-is", |_, _| {}),
        // A piece with a triangle that has no height, between the two parts of an edge.
        changed(
            SPH006,
            "triangle-without-height",
            false,
            || with(|_, _| {}),
            |f| {
                let mut mesh = read(f, PIECES, CAMERA);
                let [a, b, c] = mesh.triangles.remove(0);
                let [from, to, _] = mesh.corners([a, b, c]);
                let middle = [0, 1, 2].map(|i| f64::from(((from[i] + to[i]) / 2.0) as f32));
                let m = mesh.vertices.len() as u32;
                mesh.vertices.push(middle);
                mesh.triangles.extend([[a, m, c], [m, b, c], [a, b, m]]);
                for format in ALL {
                    put(f, PIECES, CAMERA, format, &mesh);
                }
            },
        ),
        right(SPH001, "one-level", |_, levels| levels.truncate(1)),
        changed(
            SPH001,
            "one-sample",
            false,
            || {
                let (robot, mut levels) = (robot(), levels());
                levels.truncate(2);
                fixture_of(&robot, &levels, 1)
            },
            |_| {},
        ),
        right(SPH003, "radius-of-a-micrometre", |_, levels| {
            levels[2].balls[1].push(ball([0.1, 0.0, 0.0], 1e-6));
        }),
        right(SPH004, "level-in-the-one-before", |_, levels| {
            levels.push(levels[1].clone());
            levels[3].outer = Some(1);
            for balls in &mut levels[3].balls {
                for (place, ball) in balls.iter_mut().enumerate() {
                    ball.outer = Some(place);
                }
            }
        }),
        right(SPH002, "given-level-of-one-link", |_, levels| {
            let level = &mut levels[2];
            level.balls[1..].iter_mut().for_each(Vec::clear);
            level.ignored.clear();
        }),
        right(SPH009, "links-that-others-lie-between", |_, levels| {
            let level = &mut levels[2];
            level.balls[1].clear();
            level.ignored.clear();
        }),
        right(SPH010, "two-pairs-ignored", |_, levels| levels[2].ignored.insert(0, [0, 2])),
        changed(
            SPH012,
            "ignored-pair-asked",
            true,
            || with(|_, levels| levels[2].ignored.insert(0, [0, 2])),
            |f| {
                f.remove(SPHERES, "/levels/2/ignored_pairs/0");
            },
        ),
        right(SPH011, "all-collisions-missed", |_, levels| {
            levels[2].balls.iter_mut().for_each(Vec::clear);
            levels[2].ignored.clear();
        }),
        changed(
            SPH005,
            "hole-in-the-middle",
            true,
            || with(|_, levels| around_parts(levels, false)),
            |_| {},
        ),
        right(SPH005, "no-hole-in-the-middle", |_, levels| around_parts(levels, true)),
        right(SPH005, "equal-spheres-and-one-in-another", |_, levels| {
            for balls in &mut levels[1].balls {
                if let [first, second, ..] = balls[..] {
                    balls.extend([first, Ball { radius: second.radius / 2.0, ..second }, first]);
                }
            }
        }),
        right(SPH006, "sphere-inside-another", |_, levels| {
            let first = levels[2].balls[0][0];
            levels[2].balls[0].push(Ball { radius: first.radius * 0.9, ..first });
        }),
        right(SPH006, "spheres-far-from-the-pieces", |_, levels| {
            levels[2].balls[CAMERA] = vec![ball([0.0, 0.05, 0.0], 0.004)];
        }),
        changed(
            SPH007,
            "faces-of-a-cut-counted-that-are-inside",
            true,
            || with_faces_of_the_cut(1.005e-6),
            |_| {},
        ),
        changed(
            SPH007,
            "faces-of-a-cut-that-are-barely-inside",
            false,
            || with_faces_of_the_cut(0.995e-6),
            |_| {},
        ),
        changed(SPH007, "faces-of-a-cut-counted", true, || with_faces_of_the_cut(0.04), |_| {}),
    ]
}

/// The module of a base, as a document.
#[test]
fn figures_follow_from_the_spheres() {
    let base = testkit::spheres::fixture();
    let again: Value = document(&robot(), &levels(), SAMPLES);
    assert_eq!(*base.get(SPHERES, "/levels"), again["levels"]);
    let evaluation = |level: usize, key: &str| {
        again["levels"][level]["evaluation"][key].as_u64().expect("a count")
    };
    // Each count says something.
    for key in ["num_colliding", "num_missed", "num_free", "num_false_contacts"] {
        assert!(evaluation(2, key) > 0, "{key}");
    }
    assert_eq!([0, 1].map(|level| evaluation(level, "num_missed")), [0, 0]);
}
