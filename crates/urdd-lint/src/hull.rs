//! Convex hulls with what rules ask of them, and the shapes of URDF as points that they share.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::{Arc, LazyLock};

use nalgebra::Vector3;
use urdd_format::urdf::Geometry;
use urdd_geometry::hull::ConvexHull;

/// Number of points of which the hull takes the place: of more, memory would be taken for each.
const MANY: usize = 200_000;

/// A convex hull with a volume.
#[derive(Debug, Clone)]
pub struct Hull {
    pub corners: Vec<Vector3<f64>>,
    /// Its triangles, outward.
    pub triangles: Vec<[usize; 3]>,
    /// Outward unit normals of its triangles, each with its distance from the origin.
    pub planes: Vec<(Vector3<f64>, f64)>,
    /// Its volume, m³.
    pub volume: f64,
}

impl Hull {
    /// The hull of points; `None` if they span no volume.
    pub fn of(points: impl Iterator<Item = Vector3<f64>>) -> Option<Self> {
        Hull::from(ConvexHull::new(&corners(points)).ok()?)
    }

    /// Of a hull of geometry; `None` without a volume.
    pub fn from(hull: ConvexHull) -> Option<Self> {
        if hull.is_flat() {
            return None;
        }
        let mesh = hull.into_mesh();
        let triangles = mesh.triangles.iter().map(|one| one.map(|index| index as usize)).collect();
        Hull::new(mesh.vertices.into_iter().map(Vector3::from).collect(), triangles)
    }

    /// Of its corners and triangles; `None` without a volume.
    fn new(corners: Vec<Vector3<f64>>, triangles: Vec<[usize; 3]>) -> Option<Self> {
        let origin = corners[triangles.first()?[0]];
        let volume = triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|index| corners[index] - origin);
            a.dot(&b.cross(&c)) / 6.0
        });
        let volume: f64 = volume.sum();
        let planes = triangles.iter().filter_map(|&[a, b, c]| {
            let (a, b, c) = (corners[a], corners[b], corners[c]);
            let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
            Some((normal, normal.dot(&a)))
        });
        let planes = planes.collect();
        (volume > 0.0).then_some(Hull { corners, triangles, planes, volume })
    }

    /// The hull, scaled along each axis and then placed.
    pub fn mapped(
        &self,
        scale: &Vector3<f64>,
        place: impl Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<Self> {
        let corners = self.corners.iter().map(|corner| place(corner.component_mul(scale)));
        let mut triangles = self.triangles.clone();
        if scale.product() < 0.0 {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        Hull::new(corners.collect(), triangles)
    }

    /// The hull of points, or of the farthest of them in as many directions: one with many corners takes long to compare, and
    /// what is left out is a small part of the size.
    pub fn coarse(points: &[Vector3<f64>]) -> Option<Self> {
        /// Number of directions, evenly over the sphere.
        const DIRECTIONS: usize = 256;
        if points.len() <= DIRECTIONS {
            return Hull::of(points.iter().copied());
        }
        // Fibonacci's spiral.
        let turn = PI * (3.0 - 5.0_f64.sqrt());
        let directions = (0..DIRECTIONS).map(|number| {
            let z = 1.0 - (2 * number + 1) as f64 / DIRECTIONS as f64;
            let (sine, cosine) = (number as f64 * turn).sin_cos();
            let radius = (1.0 - z * z).sqrt();
            Vector3::new(radius * cosine, radius * sine, z)
        });
        let farthest = directions.filter_map(|direction| {
            let along = |point: &&Vector3<f64>| point.dot(&direction);
            points.iter().max_by(|a, b| along(a).total_cmp(&along(b))).copied()
        });
        Hull::of(farthest)
    }

    /// How far a point is outside, m, by the farthest plane of a face: at most the distance. Negative inside.
    pub fn outside(&self, point: &Vector3<f64>) -> f64 {
        let distances = self.planes.iter().map(|(normal, offset)| normal.dot(point) - offset);
        distances.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The sum of the principal moments about the centre of mass, of the hull filled evenly with 1 kg, m².
    pub fn even_trace(&self) -> f64 {
        let inside = self.corners.iter().sum::<Vector3<f64>>() / self.corners.len() as f64;
        let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), 0.0);
        // Tetrahedra from a point inside.
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|index| self.corners[index] - inside);
            let part = a.dot(&b.cross(&c)).abs() / 6.0;
            let sum = a + b + c;
            volume += part;
            first += sum * (part / 4.0);
            let squares = a.norm_squared() + b.norm_squared() + c.norm_squared();
            second += (sum.norm_squared() + squares) * (part / 20.0);
        }
        2.0 * (second / volume - (first / volume).norm_squared())
    }
}

/// Points with the convex hull of these: all of them, or the corners of the hulls of very many.
fn corners(points: impl Iterator<Item = Vector3<f64>>) -> Vec<[f64; 3]> {
    let (mut kept, mut most) = (Vec::new(), MANY);
    for point in points {
        kept.push(point.into());
        if kept.len() >= most {
            if let Ok(hull) = ConvexHull::new(&kept) {
                kept = hull.into_mesh().vertices;
            }
            most = MANY.max(2 * kept.len());
        }
    }
    kept
}

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
    pub fn of(corners: Vec<Vector3<f64>>) -> Arc<Self> {
        let hull = Hull::of(corners.iter().copied());
        Arc::new(Solid { corners, hull })
    }

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

fn circle(radius: f64) -> impl Iterator<Item = (f64, f64)> {
    let out = radius / (PI / SIDES as f64).cos();
    (0..SIDES).map(move |side| {
        let (sine, cosine) = (side as f64 * TAU / SIDES as f64).sin_cos();
        (out * cosine, out * sine)
    })
}
