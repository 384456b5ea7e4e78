//! Validation.

use std::path::PathBuf;

use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use serde_json::{Value, from_value};
use urdd_lint::declared;
use urdd_source::Declared;
use urdd_validate::report;
use urdd_validate::selection::Codes;
use urdd_validate::settings::{Exclude, Settings};
use urdd_validate::settings_file::SettingsFile;
use urdd_validate::{ValidateError, rules};

use crate::errors::raise;
use crate::work;

/// The options of `urdd.validate`.
#[derive(FromPyObject)]
pub struct Options {
    conformance_class: Option<String>,
    deep: bool,
    reporting: Reporting,
}

/// The options of what is reported.
#[derive(FromPyObject)]
pub struct Reporting {
    fail_on: Option<String>,
    /// The text of a settings file.
    config: Option<String>,
    /// Its folder.
    config_folder: PathBuf,
    select: Vec<String>,
    ignore: Vec<String>,
    exclude: Vec<String>,
}

impl Options {
    fn settings(self) -> Result<Settings, String> {
        let mut settings = self.reporting.settings()?;
        if let Some(class) = self.conformance_class {
            let read = from_value(Value::String(class.clone()));
            let wrong = |_| {
                let class = class.escape_debug();
                format!("conformance_class: `{class}` is none of core, geometry, shapes")
            };
            settings.class = Some(read.map_err(wrong)?);
        }
        settings.deep |= self.deep;
        Ok(settings)
    }
}

impl Reporting {
    /// The robots that the settings file declares.
    pub fn robots(&self) -> Result<Vec<Declared>, String> {
        let text = self.config.as_deref().unwrap_or_default();
        let file = SettingsFile::from_toml(text, &self.config_folder);
        file.map(|file| declared(&file)).map_err(|error| format!("config: {error}"))
    }

    /// The settings of the file, with the other options.
    pub fn settings(self) -> Result<Settings, String> {
        let mut settings = match self.config {
            None => Settings::default(),
            Some(text) => Settings::from_toml(&text).map_err(|error| format!("config: {error}"))?,
        };
        if let Some(severity) = self.fail_on {
            let read = from_value(Value::String(severity.clone()));
            let wrong = |_| {
                let severity = severity.escape_debug();
                format!("fail_on: `{severity}` is none of error, warning, info")
            };
            settings.fail_on = Some(read.map_err(wrong)?);
        }
        let codes = |words: &[String]| -> Result<Vec<Codes>, String> {
            let each = words.iter().map(|word| word.parse::<Codes>());
            each.collect::<Result<_, _>>().map_err(|error| error.to_string())
        };
        settings.selection.select.extend(codes(&self.select)?);
        settings.selection.ignore.extend(codes(&self.ignore)?);
        for pattern in &self.exclude {
            let exclude = Exclude::new(pattern);
            settings.excludes.push(exclude.map_err(|error| format!("exclude: {error}"))?);
        }
        Ok(settings)
    }
}

/// The report on every URDD at or below the paths, as JSON.
#[pyfunction]
pub fn validate(py: Python<'_>, paths: Vec<PathBuf>, options: Options) -> PyResult<String> {
    let mut settings = options.settings().map_err(PyValueError::new_err)?;
    let outcome = work::run(py, move |cancellation| {
        settings.cancellation = cancellation.clone();
        let run = urdd_validate::validate(&paths, &settings)?;
        Ok(report::json(&run.report))
    })?;
    match outcome {
        Ok(text) => text.map_err(|error| PyRuntimeError::new_err(error.to_string())),
        Err(ValidateError::Cancelled(error)) => {
            Err(PyKeyboardInterrupt::new_err(error.to_string()))
        }
        Err(error) => Err(raise(py, "OpenError", error, &[])),
    }
}

/// The description of a rule: its name, severity, clause and explanation.
#[pyfunction]
pub fn explain(
    py: Python<'_>,
    code: &str,
) -> PyResult<(&'static str, &'static str, &'static str, String)> {
    let of_urdds = rules::all().into_iter().map(|rule| &rule.description);
    let of_urdfs = urdd_lint::rules::all().into_iter().map(|rule| &rule.description);
    let rule = of_urdds.chain(of_urdfs).find(|rule| rule.code.as_str() == code);
    match rule {
        Some(rule) => Ok((
            rule.name,
            rule.severity.as_str(),
            rule.clause.unwrap_or_default(),
            rule.explanation().to_string(),
        )),
        None => {
            let message = format!(
                "there is no rule `{}`; a finding says the code of its rule, such as DOF003",
                code.escape_debug()
            );
            Err(raise(py, "UnknownNameError", message, &[]))
        }
    }
}
