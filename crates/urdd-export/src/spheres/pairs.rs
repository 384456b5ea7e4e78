//! The pairs of links whose shapes are checked, by the URDD's skips and what was chosen.

use std::collections::HashMap;

use crate::ExportError;
use crate::pairs::Decision;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;
use urdd_robot::{LinkShape, Robot, RobotError, ShapeKind, Solid};
use urdd_spheres::samples::Pairs;

/// Pairs of links with shapes of which the URDD checks at least one pair of pieces.
pub(super) fn of(
    robot: &Robot,
    names: &[String],
    kind: ShapeKind,
    reasons: Option<&[SkippedReason]>,
) -> Result<Pairs, ExportError> {
    let shapes = robot.shapes(kind)?;
    let count = names.len();
    if let Some(index) = shapes.iter().map(|shape| shape.link).find(|link| *link >= count) {
        let what = "link";
        return Err(RobotError::OutOfRange { what, index, count }.into());
    }
    let skips = robot.skips(kind)?;
    let decision = Decision::new(&skips, names, reasons);
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
    let links: Vec<usize> = meshes.iter().map(|(link, _)| *link).collect();
    let made = Pairs::new(meshes, is_checked).map_err(|(shape, error)| RobotError::Unusable {
        module: ModuleKind::ConvexDecompositionMeshes,
        reason: format!("a piece of link {}: {error}", links[shape]),
    })?;
    Ok(made)
}
