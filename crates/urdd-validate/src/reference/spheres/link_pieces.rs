//! The spheres of a link in a level, and its pieces.

use nalgebra::Vector3;

use super::solid::Solid;
use crate::solids::Solids;
use urdd_format::link_shapes_spheres::{LinkSphere, SphereLevel};
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;

/// A sphere, m.
#[derive(Debug, Clone, Copy)]
pub struct Ball {
    pub centre: Vector3<f64>,
    pub radius: f64,
}

impl Ball {
    /// How far outside a point is; negative inside.
    pub fn height(&self, point: &Vector3<f64>) -> f64 {
        (point - self.centre).norm() - self.radius
    }
}

impl From<&LinkSphere> for Ball {
    fn from(sphere: &LinkSphere) -> Self {
        Ball { centre: sphere.offset_xyz.into(), radius: sphere.radius }
    }
}

/// The spheres of a link in a level.
pub fn balls(level: &SphereLevel, link: usize) -> Vec<Ball> {
    let spheres = level.spheres.get(link).map_or(&[][..], Vec::as_slice);
    spheres.iter().map(Ball::from).collect()
}

/// The sound pieces of a link.
pub struct LinkPieces<'a> {
    pub meshes: Vec<&'a Mesh>,
    pub solids: Vec<Solid>,
    /// The diagonal of the box around all vertices (SPEC 8.9.5), m.
    pub diagonal: f64,
}

impl<'a> LinkPieces<'a> {
    /// Of a link with this many pieces; `None` without pieces, or if one has no hull, which other rules report.
    pub fn new(solids: &'a Solids, link: usize, count: usize) -> Option<Self> {
        let kind = ModuleKind::ConvexDecompositionMeshes;
        let meshes = (0..count).map(|piece| solids.sound(kind, link, piece));
        Self::of(meshes.collect::<Option<_>>()?)
    }

    /// The same, of their meshes.
    pub fn of(meshes: Vec<&'a Mesh>) -> Option<Self> {
        let solids: Vec<Solid> = meshes.iter().copied().map(Solid::new).collect::<Option<_>>()?;
        let vertices = || solids.iter().flat_map(|solid| &solid.vertices);
        let first = *vertices().next()?;
        let low = vertices().fold(first, |low, vertex| low.inf(vertex));
        let high = vertices().fold(first, |high, vertex| high.sup(vertex));
        Some(LinkPieces { meshes, solids, diagonal: (high - low).norm() })
    }
}
