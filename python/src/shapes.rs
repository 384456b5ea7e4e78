//! Shapes, meshes and skips.

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_geometry::Mesh;
use urdd_robot::{ShapeKind, Solid};

use crate::arrays::{matrix, shaped};
use crate::errors::of_robot;
use crate::robot::Robot;

#[pymethods]
impl Robot {
    /// The shapes of a kind, each as a dictionary: `link`, `piece`, and `vertices` and `faces`, or `pose` and
    /// `half_extents`, or `centre` and `radius`.
    fn shapes<'py>(&self, py: Python<'py>, kind: &str) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let kind = kind.parse::<ShapeKind>().map_err(|error| of_robot(py, &error.into()))?;
        let shapes = self.ask(py, move |robot, _| robot.shapes(kind))?;
        let one = |shape: urdd_robot::LinkShape| {
            let found = PyDict::new(py);
            found.set_item("link", shape.link)?;
            found.set_item("piece", shape.piece)?;
            match shape.solid {
                Solid::Mesh(mesh) => put_mesh(py, &found, &mesh)?,
                Solid::Box { pose, half_extents } => {
                    found.set_item("pose", shaped(py, matrix(&pose).to_vec(), [4, 4])?)?;
                    let half = PyArray1::from_slice(py, &half_extents);
                    found.set_item("half_extents", half)?;
                }
                Solid::Sphere { centre, radius } => {
                    found.set_item("centre", PyArray1::from_slice(py, &centre))?;
                    found.set_item("radius", radius)?;
                }
            }
            Ok(found)
        };
        shapes.into_iter().map(one).collect()
    }

    /// What links look like: for each coloured part of each link `link`, `color` (4 numbers or None), `vertices`,
    /// `faces`.
    fn visuals<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let visuals = self.ask(py, |robot, _| robot.visuals())?;
        let parts = visuals
            .iter()
            .flat_map(|visual| visual.parts.iter().map(move |part| (visual.link, part)));
        let one = |(link, part): (usize, &urdd_geometry::read::Part)| {
            let found = PyDict::new(py);
            found.set_item("link", link)?;
            found.set_item("color", part.color)?;
            put_mesh(py, &found, &part.mesh)?;
            Ok(found)
        };
        parts.map(one).collect()
    }

    /// The link and the piece of each shape (shapes, 2), which pairs are skipped (shapes, shapes), and the reason of
    /// each pair, as an index into `urdd.SKIP_REASONS` (shapes, shapes) or None.
    #[allow(clippy::type_complexity)]
    fn skips<'py>(
        &self,
        py: Python<'py>,
        kind: &str,
    ) -> PyResult<(
        Bound<'py, PyArray2<usize>>,
        Bound<'py, PyArray2<bool>>,
        Option<Bound<'py, PyArray2<u8>>>,
    )> {
        let kind = kind.parse::<ShapeKind>().map_err(|error| of_robot(py, &error.into()))?;
        let skips = self.ask(py, move |robot, _| robot.skips(kind))?;
        let count = skips.len();
        let pairs = || (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
        let places = skips.places().iter().flat_map(|(link, piece)| [*link, *piece]);
        let skipped = pairs().map(|(i, j)| skips.is_skipped(i, j));
        let reasons: Option<Vec<u8>> =
            pairs().map(|(i, j)| skips.reason(i, j).map(number)).collect();
        let reasons = reasons.filter(|_| count > 0);
        Ok((
            shaped(py, places.collect(), [count, 2])?,
            shaped(py, skipped.collect(), [count, count])?,
            reasons.map(|reasons| shaped(py, reasons, [count, count])).transpose()?,
        ))
    }
}

fn put_mesh(py: Python<'_>, found: &Bound<'_, PyDict>, mesh: &Mesh) -> PyResult<()> {
    let vertices = mesh.vertices.as_flattened().to_vec();
    found.set_item("vertices", shaped(py, vertices, [mesh.vertices.len(), 3])?)?;
    let faces = mesh.triangles.as_flattened().to_vec();
    found.set_item("faces", shaped(py, faces, [mesh.triangles.len(), 3])?)
}

/// The index of a reason in `urdd.SKIP_REASONS`.
fn number(reason: SkipReason) -> u8 {
    match reason {
        SkipReason::SameLink => 0,
        SkipReason::Always => 1,
        SkipReason::Adjacent => 2,
        SkipReason::Default => 3,
        SkipReason::Never => 4,
        SkipReason::None => 5,
    }
}
