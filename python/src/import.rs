//! Imports of MJCF and SDF.

use std::path::PathBuf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use urdd_generate::GenerateError;
use urdd_import::import_whole;

use crate::errors::of_generate;
use crate::source::Source;
use crate::work;

/// The name of the URDF, the files with it, by path, and the report as JSON.
type Made<'py> = (String, Vec<(String, Bound<'py, PyBytes>)>, String);

/// What an MJCF or SDF becomes, in memory.
#[pyfunction]
pub fn import_robot<'py>(py: Python<'py>, file: PathBuf, source: Source) -> PyResult<Made<'py>> {
    let settings = source.settings().map_err(PyValueError::new_err)?;
    let outcome = work::run(py, move |cancellation| import_whole(&file, &settings, cancellation))?;
    let (imported, _) = outcome.map_err(|error| of_generate(py, &GenerateError::Source(error)))?;
    let files = imported.files.iter();
    let files = files.map(|(name, bytes)| (name.clone(), PyBytes::new(py, bytes))).collect();
    Ok((imported.urdf.clone(), files, imported.report.to_json()))
}
