//! `link_shapes_max_distance_from_origin_module`: SPEC 8.3.

use super::ConvexMeshes;
use crate::meshes::written::WrittenMesh;
use urdd_format::link_shapes_approximations::LinkShapesMaxDistanceFromOriginModule;
use urdd_format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, Obb,
};
use urdd_geometry::bounding_sphere::BoundingSphere as Ball;
use urdd_geometry::farthest;
use urdd_geometry::oriented_box::OrientedBox;
use urdd_kinematics::rotation::from_rpy;

pub(crate) fn max_distances(
    solids: &ConvexMeshes,
    of: &LinkShapesApproximationsModule,
) -> LinkShapesMaxDistanceFromOriginModule {
    LinkShapesMaxDistanceFromOriginModule {
        full_convex_hulls_maximum_distances: maybe(solids.hulls, of_mesh),
        full_obbs_maximum_distances: maybe(&of.full_obbs, of_box),
        full_bounding_spheres_maximum_distances: maybe(&of.full_bounding_spheres, of_sphere),
        decomposition_convex_hulls_maximum_distances: each(solids.pieces, of_mesh),
        decomposition_obbs_maximum_distances: each(&of.decomposition_obbs, of_box),
        decomposition_bounding_spheres_maximum_distances: each(
            &of.decomposition_bounding_spheres,
            of_sphere,
        ),
    }
}

fn maybe<T>(shapes: &[Option<T>], distance: fn(&T) -> f64) -> Vec<Option<f64>> {
    shapes.iter().map(|shape| shape.as_ref().map(distance)).collect()
}

fn each<T>(shapes: &[Vec<T>], distance: fn(&T) -> f64) -> Vec<Vec<f64>> {
    shapes.iter().map(|pieces| pieces.iter().map(distance).collect()).collect()
}

fn of_mesh(mesh: &WrittenMesh) -> f64 {
    farthest::of_mesh(&mesh.mesh)
}

fn of_box(of: &Obb) -> f64 {
    farthest::of_box(&OrientedBox {
        centre: of.offset_xyz,
        half_extents: of.half_extents,
        rotation: from_rpy(of.offset_rpy),
    })
}

fn of_sphere(of: &BoundingSphere) -> f64 {
    farthest::of_sphere(&Ball { centre: of.offset_xyz, radius: of.radius })
}
