//! What runs of producers and validators share: the working folder, the threads, lists of known failures, and why there is
//! no result.

use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::data::Damage;
use crate::tree::{TreeError, make_folder};
use urdd_directory::cancellation::Cancelled;
use urdd_directory::target_lock::Temporary;
use urdd_generate::GenerateError;

pub(crate) type Result<T, E = RunError> = std::result::Result<T, E>;

/// Why the suite cannot be written, or a producer or a validator cannot be run.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum RunError {
    #[error("the suite is damaged: {0}")]
    Damage(#[from] Damage),
    #[error(
        "there is no robot `{0}`; the robots are {1}, and those to refuse, such as `URD005/link-held-by-two-joints` \
         (`urdd conformance export` writes them into `refused`)"
    )]
    UnknownRobot(String, String),
    #[error("no case to run; `urdd conformance export` writes all cases, and their list")]
    NoCase,
    #[error("the skip list: {0}")]
    Skip(#[from] SkipError),
    #[error("{}: this folder is not empty; give a new one", .0.display())]
    NotEmpty(PathBuf),
    #[error("a temporary folder cannot be created: {0}")]
    Temporary(std::io::Error),
    #[error("cannot run {0} commands at a time: {1}")]
    Jobs(usize, rayon::ThreadPoolBuildError),
    #[error(transparent)]
    Tree(#[from] TreeError),
    #[error("{0}: {1}")]
    Generate(String, Box<GenerateError>),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Runs `work` with a number of threads.
///
/// # Errors
/// If the threads cannot be created, or `work` fails.
pub fn with_threads<T: Send>(
    jobs: usize,
    work: impl FnOnce() -> Result<T, RunError> + Send,
) -> Result<T, RunError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(jobs)
        .build()
        .map_err(|error| RunError::Jobs(jobs, error))?
        .install(work)
}

/// A temporary or a persistent folder.
pub struct Workplace {
    path: PathBuf,
    /// Removes the folder on drop, if it is temporary.
    _temporary: Option<Temporary>,
}

impl Workplace {
    /// A temporary folder, or the folder `keep`, which must be new or empty.
    ///
    /// # Errors
    /// If it cannot be created, or is not empty.
    pub fn new(keep: Option<&Path>) -> Result<Workplace, RunError> {
        let Some(path) = keep else {
            let folder = Temporary::begin(&std::env::temp_dir(), "conformance");
            let folder = folder.map_err(RunError::Temporary)?;
            return Ok(Workplace { path: folder.path().to_owned(), _temporary: Some(folder) });
        };
        let failed = |error| TreeError::Read(path.to_owned(), error);
        make_folder(path)?;
        if fs::read_dir(path).map_err(failed)?.next().is_some() {
            return Err(RunError::NotEmpty(path.to_owned()));
        }
        // Absolute, because the command may change its current folder.
        let path = std::path::absolute(path).map_err(failed)?;
        Ok(Workplace { path, _temporary: None })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// A path relative to the current folder; `None` if one of the two cannot be found, or they are on different drives.
pub fn relative(path: &Path) -> Option<PathBuf> {
    // `..` of a symbolic link leads to the folder around its target.
    let here = std::env::current_dir().ok()?.canonicalize().ok()?;
    let path = path.canonicalize().ok()?;
    let (mut up, mut down) = (here.components().peekable(), path.components().peekable());
    while up.peek().is_some() && up.peek() == down.peek() {
        up.next();
        down.next();
    }
    let is_name = |part: &Component| matches!(part, Component::Normal(_));
    let (up, down): (Vec<_>, Vec<_>) = (up.collect(), down.collect());
    let all = up.iter().chain(&down).all(is_name);
    let climb = up.iter().map(|_| Component::ParentDir);
    all.then(|| climb.chain(down.iter().copied()).collect())
}

/// A known failure of an external program. A list of them has a line for each: the skipped item, `#`, and the reason. Empty
/// lines and lines that begin with `#` are ignored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Skip {
    /// Line in the file, from 1.
    pub line: usize,
    /// The words before the reason.
    pub words: Vec<String>,
    /// Reason.
    pub reason: String,
}

impl Skip {
    /// The line as written, without the reason.
    pub fn what(&self) -> String {
        self.words.join(" ")
    }
}

/// Errors in a skip list.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum SkipError {
    #[error("line {0}: say why, after a `#`: `{1}  # reason`")]
    NoReason(usize, String),
    #[error("line {0}: unexpected `{1}`; write {2}")]
    TooMany(usize, String, &'static str),
    #[error("line {0}: there is no `{1}`")]
    Unknown(usize, String),
}

/// Reads a list whose lines have at most `most` words. `form` describes a line, for messages.
///
/// # Errors
/// The first line with too many words or without a reason.
pub fn read_skips(text: &str, most: usize, form: &'static str) -> Result<Vec<Skip>, SkipError> {
    let mut skips = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let (what, reason) = line.split_once('#').unwrap_or((line, ""));
        let words: Vec<String> = what.split_whitespace().map(str::to_owned).collect();
        let skip = Skip { line: index + 1, words, reason: reason.trim().to_owned() };
        match skip.words.len() {
            0 => continue,
            words if words > most => {
                return Err(SkipError::TooMany(skip.line, skip.what(), form));
            }
            _ if skip.reason.is_empty() => {
                return Err(SkipError::NoReason(skip.line, skip.what()));
            }
            _ => skips.push(skip),
        }
    }
    Ok(skips)
}

/// Checks that each skip is about something.
///
/// # Errors
/// The first one that is not.
pub(crate) fn check_skips(
    skips: &[Skip],
    is_known: impl Fn(&Skip) -> bool,
) -> Result<(), SkipError> {
    match skips.iter().find(|skip| !is_known(skip)) {
        Some(skip) => Err(SkipError::Unknown(skip.line, skip.what())),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_skip_has_a_reason() {
        let text = "# what we know\n\ngripper # no mimics yet\nhand  dof_module\t# same # here\n";
        let skips = read_skips(text, 2, "").unwrap();
        assert_eq!(skips.len(), 2);
        assert_eq!(skips[0].reason, "no mimics yet");
        assert_eq!((skips[1].line, skips[1].what().as_str()), (4, "hand dof_module"));
        assert_eq!(skips[1].reason, "same # here");
        assert_eq!(
            read_skips("a # b\ngripper", 2, ""),
            Err(SkipError::NoReason(2, "gripper".to_owned()))
        );
        assert!(matches!(read_skips("a b c # d", 2, ""), Err(SkipError::TooMany(1, ..))));
    }
}
