//! Levels that cover: each inside the one before, and every point of the pieces inside each.

use crate::cuboid;
use urdd_geometry::vector::{norm, sub};
use urdd_spheres::model::Sphere;
use urdd_spheres::module::{COUNTS, around, covering};

#[test]
fn each_level_is_inside_the_one_before_and_holds_every_point() {
    let pieces = [cuboid([0.0; 3], [0.6, 0.1, 0.08]), cuboid([0.5, 0.0, 0.0], [0.6, 0.1, 0.5])];
    let more = Sphere { centre: [-0.1, 0.0, 0.0], radius: 0.05 };
    let levels = covering(&pieces, &[more]);
    assert_eq!(levels.each_ref().map(Vec::len), COUNTS);
    let holds = |a: &Sphere, b: &Sphere| norm(sub(a.centre, b.centre)) + b.radius <= a.radius;
    assert!(holds(&levels[0][0].0, &more));
    for pair in levels.windows(2) {
        for (sphere, outer) in &pair[1] {
            assert!(holds(&pair[0][*outer].0, sphere));
        }
    }
    // Of each level, by a grid over both boxes.
    for level in &levels {
        for k in 0..20 * 20 * 20 {
            let part = [k % 20, k / 20 % 20, k / 400].map(|x| f64::from(x) / 19.0);
            for point in [
                [0.6 * part[0], 0.1 * part[1], 0.08 * part[2]],
                [0.5 + 0.1 * part[0], 0.1 * part[1], 0.5 * part[2]],
            ] {
                let held = level
                    .iter()
                    .any(|(sphere, _)| norm(sub(point, sphere.centre)) <= sphere.radius);
                assert!(held, "{point:?}");
            }
        }
    }
    // Finer levels stand off less: their volume goes down.
    let volume = |level: &Vec<(Sphere, usize)>| -> f64 {
        level.iter().map(|(sphere, _)| sphere.radius.powi(3)).sum()
    };
    assert!(volume(&levels[1]) < 0.6 * volume(&levels[0]));
    assert!(volume(&levels[2]) < 0.6 * volume(&levels[1]));
}

#[test]
fn a_link_without_pieces_has_no_spheres() {
    assert!(covering(&[], &[]).iter().all(Vec::is_empty));
}

#[test]
fn the_sphere_around_spheres_is_hardly_larger_than_the_least() {
    let ball = |x: f64, radius: f64| Sphere { centre: [x, 0.0, 0.0], radius };
    // Of two: half of both radii and the distance.
    let found = around(&[ball(-1.0, 0.5), ball(2.0, 1.0)]);
    assert!(found.radius >= 2.25 && found.radius < 2.25 * 1.01, "{}", found.radius);
    // One that holds all others is the answer.
    let found = around(&[ball(0.0, 5.0), ball(1.0, 0.1)]);
    assert!((found.radius - 5.0).abs() < 0.05, "{}", found.radius);
}
