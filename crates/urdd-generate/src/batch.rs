//! Generates URDDs for many robots: finds the sources, names the outputs, and continues after a failed robot.

use std::collections::BTreeMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;
use thiserror::Error;

use super::error::GenerateError;
use super::progress::Progress;
use super::robot::{Generated, generate};
use super::settings::Settings;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_FOLDER_DEPTH;

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
pub enum BatchError {
    /// No such path.
    #[error("{path}: no such file or folder")]
    Missing {
        /// The path as given.
        path: String,
    },
    /// A folder that cannot be searched.
    #[error("{path}: the folder cannot be searched: {reason}")]
    Unreadable {
        /// The path.
        path: String,
        /// The operating system's error message.
        reason: String,
    },
    /// A folder below the maximum search depth.
    #[error(
        "{path}: folders more than {MAX_FOLDER_DEPTH} levels deep are not searched; give this folder itself"
    )]
    TooDeep {
        /// The folder.
        path: String,
    },
    /// A folder without URDFs.
    #[error("{path}: there is no .urdf or .urdf.xacro file at any depth")]
    Empty {
        /// The path as given.
        path: String,
    },
}

/// Whether these paths form a batch: several paths, or a folder.
pub fn is_batch(paths: &[PathBuf]) -> bool {
    paths.len() > 1 || paths.iter().any(|path| path.is_dir())
}

/// Finds the robots. A file is used as given. A folder is searched for every `.urdf`, and for every `.urdf.xacro`
/// without a `.urdf` beside it. The search skips hidden folders, symbolic links to folders, and URDDs, which contain
/// copies of their URDFs. Duplicate paths count once.
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
        search(path, 0, &mut sources)?;
        if sources.len() == before {
            return Err(BatchError::Empty { path: shown });
        }
    }
    let mut seen = std::collections::BTreeSet::new();
    sources.retain(|path| seen.insert(path.canonicalize().unwrap_or_else(|_| path.clone())));
    let names = names(&sources);
    let jobs = sources.into_iter().zip(names);
    Ok(jobs.map(|(source, name)| Job { source, name }).collect())
}

fn search(folder: &Path, depth: usize, sources: &mut Vec<PathBuf>) -> Result<(), BatchError> {
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
                search(&path, depth + 1, sources)?;
            }
        } else if lower.ends_with(".urdf")
            || (lower.ends_with(".urdf.xacro") && !path.with_extension("").is_file())
        {
            sources.push(path);
        }
    }
    Ok(())
}

/// A unique name for each source.
fn names(sources: &[PathBuf]) -> Vec<String> {
    let parts: Vec<Vec<String>> = sources.iter().map(|source| parts(source)).collect();
    let mut used = vec![1; sources.len()];
    let name = |idx: usize, used: usize| parts[idx][parts[idx].len() - used..].join("-");
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

/// The names of a path's folders and its file name without extension, each safe to use in a file name.
fn parts(source: &Path) -> Vec<String> {
    let file = source.file_name().unwrap_or_default().to_string_lossy();
    let mut stem: &str = &file;
    for extension in [".xacro", ".urdf", ".URDF"] {
        stem = stem.strip_suffix(extension).unwrap_or(stem);
    }
    let folders = source.parent().into_iter().flat_map(Path::components);
    let folders = folders.filter_map(|component| match component {
        Component::Normal(name) => Some(name.to_string_lossy().into_owned()),
        _ => None,
    });
    let plain = |name: String| {
        let safe = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
        let name = name.replace(safe, "_");
        match name.trim_start_matches('.') {
            "" => "robot".to_owned(),
            name => name.to_owned(),
        }
    };
    folders.chain([stem.to_owned()]).map(plain).collect()
}

/// One of `n` shards of a batch: every n-th robot. The names are those of the whole batch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// The number of this shard, from 1.
    pub number: usize,
    /// The number of shards.
    pub of: usize,
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse = || {
            let (number, of) = text.split_once('/')?;
            let (number, of) = (number.parse().ok()?, of.parse().ok()?);
            (number >= 1 && number <= of).then_some(Shard { number, of })
        };
        parse().ok_or_else(|| "write i/n with i from 1 to n, such as 2/8".to_owned())
    }
}

impl Shard {
    /// The jobs of this shard.
    pub fn of(self, jobs: Vec<Job>) -> Vec<Job> {
        let mine = jobs.into_iter().enumerate();
        let mine = mine.filter(|(idx, _)| idx % self.of == self.number - 1);
        mine.map(|(_, job)| job).collect()
    }
}

/// Receives the progress and results of a batch.
pub trait Observer: Sync {
    /// A robot is started. The returned value receives the progress of its modules.
    fn begin(&self, job: &Job) -> Box<dyn Progress>;
    /// A robot is finished. Calls come in the order of the batch.
    fn done(&self, job: &Job, outcome: &Result<Generated, GenerateError>);
}

/// Generates a URDD for each job in `folder`, under the job's name, on the threads of the current pool. Returns the
/// number of failures. A panic (a bug in this program) counts as a failure and does not stop the batch. After
/// cancellation no further robot is started.
pub fn run(jobs: &[Job], folder: &Path, settings: &Settings, observer: &dyn Observer) -> usize {
    // Outcomes that wait for earlier ones.
    let waiting = Mutex::new((0, BTreeMap::new()));
    let failed = jobs.par_iter().enumerate().map(|(idx, job)| {
        if settings.cancellation.is_cancelled() {
            return 0;
        }
        let progress = observer.begin(job);
        let target = folder.join(&job.name);
        let outcome = caught(&job.source, || generate(&job.source, &target, settings, &*progress));
        let failed = usize::from(outcome.is_err());
        let mut waiting = waiting.lock().unwrap_or_else(PoisonError::into_inner);
        let (next, outcomes) = &mut *waiting;
        outcomes.insert(idx, outcome);
        while let Some(outcome) = outcomes.remove(next) {
            observer.done(&jobs[*next], &outcome);
            *next += 1;
        }
        failed
    });
    failed.sum()
}

/// Runs `make` for a source and turns a panic into an error.
///
/// # Errors
/// Those of `make`; [`GenerateError::Internal`] for a panic.
pub fn caught(
    source: &Path,
    make: impl FnOnce() -> Result<Generated, GenerateError>,
) -> Result<Generated, GenerateError> {
    catch_unwind(AssertUnwindSafe(make)).unwrap_or_else(|crash| {
        let words = crash.downcast_ref::<String>().cloned();
        let words = words.or_else(|| crash.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        Err(GenerateError::Internal {
            file: source.display().to_string(),
            reason: words.unwrap_or_else(|| "it crashed".to_owned()),
        })
    })
}
