//! Why the suite cannot be written, or a producer or a validator cannot be run.

use std::path::PathBuf;

use crate::data::Damage;
use crate::skips::SkipError;
use crate::tree::TreeError;
use urdd_directory::cancellation::Cancelled;
use urdd_generate::GenerateError;

/// Why the suite cannot be written, or a producer or a validator cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A case of the suite is damaged.
    #[error("the suite is damaged: {0}")]
    Damage(#[from] Damage),
    /// The robot does not exist.
    #[error(
        "there is no robot `{0}`; the robots are {1}, and those to refuse, such as `URD005/link-held-by-two-joints` \
         (`urdd conformance export` writes them into `refused`)"
    )]
    UnknownRobot(String, String),
    /// No case matches the version and the ids.
    #[error("no case to run; `urdd conformance export` writes all cases, and their list")]
    NoCase,
    /// The skip list names something that does not exist.
    #[error("the skip list: {0}")]
    Skip(#[from] SkipError),
    /// The folder to write into is not empty.
    #[error("{}: this folder is not empty; give a new one", .0.display())]
    NotEmpty(PathBuf),
    /// A temporary folder cannot be created.
    #[error("a temporary folder cannot be created: {0}")]
    Temporary(std::io::Error),
    /// The thread pool cannot be created.
    #[error("cannot run {0} commands at a time: {1}")]
    Jobs(usize, rayon::ThreadPoolBuildError),
    /// A file or folder cannot be written, read or removed.
    #[error(transparent)]
    Tree(#[from] TreeError),
    /// A valid URDD cannot be generated.
    #[error("{0}: {1}")]
    Generate(String, Box<GenerateError>),
    /// The run was cancelled.
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
