//! Unprocessed modules and files of a URDD.

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::ReadError;
use urdd_format::registry::{ModuleKind, Profile};
use urdd_robot::RobotError;

use crate::advice;
use crate::errors::{of_robot, raise};
use crate::robot::Robot;
use crate::work;

/// The result of reading a module.
enum Read {
    Text { version: String, is_legacy: bool, text: String },
    Missing,
    Unusable(String),
    Failed(RobotError),
}

#[pymethods]
impl Robot {
    /// The names of the modules that exist, in the order of the specification.
    fn module_names(&self, py: Python<'_>) -> PyResult<Vec<&'static str>> {
        let part = self.robot.part_as_it_is(&[]).map_err(|error| of_robot(py, &error))?;
        let kinds = ModuleKind::ALL.iter();
        let there = kinds.filter(|kind| part.listing().has_folder(kind.folder()));
        Ok(there.map(|kind| kind.name()).collect())
    }

    /// A module's version, whether it is a legacy one, and its JSON, which matches its schema.
    fn module(&self, py: Python<'_>, name: &str) -> PyResult<(String, bool, String)> {
        let kind = ModuleKind::ALL.iter().find(|kind| kind.name() == name);
        let Some(kind) = kind.copied() else {
            let message = format!("there is no module `{}`", name.escape_debug());
            return Err(raise(py, "UnknownNameError", message, &[]));
        };
        let robot = &self.robot;
        let read = work::run(py, move |_| {
            let part = match robot.part_as_it_is(&[kind]) {
                Ok(part) => part,
                Err(error) => return Read::Failed(error),
            };
            let Some(module) = part.module(kind) else {
                return Read::Missing;
            };
            if let Some(unusable) = module.unusable() {
                let fault = module.first_fault();
                return Read::Unusable(fault.unwrap_or_else(|| unusable.to_string()));
            }
            let file = module.file("module.json");
            match part.root().read(&file, MAX_DOCUMENT_BYTES) {
                Err(ReadError::Changed) => Read::Failed(RobotError::Changed(robot.folder_name())),
                Err(error) => Read::Unusable(format!("{file}: {error}")),
                Ok(bytes) => Read::Text {
                    version: module.version.clone().unwrap_or_default(),
                    is_legacy: module.spec.is_some_and(|spec| spec.profile == Profile::Legacy),
                    text: String::from_utf8_lossy(&bytes).into_owned(),
                },
            }
        })?;
        let name = || vec![("module", pyo3::types::PyString::new(py, name).into_any())];
        match read {
            Read::Text { version, is_legacy, text } => Ok((version, is_legacy, text)),
            Read::Failed(error) => Err(of_robot(py, &error)),
            Read::Missing => {
                let error = RobotError::Missing(kind);
                Err(of_robot(py, &error))
            }
            Read::Unusable(fault) => {
                let fault = fault.escape_debug();
                let message = format!("{}: {fault}: {}", kind.name(), advice::SAYS_MORE);
                Err(raise(py, "ModuleUnusableError", message, &name()))
            }
        }
    }

    /// The text of `urdd.json`; None if it does not exist.
    fn metadata(&self, py: Python<'_>) -> PyResult<Option<String>> {
        match py.detach(|| self.robot.root().read(ROOT_METADATA, MAX_DOCUMENT_BYTES)) {
            Ok(bytes) => Ok(Some(String::from_utf8_lossy(&bytes).into_owned())),
            Err(ReadError::Missing) => Ok(None),
            Err(error) => {
                let message = format!("{ROOT_METADATA}: {error}");
                Err(raise(py, "OpenError", message, &[]))
            }
        }
    }

    /// The bytes of a file of the URDD.
    fn read_file<'py>(&self, py: Python<'py>, path: &str) -> PyResult<Bound<'py, PyBytes>> {
        match py.detach(|| self.robot.root().read(path, MAX_DOCUMENT_BYTES)) {
            Ok(bytes) => Ok(PyBytes::new(py, &bytes)),
            Err(error) => {
                let message = format!("{}: {error}", path.escape_debug());
                Err(raise(py, "OpenError", message, &[]))
            }
        }
    }

    /// The path of the carried URDF in the URDD; None without one.
    fn source(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let source = self.ask(py, |robot, _| robot.source())?;
        Ok(source.map(|source| source.path))
    }

    /// The folder on disk; None for an archive.
    fn folder(&self) -> Option<std::path::PathBuf> {
        self.robot.root().folder().map(std::path::Path::to_owned)
    }
}
