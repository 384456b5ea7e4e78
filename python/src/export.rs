//! Exports.

use std::sync::Arc;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use urdd_export::{Format, Options, SphereBudget};

use crate::advice;
use crate::errors::{of_robot, raise};
use crate::generate::skipped_reason;
use crate::robot::Robot;
use crate::work;

/// The text, the mesh files by path relative to it, and notes.
type Made<'py> = (String, Vec<(String, Bound<'py, PyBytes>)>, Vec<String>);

/// A robot in another format, in memory.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub fn export<'py>(
    py: Python<'py>,
    robot: &Robot,
    format: &str,
    shapes: &str,
    reasons: Option<Vec<String>>,
    keep_pairs: bool,
    spheres: Option<usize>,
    total_spheres: Option<usize>,
    cover: bool,
    samples: usize,
    visuals: bool,
    mesh_folder: String,
) -> PyResult<Made<'py>> {
    let format = match format {
        "srdf" => Format::Srdf,
        "urdf" => Format::Urdf,
        "drake" => Format::Drake,
        "mjcf" => Format::Mjcf,
        "curobo" => Format::Curobo,
        "foam" => Format::Foam,
        other => {
            return Err(PyValueError::new_err(format!(
                "there is no format `{}`; there are: srdf, urdf, drake, mjcf, curobo, foam",
                other.escape_debug()
            )));
        }
    };
    let reasons = reasons.map(|words| {
        let each = words.iter().map(|word| skipped_reason(word));
        each.collect::<Result<Vec<_>, _>>()
    });
    let options = Options {
        shapes: shapes
            .parse::<urdd_robot::ShapeKind>()
            .map_err(|error| of_robot(py, &error.into()))?,
        reasons: reasons.transpose().map_err(PyValueError::new_err)?,
        keep_pairs,
        spheres: match (total_spheres, spheres) {
            (Some(count), _) => SphereBudget::Total(count),
            (None, Some(count)) => SphereBudget::PerLink(count),
            (None, None) => SphereBudget::default(),
        },
        cover,
        samples,
        visuals,
        mesh_folder,
    };
    let robot = Arc::clone(robot.read(py)?);
    let made = work::run(py, move |_| urdd_export::export(&robot, format, &options))?;
    let made = made.map_err(|error| match error {
        urdd_export::ExportError::Robot(error) => of_robot(py, &error),
        error => raise(py, "ExportError", advice::of_export(&error), &[]),
    })?;
    let files = made.files.iter();
    Ok((
        made.text,
        files
            .map(|(path, bytes)| (path.clone(), PyBytes::new(py, bytes)))
            .collect(),
        made.notes.iter().map(ToString::to_string).collect(),
    ))
}
