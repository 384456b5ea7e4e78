//! Finds the robot descriptions of paths and folders, and names them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use thiserror::Error;

use super::files::Files;
use super::fragments::{self, imported, may_be_imported};

use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_FOLDER_DEPTH;
use urdd_directory::path;

/// A robot of a batch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// The URDF or xacro file.
    pub source: PathBuf,
    /// The name of its URDD, unique in the batch regardless of case.
    pub name: String,
}

/// Why a batch could not be set up.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum BatchError {
    #[error("{path}: no such file or folder")]
    Missing { path: String },
    #[error("{path}: the folder cannot be searched: {reason}")]
    Unreadable { path: String, reason: String },
    #[error(
        "{path}: folders more than {MAX_FOLDER_DEPTH} levels deep are not searched; give this folder itself"
    )]
    TooDeep { path: String },
    #[error("{path}: there is no .urdf or .urdf.xacro file, and no MJCF or SDF, at any depth")]
    Empty { path: String },
}

/// Whether these paths form a batch: several paths, or a folder.
pub fn is_batch(paths: &[PathBuf]) -> bool {
    paths.len() > 1 || paths.iter().any(|path| path.is_dir())
}

/// Finds the robots. A file is used as given. A folder is searched for every `.urdf`, and for every `.urdf.xacro`
/// without a `.urdf` beside it; one without these, for every SDF, and for every MJCF that is no part of another. The search
/// skips hidden folders, symbolic links to folders, and URDDs, which contain copies of their URDFs. Duplicate paths count
/// once.
///
/// Each robot is named after its file, without the extension. Where names collide, as many parent folder names as
/// necessary are prepended, joined by `-`. If they still collide, a number is appended.
///
/// # Errors
/// If a path does not exist, or a folder cannot be searched or contains no robot.
pub fn jobs(paths: &[PathBuf]) -> Result<Vec<Job>, BatchError> {
    let mut sources = Vec::new();
    for path in paths {
        let shown = path.display().to_string();
        let metadata =
            fs::metadata(path).map_err(|_| BatchError::Missing { path: shown.clone() })?;
        if !metadata.is_dir() {
            sources.push(path.clone());
            continue;
        }
        let before = sources.len();
        let mut found = Found::default();
        search(path, 0, &mut found)?;
        match found.urdfs.is_empty() {
            false => sources.append(&mut found.urdfs),
            true => sources.extend(others(found.others)),
        }
        if sources.len() == before {
            return Err(BatchError::Empty { path: shown });
        }
    }
    let mut seen = std::collections::BTreeSet::new();
    sources.retain(|path| seen.insert(path.canonicalize().unwrap_or_else(|_| path.clone())));
    Ok(named(sources))
}

/// Names each source as [`jobs`] does.
pub(crate) fn named(sources: Vec<PathBuf>) -> Vec<Job> {
    let names = names(&sources);
    sources.into_iter().zip(names).map(|(source, name)| Job { source, name }).collect()
}

/// What a folder holds.
#[derive(Default)]
struct Found {
    /// URDFs and xacro files.
    urdfs: Vec<PathBuf>,
    /// What may be of another format.
    others: Vec<PathBuf>,
}

/// The MJCFs and SDFs among files, without those that are parts of others.
fn others(mut files: Vec<PathBuf>) -> Vec<PathBuf> {
    files.retain(|file| imported(file, &Files::Disk).is_some());
    let parts = fragments::parts(files.iter().map(PathBuf::as_path), &Files::Disk);
    files.retain(|file| !file.canonicalize().is_ok_and(|file| parts.contains(&file)));
    files
}

fn search(folder: &Path, depth: usize, found: &mut Found) -> Result<(), BatchError> {
    let unreadable = |error: std::io::Error| BatchError::Unreadable {
        path: folder.display().to_string(),
        reason: error.to_string(),
    };
    if folder.join(ROOT_METADATA).is_file() {
        return Ok(());
    }
    if depth > MAX_FOLDER_DEPTH {
        let path = folder.display().to_string();
        return Err(BatchError::TooDeep { path });
    }
    let mut entries = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        entries.push((entry.file_name().to_string_lossy().into_owned(), entry.path(), is_folder));
    }
    entries.sort();
    for (name, path, is_folder) in entries {
        let lower = name.to_lowercase();
        if is_folder {
            if !name.starts_with('.') {
                search(&path, depth + 1, found)?;
            }
        } else if lower.ends_with(".urdf")
            || (lower.ends_with(".urdf.xacro") && !path.with_extension("").is_file())
        {
            found.urdfs.push(path);
        } else if may_be_imported(&path) {
            found.others.push(path);
        }
    }
    Ok(())
}

/// A unique name for each source.
fn names(sources: &[PathBuf]) -> Vec<String> {
    let parts: Vec<Vec<String>> = sources.iter().map(|source| parts(source)).collect();
    let mut used = vec![1; sources.len()];
    let name = |idx: usize, used: usize| {
        path::file_name(&parts[idx][parts[idx].len() - used..].join("-"), "")
    };
    loop {
        let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (idx, used) in used.iter().enumerate() {
            let name = name(idx, *used).to_lowercase();
            groups.entry(name).or_default().push(idx);
        }
        let mut grown = false;
        for idx in groups.into_values().filter(|group| group.len() > 1).flatten() {
            if used[idx] < parts[idx].len() {
                used[idx] += 1;
                grown = true;
            }
        }
        if !grown {
            break;
        }
    }
    let mut taken = std::collections::BTreeSet::new();
    let names = (0..sources.len()).map(|idx| {
        let name = name(idx, used[idx]);
        let mut candidate = name.clone();
        let mut number = 2;
        while !taken.insert(candidate.to_lowercase()) {
            candidate = format!("{name}_{number}");
            number += 1;
        }
        candidate
    });
    names.collect()
}

/// The names of a path's folders and its file name without extension, none of them hidden.
fn parts(source: &Path) -> Vec<String> {
    let file = source.file_name().unwrap_or_default().to_string_lossy();
    let mut stem: &str = &file;
    for extension in [".xacro", ".urdf", ".URDF", ".xml", ".sdf"] {
        stem = stem.strip_suffix(extension).unwrap_or(stem);
    }
    let folders = source.parent().into_iter().flat_map(Path::components);
    let folders = folders.filter_map(|component| match component {
        Component::Normal(name) => Some(name.to_string_lossy().into_owned()),
        _ => None,
    });
    let plain = |name: String| match name.trim_start_matches('.') {
        "" => "robot".to_owned(),
        name => name.to_owned(),
    };
    folders.chain([stem.to_owned()]).map(plain).collect()
}
