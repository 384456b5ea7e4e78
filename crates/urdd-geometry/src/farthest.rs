//! Largest distance of a shape's points from the origin, metres.

use nalgebra::Vector3;

use super::bounding_sphere::BoundingSphere;
use super::mesh::Mesh;
use super::oriented_box::OrientedBox;

/// Distance of the farthest vertex of a mesh, which is also its farthest point; 0 without vertices.
pub fn of_mesh(mesh: &Mesh) -> f64 {
    let distances = mesh.vertices.iter().map(|p| Vector3::from(*p).norm());
    distances.fold(0.0, f64::max)
}

/// Distance of the farthest corner of a box.
pub fn of_box(shape: &OrientedBox) -> f64 {
    let corners = shape.corners();
    corners.iter().map(|p| Vector3::from(*p).norm()).fold(0.0, f64::max)
}

/// Distance of the centre plus the radius.
pub fn of_sphere(sphere: &BoundingSphere) -> f64 {
    Vector3::from(sphere.centre).norm() + sphere.radius
}
