//! Points around the shapes that URDF has beside meshes.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;

use urdd_format::urdf::Geometry;

/// Corners of the polygon around a circle.
const SIDES: usize = 32;
/// Circles of a sphere.
const RINGS: usize = 17;

/// Points whose convex hull is the shape, or holds it and is 2 % larger at most. None for a mesh.
pub fn corners(shape: &Geometry) -> Vec<Vector3<f64>> {
    match shape {
        Geometry::Box(of) => {
            let [x, y, z] = of.size.map(|size| size / 2.0);
            let signs =
                (0..8).map(|bits| [1, 2, 4].map(|bit| if bits & bit == 0 { 1.0 } else { -1.0 }));
            signs.map(|[a, b, c]| Vector3::new(a * x, b * y, c * z)).collect()
        }
        Geometry::Cylinder(of) => cylinder(of.radius, of.length),
        Geometry::Capsule(of) => cylinder(of.radius, of.length + 2.0 * of.radius),
        Geometry::Sphere(of) => {
            let rings = (0..RINGS).map(|ring| (ring as f64 / (RINGS - 1) as f64 - 0.5) * PI);
            let ring = |angle: f64| {
                let z =
                    of.radius * if angle.abs() == FRAC_PI_2 { angle.signum() } else { angle.sin() };
                circle(of.radius * angle.cos()).map(move |(x, y)| Vector3::new(x, y, z))
            };
            rings.flat_map(ring).collect()
        }
        Geometry::Mesh(_) => Vec::new(),
    }
}

fn cylinder(radius: f64, length: f64) -> Vec<Vector3<f64>> {
    let ends = [-length / 2.0, length / 2.0];
    let both = ends.map(|z| circle(radius).map(move |(x, y)| Vector3::new(x, y, z)));
    both.into_iter().flatten().collect()
}

/// Corners of a polygon around a circle.
fn circle(radius: f64) -> impl Iterator<Item = (f64, f64)> {
    let out = radius / (PI / SIDES as f64).cos();
    (0..SIDES).map(move |side| {
        let (sine, cosine) = (side as f64 * TAU / SIDES as f64).sin_cos();
        (out * cosine, out * sine)
    })
}
