//! Pairs of links whose shapes are checked, with their exact shapes.

use std::collections::HashMap;

use nalgebra::Isometry3;

use crate::pairs::Decision;
use crate::{ExportError, Subject};
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;
use urdd_geometry::convex::BodyPairs;
use urdd_robot::{LinkShape, RobotError, ShapeKind, Solid};

/// Pairs of links with shapes of which the URDD checks at least one pair of pieces.
#[derive(Debug)]
pub(super) struct Pairs {
    /// The links that have shapes, ascending. All other link numbers here are indices into this list.
    pub links: Vec<usize>,
    /// The pieces of each of these links.
    pub pieces: Vec<Vec<Mesh>>,
    /// The pairs of links that are checked, each ascending.
    pub checked: Vec<[usize; 2]>,
    exact: BodyPairs,
}

impl Pairs {
    pub fn new(
        subject: &Subject,
        kind: ShapeKind,
        reasons: Option<&[SkippedReason]>,
    ) -> Result<Self, ExportError> {
        let shapes = subject.robot.shapes(kind)?;
        let count = subject.links.len();
        if let Some(index) = shapes.iter().map(|shape| shape.link).find(|link| *link >= count) {
            let what = "link";
            return Err(RobotError::OutOfRange { what, index, count }.into());
        }
        let skips = subject.robot.skips(kind)?;
        let decision = Decision::new(&skips, &subject.links, reasons);
        let rows: HashMap<(usize, usize), usize> =
            skips.places().iter().enumerate().map(|(row, place)| (*place, row)).collect();
        let row = |shape: &LinkShape| rows.get(&(shape.link, shape.piece)).copied();
        let rows: Vec<Option<usize>> = shapes.iter().map(row).collect();
        let is_checked = |a: usize, b: usize| match rows[a].zip(rows[b]) {
            Some((a, b)) => !decision.is_skipped(a, b),
            None => true,
        };
        let meshes: Vec<(usize, Mesh)> = shapes
            .into_iter()
            .filter_map(|shape| match shape.solid {
                Solid::Mesh(mesh) => Some((shape.link, mesh)),
                Solid::Box { .. } | Solid::Sphere { .. } => None,
            })
            .collect();
        let each = meshes.iter().map(|(link, mesh)| (*link, mesh.vertices.as_slice()));
        let mut exact = BodyPairs::new(each).map_err(|(shape, error)| RobotError::Unusable {
            module: ModuleKind::ConvexDecompositionMeshes,
            reason: format!("a piece of link {}: {error}", meshes[shape].0),
        })?;
        let mut links: Vec<usize> = meshes.iter().map(|(link, _)| *link).collect();
        links.sort_unstable();
        links.dedup();
        let mut checked = Vec::new();
        for a in 0..links.len() {
            for b in a + 1..links.len() {
                if exact.add([links[a], links[b]], is_checked) {
                    checked.push([a, b]);
                }
            }
        }
        let pieces = |link: &usize| {
            let own = meshes.iter().filter(|(of, _)| of == link);
            own.map(|(_, mesh)| mesh.clone()).collect()
        };
        Ok(Pairs { pieces: links.iter().map(pieces).collect(), links, checked, exact })
    }

    /// The indices of the pairs in contact, ascending. `poses` are those of all links of the robot.
    pub fn touching(&self, poses: &[Isometry3<f64>]) -> Vec<u32> {
        self.exact.touching(poses).into_iter().filter_map(|pair| u32::try_from(pair).ok()).collect()
    }

    /// Whether any pair is in contact.
    pub fn any_touches(&self, poses: &[Isometry3<f64>]) -> bool {
        self.exact.any_touches(poses)
    }
}
