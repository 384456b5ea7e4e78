//! Linting.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use urdd_findings::baseline::Baseline;
use urdd_findings::report;
use urdd_findings::settings::parse_program;
use urdd_lint::{LintError, LintSettings};

use crate::errors::raise;
use crate::source::Source;
use crate::validate::Reporting;
use crate::work;

/// The options of `urdd.lint`, which checks their types.
#[derive(FromPyObject)]
pub struct Options {
    for_: Option<Vec<String>>,
    source: Source,
    baseline: Option<PathBuf>,
    reporting: Reporting,
}

impl Options {
    /// The settings, without the baseline.
    fn settings(self) -> Result<LintSettings, String> {
        let robots = self.reporting.robots()?.into();
        let mut report = self.reporting.settings()?;
        if let Some(words) = self.for_ {
            let each = words.iter().map(|word| parse_program(word));
            report.programs =
                each.collect::<Result<_, _>>().map_err(|error| format!("for_: {error}"))?;
        }
        let source = urdd_source::Settings { robots, ..self.source.settings()? };
        Ok(LintSettings { report, source, ..LintSettings::default() })
    }
}

/// The report on every URDF at or below the paths, as JSON.
#[pyfunction]
pub fn lint(py: Python<'_>, paths: Vec<PathBuf>, options: Options) -> PyResult<String> {
    let baseline = options.baseline.as_deref().map(Baseline::read).transpose();
    let baseline = baseline.map_err(|error| raise(py, "OpenError", error, &[]))?.map(Arc::new);
    let settings = options.settings().map_err(PyValueError::new_err)?;
    let outcome = work::run(py, move |cancellation| {
        let mut settings = LintSettings { baseline, ..settings };
        settings.source.cancellation = cancellation.clone();
        let run = urdd_lint::lint(&paths, &settings)?;
        Ok(report::json(&run.report))
    })?;
    match outcome {
        Ok(text) => text.map_err(|error| PyRuntimeError::new_err(error.to_string())),
        Err(LintError::Cancelled(error)) => Err(PyKeyboardInterrupt::new_err(error.to_string())),
        Err(LintError::OnlyXacro) => {
            let message = "there are only xacro files, which are programs: xacro=True expands those in folders";
            Err(raise(py, "OpenError", message, &[]))
        }
        Err(error) => Err(raise(py, "OpenError", error, &[])),
    }
}
