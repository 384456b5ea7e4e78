//! Volume, centre and inertia of meshes, as MuJoCo has them.

use super::model::Inertial;
use nalgebra::{Matrix3, Vector3};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;

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
