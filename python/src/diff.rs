//! Comparison of robots.

use std::path::PathBuf;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use urdd_diff::{DiffError, Options, Side, compare};
use urdd_validate::report;

use crate::errors::raise;
use crate::source::places;
use crate::work;

/// How two robots differ, as JSON.
#[pyfunction]
pub fn diff(
    py: Python<'_>,
    before: PathBuf,
    after: PathBuf,
    findings: bool,
    tolerance: f64,
    packages: Vec<(String, PathBuf)>,
    allowed_folders: Vec<PathBuf>,
) -> PyResult<String> {
    let (packages, allowed_folders) =
        places(&packages, allowed_folders).map_err(PyValueError::new_err)?;
    let outcome = work::run(py, move |cancellation| -> Result<_, DiffError> {
        let mut options = Options { without_findings: !findings, ..Options::default() };
        options.urdf.packages = packages;
        options.urdf.allowed_folders = allowed_folders;
        options.cancellation = cancellation.clone();
        let (before, after) = (Side::open(&before, &options)?, Side::open(&after, &options)?);
        Ok(compare(&before, &after, tolerance))
    })?;
    match outcome {
        Ok(report) => {
            let report = report.map_err(|error| PyValueError::new_err(error.to_string()))?;
            report::json(&report).map_err(|error| PyRuntimeError::new_err(error.to_string()))
        }
        Err(error) => Err(raise(py, "OpenError", error, &[])),
    }
}
