//! Shapes of links: convex hulls, convex pieces, and their bounding boxes and spheres.

use nalgebra::{Isometry3, Translation3};

use super::Robot;
use super::error::RobotError;
use super::kept::{LinkShape, Solid};
use super::mesh::Meshes;
use urdd_document::kept::keep;
use urdd_document::shapes::{Volume, approximations};
use urdd_format::registry::ModuleKind;
pub use urdd_format::shape_kind::ShapeKind;
use urdd_kinematics::rotation::from_rpy;

impl Robot {
    /// The shapes of one kind, by link and piece. Links without geometry have none.
    ///
    /// # Errors
    /// If their module is missing or unusable, or a mesh cannot be read.
    pub fn shapes(&self, kind: ShapeKind) -> Result<Vec<LinkShape>, RobotError> {
        keep(&self.shapes[kind as usize], || self.read_shapes(kind)).cloned()
    }

    fn read_shapes(&self, kind: ShapeKind) -> Result<Vec<LinkShape>, RobotError> {
        let part = self.part(&[kind.module()])?;
        if matches!(kind, ShapeKind::Hulls | ShapeKind::Pieces) {
            let meshes = Meshes::new(&part, kind.module())?.all()?.into_iter();
            let shape = |(link, piece, mesh)| LinkShape { link, piece, solid: Solid::Mesh(mesh) };
            return Ok(meshes.map(shape).collect());
        }
        let lists = part
            .document(ModuleKind::LinkShapesApproximations)
            .and_then(approximations)
            .ok_or(RobotError::Missing(ModuleKind::LinkShapesApproximations))?;
        let list = lists.into_iter().find(|list| list.kind == kind);
        let links = list.map_or_else(Vec::new, |list| list.links);
        let one = |(link, volumes): (usize, Vec<Volume>)| {
            let shapes = volumes.into_iter().enumerate();
            shapes.map(move |(piece, volume)| LinkShape { link, piece, solid: solid(volume) })
        };
        Ok(links.into_iter().enumerate().flat_map(one).collect())
    }
}

fn solid(volume: Volume) -> Solid {
    match volume {
        Volume::Box { half_extents, offset, rpy } => Solid::Box {
            pose: Isometry3::from_parts(Translation3::from(offset), from_rpy(rpy)),
            half_extents,
        },
        Volume::Sphere { radius, offset } => Solid::Sphere { centre: offset, radius },
    }
}
