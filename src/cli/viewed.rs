//! The robots at the paths that `urdd view` gets.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::output;
use urdd_directory::discover::DiscoverError;
use urdd_directory::file_type::FileType;
use urdd_format::escape;
use urdd_source::robots::{self, BatchError, Job};
use urdd_source::{Files, Settings, format_of};
use urdd_view::{Collection, Source};

/// Adds the robots at these paths. Returns how many there are at each.
///
/// # Errors
/// A message if a path has no robot, or cannot be searched.
pub(super) fn add(
    paths: &[PathBuf],
    settings: &Settings,
    collection: &Collection,
) -> Result<Vec<usize>, String> {
    let named = named(paths, settings)?;
    let one = |path: &PathBuf| {
        let before = collection.robots().len();
        match named.get(path) {
            Some(jobs) => jobs.iter().for_each(|job| add_source(job.clone(), collection)),
            None => add_folder(path, settings, collection)?,
        }
        Ok(collection.robots().len() - before)
    };
    paths.iter().map(one).collect()
}

/// The robots of files, by path: URDFs, xacro files, and what is imported.
fn named(paths: &[PathBuf], settings: &Settings) -> Result<HashMap<PathBuf, Vec<Job>>, String> {
    let is_source = |path: &&PathBuf| {
        let is_named = matches!(FileType::of(path), Some(FileType::Xacro | FileType::Urdf));
        path.is_file() && (is_named || format_of(path, &Files::Disk).is_some())
    };
    let files: Vec<PathBuf> = paths.iter().filter(is_source).cloned().collect();
    let jobs = robots::jobs(&files, settings).map_err(|error| error.to_string())?;
    let of = |file: PathBuf| {
        let place = file.canonicalize().ok();
        let its = jobs.iter().filter(|job| job.source.canonicalize().ok() == place);
        // Often the file is `robot.urdf`, and the folder has the robot's name.
        let parent = place.as_deref().and_then(Path::parent).and_then(Path::file_name);
        let named = |job: &Job| match parent {
            Some(parent) if job.name == "robot" => {
                Job { name: parent.to_string_lossy().into_owned(), ..job.clone() }
            }
            _ => job.clone(),
        };
        let its = its.map(named).collect();
        (file, its)
    };
    Ok(files.into_iter().map(of).collect())
}

/// Adds the URDDs at or below a folder, or else its URDFs.
fn add_folder(path: &Path, settings: &Settings, collection: &Collection) -> Result<(), String> {
    match collection.add(path) {
        Err(DiscoverError::NoUrdd { .. }) if path.is_dir() => {}
        other => return other.map_err(|error| error.to_string()),
    }
    let batch = robots::found(&[path.to_owned()], settings).map_err(|error| match error {
        BatchError::Empty { path } => {
            format!("{path}: there is no URDD, and no .urdf or .xacro file, at any depth")
        }
        error => error.to_string(),
    })?;
    batch.asides(0).iter().for_each(|aside| output::error(aside));
    let mut jobs = batch.jobs;
    let count = jobs.len();
    if !settings.xacro.expand_urdf {
        jobs.retain(|job| !FileType::Xacro.is_of(&job.source));
    }
    let left = count - jobs.len();
    if left > 0 {
        let files = output::counted(left, ".xacro file");
        let told = format!("{}: left out {files}; --xacro runs them", path.display());
        if jobs.is_empty() {
            return Err(told);
        }
        output::error(&escape::line(&told));
    }
    for job in jobs {
        add_source(job, collection);
    }
    Ok(())
}

fn add_source(Job { source, name, arguments, .. }: Job, collection: &Collection) {
    // The working directory may change later.
    let file = std::path::absolute(&source).unwrap_or(source);
    collection.add_source(name, Source { file, packages: Vec::new(), arguments });
}
