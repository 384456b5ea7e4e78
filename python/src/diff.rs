//! Comparison of robots.

use std::path::PathBuf;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use urdd_diff::{DiffError, Options, Side, compare};
use urdd_validate::report;

use crate::errors::raise;
use crate::source::Source;
use crate::work;

/// How two robots differ, as JSON.
#[pyfunction]
pub fn diff(
    py: Python<'_>,
    before: PathBuf,
    after: PathBuf,
    findings: bool,
    tolerance: f64,
    source: Source,
) -> PyResult<String> {
    let mut urdf = source.settings().map_err(PyValueError::new_err)?;
    let outcome = work::run(py, move |cancellation| -> Result<_, DiffError> {
        urdf.cancellation = cancellation.clone();
        let options = Options { urdf, without_findings: !findings };
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
