//! The robots in folders.

use std::path::PathBuf;

use pyo3::prelude::*;
use urdd_source::{Settings as SourceSettings, robots};

use crate::errors::raise;
use crate::work;

/// The robots below these paths: for each its file, and a unique name.
#[pyfunction]
pub fn find_urdfs(py: Python<'_>, paths: Vec<PathBuf>) -> PyResult<Vec<(PathBuf, String)>> {
    let jobs = work::run(py, move |_| robots::jobs(&paths, &SourceSettings::default()))?;
    let jobs = jobs.map_err(|error| raise(py, "OpenError", error, &[]))?;
    Ok(jobs.into_iter().map(|job| (job.source, job.name)).collect())
}
