//! Shapes as points that they share: those that URDF has beside meshes are three sets of them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::{Arc, LazyLock};

use nalgebra::Vector3;

use super::hull::Hull;
use urdd_format::urdf::Geometry;
use urdd_geometry::hull::ConvexHull;

/// Corners of the polygon around a circle.
const SIDES: usize = 32;
/// Circles of a sphere.
const RINGS: usize = 17;

/// Points in some frame, for all shapes that are these points, scaled.
#[derive(Debug)]
pub struct Solid {
    pub corners: Vec<Vector3<f64>>,
    /// Their convex hull; `None` if they span no volume.
    pub hull: Option<Hull>,
}

impl Solid {
    /// Of a convex hull's corners.
    pub fn of(corners: Vec<Vector3<f64>>) -> Arc<Self> {
        let hull = Hull::of(corners.iter().copied());
        Arc::new(Solid { corners, hull })
    }

    /// Of a convex hull.
    pub fn of_hull(hull: ConvexHull) -> Arc<Self> {
        let corners = hull.mesh().vertices.iter().copied().map(Vector3::from).collect();
        Arc::new(Solid { corners, hull: Hull::from(hull) })
    }
}

/// Points and a factor along each axis: the convex hull of the scaled points is the shape, within 2 % of its size. `None` for
/// a mesh.
pub fn solid(shape: &Geometry) -> Option<(Arc<Solid>, Vector3<f64>)> {
    static CUBE: LazyLock<Arc<Solid>> = LazyLock::new(|| Solid::of(cube()));
    static CYLINDER: LazyLock<Arc<Solid>> = LazyLock::new(|| Solid::of(cylinder()));
    static SPHERE: LazyLock<Arc<Solid>> = LazyLock::new(|| Solid::of(sphere()));
    let cylinder = |radius, length| (&CYLINDER, Vector3::new(radius, radius, length / 2.0));
    let (solid, scale) = match shape {
        Geometry::Box(of) => (&CUBE, Vector3::from(of.size) / 2.0),
        Geometry::Cylinder(of) => cylinder(of.radius, of.length),
        Geometry::Capsule(of) => cylinder(of.radius, of.length + 2.0 * of.radius),
        Geometry::Sphere(of) => (&SPHERE, Vector3::repeat(of.radius)),
        Geometry::Mesh(_) => return None,
    };
    Some((Arc::clone(solid), scale))
}

fn cube() -> Vec<Vector3<f64>> {
    let sign = |bits: usize, bit| if bits & bit == 0 { 1.0 } else { -1.0 };
    (0..8).map(|bits| Vector3::new(sign(bits, 1), sign(bits, 2), sign(bits, 4))).collect()
}

/// Of radius 1, from -1 to 1.
fn cylinder() -> Vec<Vector3<f64>> {
    let both = [-1.0, 1.0].map(|z| circle(1.0).map(move |(x, y)| Vector3::new(x, y, z)));
    both.into_iter().flatten().collect()
}

/// Of radius 1.
fn sphere() -> Vec<Vector3<f64>> {
    let rings = (0..RINGS).map(|ring| (ring as f64 / (RINGS - 1) as f64 - 0.5) * PI);
    let ring = |angle: f64| {
        let z = if angle.abs() == FRAC_PI_2 { angle.signum() } else { angle.sin() };
        circle(angle.cos()).map(move |(x, y)| Vector3::new(x, y, z))
    };
    rings.flat_map(ring).collect()
}

/// Corners of a polygon around a circle.
fn circle(radius: f64) -> impl Iterator<Item = (f64, f64)> {
    let out = radius / (PI / SIDES as f64).cos();
    (0..SIDES).map(move |side| {
        let (sine, cosine) = (side as f64 * TAU / SIDES as f64).sin_cos();
        (out * cosine, out * sine)
    })
}
