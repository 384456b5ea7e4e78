//! `link_shapes_approximations_module`: SPEC 8.2.

use super::{ConvexMeshes, Shape};
use crate::context::Context;
use crate::distinct::for_each_content;
use crate::error::GenerateError;
use urdd_format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, Obb,
};
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;
use urdd_geometry::bounding_sphere::BoundingSphere as Ball;
use urdd_geometry::hull::{ConvexHull, HullError};
use urdd_geometry::oriented_box::OrientedBox;

/// Builds the module. `known` are the boxes and spheres that need not be computed: of the hulls, then of the pieces.
///
/// # Errors
/// If cancelled, or if a mesh has no hull, which is a bug in an earlier stage.
pub(crate) fn approximations(
    context: &Context,
    solids: &ConvexMeshes,
    known: Vec<Option<Shape>>,
) -> Result<LinkShapesApproximationsModule, GenerateError> {
    let hulls =
        solids.hulls.iter().enumerate().filter_map(|(link, hull)| Some((link, hull.as_ref()?)));
    let pieces = solids.pieces.iter().enumerate();
    let pieces = pieces.flat_map(|(link, pieces)| pieces.iter().map(move |piece| (link, piece)));
    let unknown = hulls.chain(pieces).zip(&known).filter(|(_, known)| known.is_none());
    let (links, meshes): (Vec<usize>, Vec<&Mesh>) =
        unknown.map(|((link, of), _)| (link, &of.mesh)).unzip();
    let shape = |at: usize, mesh: &Mesh| {
        let shape = of_mesh(mesh);
        context.finished(ModuleKind::LinkShapesApproximations, links[at]);
        shape
    };
    let mut built = for_each_content(&meshes, &context.settings.cancellation, shape)?.into_iter();
    let found = known.into_iter().map(|known| match known {
        Some(known) => Ok(known),
        None => built.next().unwrap_or(Err(HullError::Empty)),
    });
    let found: Result<Vec<Shape>, HullError> = found.collect();
    let found = found.map_err(|error| GenerateError::internal(&context.source.shown, error))?;
    Ok(module(solids, &found))
}

/// Builds the module from the boxes and spheres of all hulls, then of all pieces.
fn module(solids: &ConvexMeshes, found: &[Shape]) -> LinkShapesApproximationsModule {
    let (of_hulls, of_pieces) = found.split_at(solids.hulls.iter().flatten().count());
    let (mut of_hulls, mut of_pieces) = (of_hulls.iter().cloned(), of_pieces.iter().cloned());
    let hulls = solids.hulls.iter();
    let full: Vec<_> = hulls.map(|hull| hull.as_ref().and_then(|_| of_hulls.next())).collect();
    let pieces: Vec<Vec<_>> = solids
        .pieces
        .iter()
        .map(|pieces| of_pieces.by_ref().take(pieces.len()).collect())
        .collect();
    let (full_obbs, full_bounding_spheres) = full.into_iter().map(Option::unzip).unzip();
    let (decomposition_obbs, decomposition_bounding_spheres) =
        pieces.into_iter().map(|pieces| pieces.into_iter().unzip()).unzip();
    LinkShapesApproximationsModule {
        full_obbs,
        full_bounding_spheres,
        decomposition_obbs,
        decomposition_bounding_spheres,
    }
}

fn of_mesh(mesh: &Mesh) -> Result<Shape, HullError> {
    let hull = ConvexHull::new(&mesh.vertices)?;
    let found = (OrientedBox::around(&hull), Ball::around(&hull));
    Ok((of_box(&found.0), of_ball(&found.1)))
}

fn of_box(found: &OrientedBox) -> Obb {
    // The rotation of an oriented box never has a pitch near a right angle.
    let (roll, pitch, yaw) = found.rotation.euler_angles();
    Obb {
        half_extents: found.half_extents,
        offset_xyz: found.centre,
        offset_rpy: [roll, pitch, yaw].map(|angle| angle + 0.0),
    }
}

fn of_ball(found: &Ball) -> BoundingSphere {
    BoundingSphere { radius: found.radius, offset_xyz: found.centre }
}
