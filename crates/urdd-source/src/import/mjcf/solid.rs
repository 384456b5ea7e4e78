//! Volumes and moments of inertia of primitives, as MuJoCo has them.

use std::f64::consts::PI;

use super::geom::Kind;

/// How much thicker MuJoCo makes an ellipsoid, to find the moments of its shell: m.
const SKIN: f64 = 1e-6;
/// Thomsen's exponent for the area of an ellipsoid.
const THOMSEN: f64 = 1.6075;

/// The volume of a primitive; of a shell, its area. 0 of what has none.
pub fn volume(kind: Kind, [a, b, c]: [f64; 3], is_shell: bool) -> f64 {
    match (kind, is_shell) {
        (Kind::Sphere, false) => 4.0 / 3.0 * PI * a.powi(3),
        (Kind::Sphere, true) => 4.0 * PI * a * a,
        (Kind::Capsule, false) => PI * a * a * (2.0 * b + 4.0 / 3.0 * a),
        (Kind::Capsule, true) => 4.0 * PI * a * (a + b),
        (Kind::Cylinder, false) => PI * a * a * 2.0 * b,
        (Kind::Cylinder, true) => 2.0 * PI * a * (a + 2.0 * b),
        (Kind::Ellipsoid, false) => 4.0 / 3.0 * PI * a * b * c,
        (Kind::Ellipsoid, true) => {
            let sum: f64 = [a * b, b * c, c * a].iter().map(|pair| pair.powf(THOMSEN)).sum();
            4.0 * PI * (sum / 3.0).powf(1.0 / THOMSEN)
        }
        (Kind::Box, false) => 8.0 * a * b * c,
        (Kind::Box, true) => 8.0 * (a * b + b * c + c * a),
        (Kind::Plane | Kind::HeightField | Kind::Mesh | Kind::DistanceField, _) => 0.0,
    }
}

/// The moments of inertia of a primitive about its axes.
pub fn moments(kind: Kind, size: [f64; 3], is_shell: bool, mass: f64) -> [f64; 3] {
    let [a, b, c] = size;
    let around = |[x, y, z]: [f64; 3], part: f64| {
        [y * y + z * z, x * x + z * z, x * x + y * y].map(|sum| sum * part)
    };
    match (kind, is_shell) {
        (Kind::Sphere, false) => [2.0 / 5.0 * mass * a * a; 3],
        (Kind::Sphere, true) => [2.0 / 3.0 * mass * a * a; 3],
        (Kind::Capsule, _) => capsule(a, b, is_shell, mass),
        (Kind::Cylinder, false) => tube(a, b, 0.5, mass),
        (Kind::Cylinder, true) => {
            let disk = mass * a / (2.0 * a + 4.0 * b);
            let [x, _, z] = tube(a, b, 1.0, mass - 2.0 * disk);
            let across = x + 2.0 * disk * (a * a / 4.0 + b * b);
            [across, across, z + disk * a * a]
        }
        (Kind::Ellipsoid, false) => around(size, mass / 5.0),
        (Kind::Ellipsoid, true) => {
            let thick = size.map(|radius| radius + SKIN);
            let [inner, outer] = [size, thick].map(|size| volume(kind, size, false));
            let density = mass / (outer - inner);
            let [inner, outer] =
                [around(size, inner * density / 5.0), around(thick, outer * density / 5.0)];
            [0, 1, 2].map(|axis| outer[axis] - inner[axis])
        }
        (Kind::Box, false) => around(size, mass / 3.0),
        (Kind::Box, true) => {
            // Two sides across each axis, in proportion to their areas.
            let area = b * c + c * a + a * b;
            let sides = [b * c, c * a, a * b].map(|side| mass * side / area);
            // The mean square of each coordinate over all sides, times the mass.
            let square = [0, 1, 2].map(|axis: usize| {
                let s = size[axis];
                let others = sides[(axis + 1) % 3] + sides[(axis + 2) % 3];
                s * s * (sides[axis] + others / 3.0)
            });
            [square[1] + square[2], square[0] + square[2], square[0] + square[1]]
        }
        (Kind::Plane | Kind::HeightField | Kind::Mesh | Kind::DistanceField, _) => [0.0; 3],
    }
}

/// A cylinder along z; `part` is 1/2 of a full one, 1 of its side alone.
fn tube(radius: f64, half: f64, part: f64, mass: f64) -> [f64; 3] {
    let along = mass * radius * radius * part;
    let across = along / 2.0 + mass * half * half / 3.0;
    [across, across, along]
}

fn capsule(radius: f64, half: f64, is_shell: bool, mass: f64) -> [f64; 3] {
    // The two half spheres together, in proportion; the centre of each is `lift` above its equator.
    let (ends, part, lift) = match is_shell {
        false => (mass * 2.0 * radius / (2.0 * radius + 3.0 * half), 2.0 / 5.0, radius * 3.0 / 8.0),
        true => (mass * radius / (radius + half), 2.0 / 3.0, radius / 2.0),
    };
    let [x, _, z] = tube(radius, half, if is_shell { 1.0 } else { 0.5 }, mass - ends);
    let sphere = part * ends * radius * radius;
    let across = x + sphere + ends * half * (half + 2.0 * lift);
    [across, across, z + sphere]
}
