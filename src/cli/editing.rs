//! Edits a module of a URDD: reads the robot, asks for the changed files, and replaces them atomically. Starts again where
//! another program wrote in between.

use std::path::Path;

use super::inputs;
use super::output::{Failure, about};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::read_error::ReadError;
use urdd_directory::replacement::{Files, Replacement};
use urdd_directory::root::Root;
use urdd_format::registry::ModuleKind;
use urdd_robot::Robot;

/// Maximum number of attempts while another program writes to the URDD.
const MAX_TRIES: usize = 5;

/// An edit.
pub struct Edited {
    /// The files that change.
    pub files: Files,
    /// What to print.
    pub told: String,
}

impl Edited {
    /// Nothing changes.
    pub fn unchanged(told: String) -> Self {
        Edited { files: Files::new(), told }
    }
}

/// Edits a module of the URDD in a folder. Returns what to print.
///
/// # Errors
/// If `edit` fails, or the folder cannot be read or written.
pub fn edited(
    urdd: &Path,
    kind: ModuleKind,
    edit: impl Fn(&Robot) -> Result<Edited, Failure>,
) -> Result<String, Failure> {
    if !urdd.is_dir() {
        Err(about(urdd)("not a folder; edits are written into the folder of a URDD"))?;
    }
    for _ in 0..MAX_TRIES {
        let before = state(urdd, kind).map_err(about(urdd))?;
        let robot = inputs::open(urdd)?;
        let Edited { files, told } = edit(&robot)?;
        if files.is_empty() {
            return Ok(told);
        }
        // Takes the lock here. Other programs may have written before.
        let replacement = Replacement::begin(urdd)?;
        if state(urdd, kind).map_err(about(urdd))? != before {
            continue;
        }
        replacement.stage(&files)?;
        replacement.commit()?;
        return Ok(told);
    }
    Err(about(urdd)("another program keeps writing into this folder; nothing was written").into())
}

/// Refuses an SRDF of which nothing can be imported; `wrong` says why.
///
/// # Errors
/// All that is wrong.
pub fn some_read(read: usize, wrong: &[String]) -> Result<(), String> {
    match read == 0 && !wrong.is_empty() {
        true => Err(format!("nothing in it can be imported: {}", wrong.join("; "))),
        false => Ok(()),
    }
}

/// A line for each part of an SRDF that an import leaves out.
pub fn left_out(wrong: &[String]) -> String {
    wrong.iter().map(|wrong| format!("  left out: {wrong}\n")).collect()
}

/// The files that the edits depend on.
fn state(urdd: &Path, kind: ModuleKind) -> Result<Vec<Vec<u8>>, ReadError> {
    let root = Root::open_folder(urdd)?;
    let module = format!("{}/module.json", kind.folder());
    let read = |path: &str| match root.read(path, MAX_DOCUMENT_BYTES) {
        Err(ReadError::Missing) => Ok(Vec::new()),
        read => read,
    };
    [ROOT_METADATA, &module].map(read).into_iter().collect()
}
