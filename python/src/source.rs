//! How descriptions are found, read and imported.

use std::path::PathBuf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use urdd_generate::{GenerateError, Packages, SourceSettings, XacroSettings};
use urdd_import::import_whole;
use urdd_source::{ImportOptions, robots};

use crate::errors::{of_generate, raise};
use crate::work;

/// What functions that read descriptions ask for, which check its types.
#[derive(FromPyObject)]
pub struct Source {
    packages: Vec<(String, PathBuf)>,
    allowed_folders: Vec<PathBuf>,
    xacro: bool,
    xacro_arguments: Vec<String>,
    xacro_timeout: f64,
    body: Option<String>,
    model: Option<String>,
    ball: String,
    massless: String,
}

impl Source {
    /// Descriptions are read from the disk.
    pub fn settings(self) -> Result<SourceSettings, String> {
        let (packages, allowed_folders) = places(&self.packages, self.allowed_folders)?;
        let xacro = XacroSettings {
            expand_urdf: self.xacro,
            arguments: self.xacro_arguments,
            time_limit: XacroSettings::seconds(self.xacro_timeout)
                .map_err(|error| error.to_string())?,
            ..XacroSettings::default()
        };
        let import = ImportOptions {
            body: self.body,
            model: self.model,
            has_revolute_balls: is_second("ball", &self.ball, ["spherical", "revolute"])?,
            has_tiny_masses: is_second("massless", &self.massless, ["none", "tiny"])?,
        };
        Ok(SourceSettings { packages, allowed_folders, xacro, import, ..SourceSettings::default() })
    }
}

/// Where meshes are: packages, those of the environment too, and folders, which exist.
fn places(
    named: &[(String, PathBuf)],
    allowed_folders: Vec<PathBuf>,
) -> Result<(Packages, Vec<PathBuf>), String> {
    let mut packages = Packages::from_environment(|name| std::env::var_os(name));
    for (name, path) in named {
        let added = packages.add(&format!("{name}={}", path.display()));
        added.map_err(|error| format!("packages: {error}"))?;
    }
    match allowed_folders.iter().find(|folder| !folder.is_dir()) {
        Some(folder) => {
            let folder = folder.display();
            Err(format!("allowed_folders: {folder} is not a folder"))
        }
        None => Ok((packages, allowed_folders)),
    }
}

/// Whether an option has the second of its two words.
pub fn is_second(option: &str, word: &str, [first, second]: [&str; 2]) -> Result<bool, String> {
    match word {
        word if word == first => Ok(false),
        word if word == second => Ok(true),
        other => {
            Err(format!("{option}: `{}` is neither {first} nor {second}", other.escape_debug()))
        }
    }
}

/// The name of the URDF, the files with it, by path, the report as JSON, and what else is in the folder.
type Made<'py> = (String, Vec<(String, Bound<'py, PyBytes>)>, String, Vec<String>);

/// What an MJCF, SDF or USD becomes, in memory.
#[pyfunction]
pub fn import_robot<'py>(
    py: Python<'py>,
    file: PathBuf,
    folder: PathBuf,
    source: Source,
) -> PyResult<Made<'py>> {
    let mut settings = source.settings().map_err(PyValueError::new_err)?;
    let outcome = work::run(py, move |cancellation| {
        settings.cancellation = cancellation.clone();
        import_whole(&file, &settings)
    })?;
    let (imported, _) = outcome.map_err(|error| of_generate(py, &GenerateError::Source(error)))?;
    let files = imported.files.iter();
    let files = files.map(|(name, bytes)| (name.clone(), PyBytes::new(py, bytes))).collect();
    let left = imported.left_in(&folder);
    Ok((imported.urdf.clone(), files, imported.report.to_json(), left))
}

/// The robots below these paths: for each its file, and a unique name.
#[pyfunction]
pub fn find_urdfs(py: Python<'_>, paths: Vec<PathBuf>) -> PyResult<Vec<(PathBuf, String)>> {
    let jobs = work::run(py, move |_| robots::jobs(&paths, &SourceSettings::default()))?;
    let jobs = jobs.map_err(|error| raise(py, "OpenError", error, &[]))?;
    Ok(jobs.into_iter().map(|job| (job.source, job.name)).collect())
}
