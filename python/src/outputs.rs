//! Files that are written together.

use std::path::{Component, Path, PathBuf};

use pyo3::exceptions::{PyFileExistsError, PyOSError};
use pyo3::prelude::*;
use urdd_directory::outputs::{Output, OutputError, Target, write};

use crate::work;

/// Writes files that belong together, below the folder `target`, or beside the file `target`. What exists with other
/// content is overwritten with `force` only.
#[pyfunction]
pub fn write_files(
    py: Python<'_>,
    target: PathBuf,
    is_folder: bool,
    files: Vec<(PathBuf, Vec<u8>)>,
    force: bool,
) -> PyResult<()> {
    let target = if is_folder { Target::Folder(&target) } else { Target::File(&target) };
    // Meshes may be in a folder beside that of the file.
    let is_up = |part: &Component| *part == Component::ParentDir;
    let up = files.iter().map(|(path, _)| path.components().take_while(is_up).count()).max();
    let folder = std::path::absolute(target.folder())?;
    let above = folder.ancestors().nth(up.unwrap_or_default()).unwrap_or(&folder);
    let target = if above == folder { target } else { Target::Folder(above) };
    let outputs = files.iter().map(|(path, bytes)| {
        let path = if above == folder { path.clone() } else { below(&folder, above, path) };
        Output { path, bytes, replaces: force }
    });
    let outputs = outputs.collect();
    let written = work::run(py, |_| write(target, outputs))?;
    written.map(|_| ()).map_err(|error| match error {
        OutputError::Exists(path) => PyFileExistsError::new_err(format!(
            "{} exists with other content: force=True overwrites it",
            path.display()
        )),
        OutputError::Write { path, error } => {
            PyOSError::new_err((error.raw_os_error(), error.kind().to_string(), path))
        }
        error => PyOSError::new_err(error.to_string()),
    })
}

/// The path of a file that is relative to `folder`, relative to a folder above it.
fn below(folder: &Path, above: &Path, path: &Path) -> PathBuf {
    let mut below = folder.strip_prefix(above).unwrap_or(folder).to_owned();
    for part in path.components() {
        match part {
            Component::ParentDir => _ = below.pop(),
            part => below.push(part),
        }
    }
    below
}
