//! Why a site was not written.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use urdd_directory::root::ReadError;
use urdd_directory::staging::StagingError;

/// Why a site was not written. The previous content is still in place.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The folder contains something else.
    #[error("{}: this folder is not empty, and not a site that `urdd view --export` wrote; give another one", .0.display())]
    Occupied(PathBuf),
    /// The folder contains a site of 0.2.0, which has no list of its files.
    /// The paths written by 0.2.0 that still exist are named.
    #[error(
        "{}: urdd 0.2.0 wrote this site without a list of its files, so nothing was changed. Delete what it wrote ({}; check \
         that nothing below robots is yours) and run this again: all other files stay",
        .0.display(), names(.1)
    )]
    Unlisted(PathBuf, Vec<PathBuf>),
    /// The user's files are at the paths of the site's files.
    #[error(
        "{}: not written by the last export, or changed since, and would be overwritten; nothing was changed. Move it \
         away, and run this again",
        names(.0)
    )]
    InTheWay(Vec<PathBuf>),
    /// It cannot be written.
    #[error(transparent)]
    Write(#[from] StagingError),
    /// The page's built-in data is corrupt.
    #[error("the page cannot be unpacked: {0}")]
    Page(io::Error),
    /// A robot is too large for one file: its name, and its size in bytes.
    #[error("{0}: {1} bytes are too many for a page in one file; give a folder")]
    TooLarge(String, u64),
    /// A robot cannot be read.
    #[error("{0}: {1}")]
    Robot(String, ReadError),
}

fn names(paths: &[PathBuf]) -> String {
    const MOST: usize = 8;
    let shown = paths.iter().take(MOST);
    let mut names: Vec<String> = shown.map(|path| path.display().to_string()).collect();
    if paths.len() > MOST {
        names.push(format!("and {} more", paths.len() - MOST));
    }
    names.join(", ")
}
