//! The volume of a union of spheres.

use std::sync::OnceLock;

use super::cell::volume;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::vector::{dot, sub};

/// Sample points per sphere. For a link's spheres together, the estimate is accurate to a few percent.
const POINTS: usize = 1000;

/// Evenly distributed points in the unit ball, the same on every machine.
fn ball() -> &'static [[f64; 3]] {
    static BALL: OnceLock<Vec<[f64; 3]>> = OnceLock::new();
    BALL.get_or_init(|| {
        // The additive sequence with steps from the root of x^4 = x + 1 fills a cube evenly.
        let root = 1.220_744_084_605_759_5_f64;
        let steps = [1.0 / root, 1.0 / (root * root), 1.0 / (root * root * root)];
        let point = |n: u32| steps.map(|step| (2.0 * (0.5 + step * f64::from(n))) % 2.0 - 1.0);
        let inside = |p: &[f64; 3]| dot(*p, *p) <= 1.0;
        (0..).map(point).filter(inside).take(POINTS).collect()
    })
}

/// Estimates the volume of the union of spheres, m³: counts the points of each sphere that are in no earlier sphere.
pub fn filled(spheres: &[BoundingSphere]) -> f64 {
    let own = spheres.iter().enumerate().map(|(idx, sphere)| {
        let near: Vec<&BoundingSphere> = (spheres[..idx].iter())
            .filter(|other| {
                let reach = other.radius + sphere.radius;
                apart(&other.centre, &sphere.centre) < reach * reach
            })
            .collect();
        let is_new = |point: &&[f64; 3]| {
            let at = [0, 1, 2].map(|k| sphere.centre[k] + sphere.radius * point[k]);
            near.iter().all(|other| apart(&other.centre, &at) > other.radius * other.radius)
        };
        let new = ball().iter().filter(is_new).count();
        volume(sphere) * new as f64 / POINTS as f64
    });
    own.sum()
}

/// The square of a distance, m².
fn apart(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let between = sub(*a, *b);
    dot(between, between)
}
