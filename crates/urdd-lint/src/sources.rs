//! Which files a run examines, and what they are called in reports.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::settings::LintSettings;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::file_type::FileType;
use urdd_source::robots::{Batch, BatchError, Job, find};

/// Why a run has no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LintError {
    /// One of the paths has nothing to examine.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// Folders with nothing but xacro files.
    #[error("there are only xacro files, which are programs: --xacro expands those in folders")]
    OnlyXacro,
    /// Cancelled through the settings.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

pub(crate) struct Sources {
    pub jobs: Vec<Job>,
    /// The number of those that the settings exclude.
    pub excluded: usize,
    /// What else was found.
    pub batch: Batch,
}

pub(crate) fn sources(paths: &[PathBuf], settings: &LintSettings) -> Result<Sources, LintError> {
    let mut batch = find(paths, &settings.source)?;
    let mut jobs = std::mem::take(&mut batch.jobs);
    // A xacro file is a program: it runs where somebody names it, or asks for xacro.
    let found = jobs.len();
    let is_named = |job: &Job| paths.contains(&job.source) || settings.source.xacro.expand_urdf;
    jobs.retain(|job| is_named(job) || !FileType::Xacro.is_of(&job.source));
    if jobs.is_empty() && found > 0 {
        return Err(LintError::OnlyXacro);
    }
    let all = jobs.len();
    jobs.retain(|job| {
        let seen = seen_from(&job.source, paths);
        !settings.report.excludes.iter().any(|exclude| exclude.matches(&seen))
    });
    let excluded = all - jobs.len();
    Ok(Sources { jobs, excluded, batch })
}

/// The folder and the name of a file.
pub(crate) fn stems(path: &Path) -> (PathBuf, String) {
    let name = path.file_name().unwrap_or_default();
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    (folder.to_owned(), name.to_string_lossy().into_owned())
}

/// The path that patterns of settings match: that of a file from the folder that was given, with forward slashes; its own
/// name where the file itself was given, or is in no such folder.
pub fn seen_from(path: &Path, given: &[PathBuf]) -> String {
    let inside = given.iter().find_map(|given| path.strip_prefix(given).ok());
    match inside.filter(|inside| !inside.as_os_str().is_empty()) {
        Some(inside) => inside.to_string_lossy().replace('\\', "/"),
        None => stems(path).1,
    }
}
