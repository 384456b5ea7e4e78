//! `link_shapes_approximations_module`: SPEC 8.2.

use rayon::prelude::*;

use super::ConvexMeshes;
use crate::format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, Obb,
};
use crate::generate::meshes::written::WrittenMesh;
use crate::geometry::bounding_sphere::BoundingSphere as Ball;
use crate::geometry::hull::{ConvexHull, HullError};
use crate::geometry::oriented_box::OrientedBox;

/// Makes the module.
///
/// # Errors
/// Where a mesh has no hull: a fault of what made it.
pub(crate) fn approximations(
    solids: &ConvexMeshes,
) -> Result<LinkShapesApproximationsModule, HullError> {
    let full: Vec<Option<(Obb, BoundingSphere)>> = solids
        .hulls
        .par_iter()
        .map(|hull| hull.as_ref().map(of_mesh).transpose())
        .collect::<Result<_, _>>()?;
    let pieces: Vec<Vec<(Obb, BoundingSphere)>> = solids
        .pieces
        .par_iter()
        .map(|pieces| pieces.par_iter().map(of_mesh).collect())
        .collect::<Result<_, _>>()?;
    let (full_obbs, full_bounding_spheres) = full.into_iter().map(Option::unzip).unzip();
    let (decomposition_obbs, decomposition_bounding_spheres) = pieces
        .into_iter()
        .map(|pieces| pieces.into_iter().unzip())
        .unzip();
    Ok(LinkShapesApproximationsModule {
        full_obbs,
        full_bounding_spheres,
        decomposition_obbs,
        decomposition_bounding_spheres,
    })
}

fn of_mesh(mesh: &WrittenMesh) -> Result<(Obb, BoundingSphere), HullError> {
    let hull = ConvexHull::new(&mesh.mesh.vertices)?;
    let found = (OrientedBox::around(&hull), Ball::around(&hull));
    Ok((of_box(&found.0), of_ball(&found.1)))
}

fn of_box(found: &OrientedBox) -> Obb {
    // No box is turned so far that its pitch is near a right angle.
    let (roll, pitch, yaw) = found.rotation.euler_angles();
    Obb {
        half_extents: found.half_extents,
        offset_xyz: found.centre,
        offset_rpy: [roll, pitch, yaw].map(|angle| angle + 0.0),
    }
}

fn of_ball(found: &Ball) -> BoundingSphere {
    BoundingSphere {
        radius: found.radius,
        offset_xyz: found.centre,
    }
}
