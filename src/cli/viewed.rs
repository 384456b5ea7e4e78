//! The robots at the paths that `urdd view` gets.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::output;
use urdd_directory::discover::DiscoverError;
use urdd_format::escape;
use urdd_source::Files;
use urdd_source::import::format_of;
use urdd_source::robots::{self, BatchError, Job};
use urdd_view::{Collection, Source};

/// Adds the robots at these paths. Returns how many there are at each.
///
/// # Errors
/// A message if a path has no robot, or cannot be searched.
pub(super) fn add(
    paths: &[PathBuf],
    with_xacro: bool,
    collection: &Collection,
) -> Result<Vec<usize>, String> {
    let names = names(paths)?;
    let one = |path: &PathBuf| {
        let before = collection.robots().len();
        match names.get(path) {
            Some(name) => add_source(path.clone(), name.clone(), collection),
            None => add_folder(path, with_xacro, collection)?,
        }
        Ok(collection.robots().len() - before)
    };
    paths.iter().map(one).collect()
}

fn ends(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// The names of the robots of files, by path: URDFs, xacro files, and what is imported.
fn names(paths: &[PathBuf]) -> Result<HashMap<PathBuf, String>, String> {
    let is_source = |path: &&PathBuf| {
        let is_imported = || format_of(path, &Files::Disk).is_some();
        path.is_file() && (ends(path, "xacro") || ends(path, "urdf") || is_imported())
    };
    let files: Vec<PathBuf> = paths.iter().filter(is_source).cloned().collect();
    let jobs = robots::jobs(&files).map_err(|error| error.to_string())?;
    let named = |Job { source, name }: &Job| (source.canonicalize().ok(), name.clone());
    let by_place: HashMap<Option<PathBuf>, String> = jobs.iter().map(named).collect();
    let of = |file: PathBuf| {
        let place = file.canonicalize().ok();
        let name = by_place.get(&place).cloned().unwrap_or_else(|| "robot".to_owned());
        // Often the file is `robot.urdf`, and the folder has the robot's name.
        let parent = place.as_deref().and_then(Path::parent).and_then(Path::file_name);
        match parent {
            Some(parent) if name == "robot" => (file, parent.to_string_lossy().into_owned()),
            _ => (file, name),
        }
    };
    Ok(files.into_iter().map(of).collect())
}

/// Adds the URDDs at or below a folder, or else its URDFs.
fn add_folder(path: &Path, with_xacro: bool, collection: &Collection) -> Result<(), String> {
    match collection.add(path) {
        Err(DiscoverError::NoUrdd { .. }) if path.is_dir() => {}
        other => return other.map_err(|error| error.to_string()),
    }
    let mut jobs = robots::jobs(&[path.to_owned()]).map_err(|error| match error {
        BatchError::Empty { path } => {
            format!("{path}: there is no URDD, and no .urdf or .urdf.xacro file, at any depth")
        }
        error => error.to_string(),
    })?;
    let count = jobs.len();
    if !with_xacro {
        jobs.retain(|job| !ends(&job.source, "xacro"));
    }
    let left = count - jobs.len();
    if left > 0 {
        let files = output::counted(left, ".urdf.xacro file");
        let told = format!("{}: left out {files}; --xacro runs them", path.display());
        if jobs.is_empty() {
            return Err(told);
        }
        output::error(&escape::line(&told));
    }
    for Job { source, name } in jobs {
        add_source(source, name, collection);
    }
    Ok(())
}

fn add_source(source: PathBuf, name: String, collection: &Collection) {
    // The working directory may change later.
    let file = std::path::absolute(&source).unwrap_or(source);
    collection.add_source(name, Source { file, packages: Vec::new() });
}
