//! Masses with their centres and inertias: many as one, those of primitives, and those of shells and meshes as MuJoCo has
//! them.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Matrix3, Point3, UnitQuaternion, Vector3};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;

use crate::model::{Geometry, Inertial};

/// The density of what says none, kg/m³.
pub const WATER: f64 = 1000.0;

/// The inertia of moments and products: xx, yy, zz, xy, xz, yz.
pub fn tensor([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// An inertia along axes that are turned.
pub fn turned(inertia: &Matrix3<f64>, by: &UnitQuaternion<f64>) -> Matrix3<f64> {
    let rotation = by.to_rotation_matrix();
    rotation.matrix() * inertia * rotation.matrix().transpose()
}

impl Inertial {
    /// A mass about the origin, with these moments about the axes of its frame.
    pub fn along_axes(mass: f64, moments: [f64; 3]) -> Self {
        let inertia = Matrix3::from_diagonal(&moments.into());
        Inertial { mass, centre: Point3::origin(), inertia }
    }

    /// That of a primitive; of a shell, by its area.
    pub fn of_primitive(shape: &Geometry, is_shell: bool, density: f64) -> Self {
        let mass = density * volume(shape, is_shell);
        Inertial::along_axes(mass, moments(shape, is_shell, mass))
    }

    /// As it is where its frame has a pose.
    pub fn at(&self, pose: &Isometry3<f64>) -> Self {
        let inertia = turned(&self.inertia, &pose.rotation);
        Inertial { mass: self.mass, centre: pose * self.centre, inertia }
    }

    /// The same at another density.
    pub fn weighing(&self, mass: f64) -> Self {
        Inertial { mass, centre: self.centre, inertia: self.inertia * (mass / self.mass) }
    }

    /// Masses as one; none without any.
    pub fn together(parts: &[Inertial]) -> Option<Inertial> {
        if let [only] = parts {
            return Some(*only);
        }
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        let weighted: Vector3<f64> = parts.iter().map(|part| part.centre.coords * part.mass).sum();
        let centre = (!parts.is_empty()).then(|| Point3::from(weighted / mass))?;
        let inertia = parts.iter().map(|part| {
            let off = part.centre - centre;
            let around = Matrix3::identity() * off.norm_squared() - off * off.transpose();
            part.inertia + around * part.mass
        });
        Some(Inertial { mass, centre, inertia: inertia.sum() })
    }
}

/// How much thicker MuJoCo makes an ellipsoid, to find the moments of its shell: m.
const SKIN: f64 = 1e-6;
/// Thomsen's exponent for the area of an ellipsoid.
const THOMSEN: f64 = 1.6075;

/// The volume of a primitive; of a shell, its area. 0 of a mesh.
pub fn volume(shape: &Geometry, is_shell: bool) -> f64 {
    match (shape, is_shell) {
        (Geometry::Sphere(r), false) => 4.0 / 3.0 * PI * r.powi(3),
        (Geometry::Sphere(r), true) => 4.0 * PI * r * r,
        (Geometry::Capsule { radius, length }, false) => {
            PI * radius * radius * (length + 4.0 / 3.0 * radius)
        }
        (Geometry::Capsule { radius, length }, true) => 2.0 * PI * radius * (2.0 * radius + length),
        (Geometry::Cylinder { radius, length }, false) => PI * radius * radius * length,
        (Geometry::Cylinder { radius, length }, true) => 2.0 * PI * radius * (radius + length),
        (Geometry::Ellipsoid([a, b, c]), false) => 4.0 / 3.0 * PI * a * b * c,
        (Geometry::Ellipsoid([a, b, c]), true) => {
            let sum: f64 = [a * b, b * c, c * a].iter().map(|pair| pair.powf(THOMSEN)).sum();
            4.0 * PI * (sum / 3.0).powf(1.0 / THOMSEN)
        }
        (Geometry::Box([a, b, c]), false) => a * b * c,
        (Geometry::Box([a, b, c]), true) => 2.0 * (a * b + b * c + c * a),
        (Geometry::Mesh { .. }, _) => 0.0,
    }
}

/// The moments of inertia of a primitive about its axes; 0 of a mesh.
pub fn moments(shape: &Geometry, is_shell: bool, mass: f64) -> [f64; 3] {
    let around = |[x, y, z]: [f64; 3], part: f64| {
        [y * y + z * z, x * x + z * z, x * x + y * y].map(|sum| sum * part)
    };
    match (shape, is_shell) {
        (Geometry::Sphere(radius), _) => {
            let part = if is_shell { 2.0 / 3.0 } else { 2.0 / 5.0 };
            [part * mass * radius * radius; 3]
        }
        (Geometry::Capsule { radius, length }, _) => capsule(*radius, length / 2.0, is_shell, mass),
        (Geometry::Cylinder { radius, length }, false) => tube(*radius, length / 2.0, 0.5, mass),
        (Geometry::Cylinder { radius, length }, true) => {
            let (radius, half) = (*radius, length / 2.0);
            let disk = mass * radius / (2.0 * radius + 4.0 * half);
            let [x, _, z] = tube(radius, half, 1.0, mass - 2.0 * disk);
            let across = x + 2.0 * disk * (radius * radius / 4.0 + half * half);
            [across, across, z + disk * radius * radius]
        }
        (Geometry::Ellipsoid(radii), false) => around(*radii, mass / 5.0),
        (Geometry::Ellipsoid(radii), true) => {
            let thick = radii.map(|radius| radius + SKIN);
            let [inner, outer] =
                [*radii, thick].map(|radii| volume(&Geometry::Ellipsoid(radii), false));
            let density = mass / (outer - inner);
            let [inner, outer] =
                [around(*radii, inner * density / 5.0), around(thick, outer * density / 5.0)];
            [0, 1, 2].map(|axis| outer[axis] - inner[axis])
        }
        (Geometry::Box(size), false) => around(*size, mass / 12.0),
        (Geometry::Box([a, b, c]), true) => {
            // Two sides across each axis, in proportion to their areas.
            let halves = [a / 2.0, b / 2.0, c / 2.0];
            let area = b * c + c * a + a * b;
            let sides = [b * c, c * a, a * b].map(|side| mass * side / area);
            // The mean square of each coordinate over all sides, times the mass.
            let square = [0, 1, 2].map(|axis: usize| {
                let s = halves[axis];
                let others = sides[(axis + 1) % 3] + sides[(axis + 2) % 3];
                s * s * (sides[axis] + others / 3.0)
            });
            [square[1] + square[2], square[0] + square[2], square[0] + square[1]]
        }
        (Geometry::Mesh { .. }, _) => [0.0; 3],
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

/// Volumes and areas that are smaller are none.
const SMALL: f64 = 1e-15;

/// How the mass of a mesh is distributed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// That of its hull.
    Convex,
    /// That of pyramids above its triangles, all of them counted as positive.
    Legacy,
    /// That of what it encloses.
    Exact,
    /// On its surface.
    Shell,
}

/// The mass of a mesh at a density of 1, which is its volume, or of a shell its area; or what is wrong with it.
pub fn measure(mesh: &Mesh, mode: Mode) -> Result<Inertial, &'static str> {
    let hull = match mode {
        Mode::Convex => Some(ConvexHull::new(&mesh.vertices).map_err(|_| "has no convex hull")?),
        Mode::Legacy | Mode::Exact | Mode::Shell => None,
    };
    let solid = hull.as_ref().map_or(mesh, ConvexHull::mesh);
    let corners = |mesh: &Mesh| -> Vec<[Vector3<f64>; 3]> {
        mesh.triangles.iter().map(|of| mesh.corners(*of).map(Vector3::from)).collect()
    };
    let (own, triangles) = (corners(mesh), corners(solid));
    let (mut middle, mut area) = (Vector3::zeros(), 0.0);
    for corners in &own {
        let part = normal(corners).norm() / 2.0;
        middle += (corners[0] + corners[1] + corners[2]) / 3.0 * part;
        area += part;
    }
    if area < SMALL {
        return Err("has no area");
    }
    middle /= area;
    let weight = |corners: &[Vector3<f64>; 3], from: Vector3<f64>| {
        let normal = normal(corners);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let volume = (centre - from).dot(&normal) / 6.0;
        match mode {
            Mode::Shell => normal.norm() / 2.0,
            Mode::Legacy => volume.abs(),
            Mode::Convex | Mode::Exact => volume,
        }
    };
    let (mut centre, mut total) = (Vector3::zeros(), 0.0);
    for corners in &triangles {
        let part = weight(corners, middle);
        centre += ((corners[0] + corners[1] + corners[2]) / 4.0 + middle / 4.0) * part;
        total += part;
    }
    if total < SMALL {
        return Err(match mode {
            Mode::Shell => "has no area",
            _ => {
                "encloses no volume, so it has no mass; write `inertia=\"shell\"` in its `<mesh>`, or `mass=\"0\"` in its `<geom>`"
            }
        });
    }
    centre /= total;
    let (mut squares, mut mass) = (Matrix3::zeros(), 0.0);
    for corners in &triangles {
        let part = weight(corners, centre);
        let [d, e, f] = corners.map(|corner| corner - centre);
        let sum = d + e + f;
        let own = d * d.transpose() + e * e.transpose() + f * f.transpose();
        let share = if mode == Mode::Shell { 12.0 } else { 20.0 };
        squares += (own + sum * sum.transpose()) * (part / share);
        mass += part;
    }
    let inertia = Matrix3::identity() * squares.trace() - squares;
    Ok(Inertial { mass, centre: centre.into(), inertia })
}

/// Twice the area, along the normal. That of a needle is 0.
fn normal([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    let normal = (b - a).cross(&(c - a));
    if normal.norm() < SMALL { Vector3::zeros() } else { normal }
}
