//! The page and robots as files that any web server can show.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use thiserror::Error;

use super::assets::ASSETS;
use super::collection::{Collection, Shown};
use super::route;
use crate::cancellation::Cancellation;
use crate::directory::root::{EntryKind, ReadError};
use crate::directory::staging::{Staging, StagingError};
use crate::directory::writer::Writer;

/// Most bytes of a file that is copied.
const MAX_FILE_BYTES: u64 = 1 << 30;
/// By this a folder is known as one that an export wrote.
const MARK: &str = "urdd-site.json";

/// Why a site was not written. What stood in its place still does.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The folder holds something else.
    #[error("{}: this folder is not empty, and no site that `urdd view --export` wrote; give another one", .0.display())]
    Occupied(PathBuf),
    /// It cannot be written.
    #[error(transparent)]
    Write(#[from] StagingError),
    /// The page was not built as it should be.
    #[error("the page cannot be unpacked: {0}")]
    Page(io::Error),
    /// A robot is too large for one file.
    #[error("{robot}: {size} bytes are too much for a page in one file; give a folder")]
    TooLarge {
        /// Its name.
        robot: String,
        /// How large it is.
        size: u64,
    },
    /// A robot cannot be read.
    #[error("{robot}: {error}")]
    Robot {
        /// Its name.
        robot: String,
        /// Why.
        error: ReadError,
    },
}

/// Writes the site into a folder, all at once. `tell` hears of each robot that is done.
///
/// # Errors
/// [`ExportError`].
pub fn export(
    collection: &Collection,
    folder: &Path,
    cancellation: &Cancellation,
    tell: &mut dyn FnMut(&Shown),
) -> Result<(), ExportError> {
    let holds_something = fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some());
    if holds_something && !folder.join(MARK).is_file() {
        return Err(ExportError::Occupied(folder.to_owned()));
    }
    let staging = Staging::begin(folder, cancellation)?;
    let writer = Writer::new(staging.content());
    for asset in ASSETS {
        let bytes = asset.bytes().map_err(ExportError::Page)?;
        writer.file(asset.name, &bytes)?;
    }
    let mut entries = Vec::new();
    for robot in collection.robots() {
        if cancellation.is_cancelled() {
            return Err(StagingError::Cancelled.into());
        }
        entries.push(one(robot, &writer)?);
        tell(robot);
    }
    writer.file("robots.json", Value::from(entries).to_string().as_bytes())?;
    let mark = json!({ "made by": "urdd view --export", "version": env!("CARGO_PKG_VERSION") });
    writer.file(MARK, mark.to_string().as_bytes())?;
    staging.commit()?;
    Ok(())
}

/// Writes a robot: its files, their list, and its report.
fn one(robot: &Shown, writer: &Writer) -> Result<Value, ExportError> {
    let unread = |error: ReadError| ExportError::Robot {
        robot: robot.name.clone(),
        error,
    };
    let base = format!("robots/{}", robot.id);
    let root = robot.open().map_err(unread)?;
    for entry in &root.list().map_err(unread)?.entries {
        if entry.kind == EntryKind::File && entry.utf8 {
            // A path that a URDD may not have is in the report, and not on the site.
            match root.read(&entry.path, MAX_FILE_BYTES) {
                Ok(bytes) => writer.file(&format!("{base}/files/{}", entry.path), &bytes)?,
                Err(ReadError::Path(_)) => continue,
                Err(error) => return Err(unread(error)),
            };
        }
    }
    let files = route::files(robot).map_err(unread)?;
    writer.file(&format!("{base}/files.json"), files.to_string().as_bytes())?;
    let report = route::report_of(robot);
    writer.file(&format!("{base}/report.json"), report.as_bytes())?;
    let mut entry = route::entry_with(robot, &report);
    // Nobody writes to a site.
    entry["writable"] = json!(false);
    entry["temporary"] = json!(false);
    if let Some(picture) = route::picture_of(robot) {
        writer.file(&format!("{base}/picture.png"), &picture)?;
        entry["picture"] = json!(format!("{base}/picture.png"));
    }
    Ok(entry)
}
