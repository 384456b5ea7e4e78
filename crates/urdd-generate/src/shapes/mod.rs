//! The link shape modules, SPEC 8: convex meshes, and `link_shapes_approximations_module`, SPEC 8.2, and
//! `link_shapes_max_distance_from_origin_module`, SPEC 8.3.

pub(crate) mod skips;
pub(crate) mod statistics;

use std::sync::Arc;

use crate::context::Context;
use crate::error::{GenerateError, Result};
use crate::made::{Shared, made_with};
use crate::meshes::{WrittenMesh, for_each_content};
use urdd_format::index::{LinkIdx, PieceIdx};
use urdd_format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, LinkShapesMaxDistanceFromOriginModule, Obb,
};
use urdd_format::registry::ModuleKind;
use urdd_format::shapes::PieceShape;
use urdd_geometry::bounding_sphere::BoundingSphere as Ball;
use urdd_geometry::hull::{ConvexHull, HullError};
use urdd_geometry::oriented_box::OrientedBox;
use urdd_geometry::{Mesh, farthest};
use urdd_kinematics::rotation::from_rpy;

/// Maximum number of pieces with matrices over pieces, which grow with the square of that number.
pub(crate) const MOST_PIECES_WITH_MATRICES: usize = 500;

/// The convex meshes from which shapes are built.
#[derive(Clone, Copy)]
pub(crate) struct ConvexMeshes<'a> {
    pub hulls: &'a [Option<WrittenMesh>],
    pub pieces: &'a [Vec<WrittenMesh>],
}

/// The oriented bounding box and the bounding sphere of a hull or a piece.
pub(crate) type Shape = (Obb, BoundingSphere);

impl ConvexMeshes<'_> {
    /// The links at the indices of a matrix over links.
    pub fn full_shapes(&self) -> Vec<LinkIdx> {
        let links = (0..).zip(self.hulls.iter()).filter(|(_, hull)| hull.is_some());
        links.map(|(link, _)| LinkIdx(link)).collect()
    }

    /// The pieces at the indices of a matrix over pieces.
    pub fn decomposition_shapes(&self) -> Vec<PieceShape> {
        let links = (0..).zip(self.pieces.iter());
        links
            .flat_map(|(link, pieces)| {
                (0..).zip(pieces).map(move |(piece, _)| PieceShape {
                    link_idx: LinkIdx(link),
                    piece_idx: PieceIdx(piece),
                })
            })
            .collect()
    }
}

/// The powers of ten that scale numbers from 10^-6 to 10^6 to seven digits before the point. All are exact.
const SCALES: [f64; 12] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

/// Rounds a distance to seven significant digits (SPEC 8.5 says what that may change). Distances below 10^-6 m, and
/// from 10^6 m on, are unchanged. Rounding is monotonic.
pub fn seven_digits(x: f64) -> f64 {
    let scale = SCALES.iter().find(|scale| (1e6..1e7).contains(&(x * **scale)));
    match scale {
        // An integer divided by a power of ten, both exact: the quotient is the binary64 nearest to the decimal.
        Some(scale) => (x * scale).round() / scale,
        None => x,
    }
}

/// Builds the module. `known` are the boxes and spheres that a donor has: of the hulls, then of the pieces.
/// Fails if cancelled, or if a mesh has no hull, which is a bug in an earlier stage.
pub(crate) fn approximations(
    context: &Context,
    solids: &ConvexMeshes,
    known: Vec<Option<Shape>>,
) -> Shared<LinkShapesApproximationsModule> {
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
    let mut built =
        for_each_content(&meshes, &context.settings.source.cancellation, shape)?.into_iter();
    let found = known.into_iter().map(|known| match known {
        Some(known) => Ok(known),
        None => built.next().unwrap_or(Err(HullError::Empty)),
    });
    let found: Result<Vec<Shape>, HullError> = found.collect();
    let found = found.map_err(|error| GenerateError::internal(&context.source.shown, error))?;
    let mut found = found.into_iter();
    let hulls = solids.hulls.iter();
    let full: Vec<_> = hulls.map(|hull| hull.as_ref().and_then(|_| found.next())).collect();
    let pieces = solids.pieces.iter();
    let pieces: Vec<Vec<_>> =
        pieces.map(|pieces| found.by_ref().take(pieces.len()).collect()).collect();
    let (full_obbs, full_bounding_spheres) = full.into_iter().map(Option::unzip).unzip();
    let (decomposition_obbs, decomposition_bounding_spheres) =
        pieces.into_iter().map(|pieces| pieces.into_iter().unzip()).unzip();
    let module = Arc::new(LinkShapesApproximationsModule {
        full_obbs,
        full_bounding_spheres,
        decomposition_obbs,
        decomposition_bounding_spheres,
    });
    made_with(&*module, Vec::new(), Arc::clone(&module))
}

fn of_mesh(mesh: &Mesh) -> Result<Shape, HullError> {
    let hull = ConvexHull::new(&mesh.vertices)?;
    let (found, ball) = (OrientedBox::around(&hull), Ball::around(&hull));
    // The rotation of an oriented box never has a pitch near a right angle.
    let (roll, pitch, yaw) = found.rotation.euler_angles();
    let obb = Obb {
        half_extents: found.half_extents,
        offset_xyz: found.centre,
        offset_rpy: [roll, pitch, yaw].map(|angle| angle + 0.0),
    };
    Ok((obb, BoundingSphere { radius: ball.radius, offset_xyz: ball.centre }))
}

pub(crate) fn max_distances(
    solids: &ConvexMeshes,
    of: &LinkShapesApproximationsModule,
) -> LinkShapesMaxDistanceFromOriginModule {
    LinkShapesMaxDistanceFromOriginModule {
        full_convex_hulls_maximum_distances: maybe(solids.hulls, from_mesh),
        full_obbs_maximum_distances: maybe(&of.full_obbs, from_box),
        full_bounding_spheres_maximum_distances: maybe(&of.full_bounding_spheres, from_sphere),
        decomposition_convex_hulls_maximum_distances: each(solids.pieces, from_mesh),
        decomposition_obbs_maximum_distances: each(&of.decomposition_obbs, from_box),
        decomposition_bounding_spheres_maximum_distances: each(
            &of.decomposition_bounding_spheres,
            from_sphere,
        ),
    }
}

fn maybe<T>(shapes: &[Option<T>], distance: fn(&T) -> f64) -> Vec<Option<f64>> {
    shapes.iter().map(|shape| shape.as_ref().map(distance)).collect()
}

fn each<T>(shapes: &[Vec<T>], distance: fn(&T) -> f64) -> Vec<Vec<f64>> {
    shapes.iter().map(|pieces| pieces.iter().map(distance).collect()).collect()
}

fn from_mesh(mesh: &WrittenMesh) -> f64 {
    farthest::of_mesh(&mesh.mesh)
}

fn from_box(of: &Obb) -> f64 {
    farthest::of_box(&OrientedBox {
        centre: of.offset_xyz,
        half_extents: of.half_extents,
        rotation: from_rpy(of.offset_rpy),
    })
}

fn from_sphere(of: &BoundingSphere) -> f64 {
    farthest::of_sphere(&Ball { centre: of.offset_xyz, radius: of.radius })
}
