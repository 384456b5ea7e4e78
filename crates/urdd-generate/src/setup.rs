//! Writes what an import says for exports beside the URDD: `NAME.export.toml`.

use std::path::Path;

use urdd_directory::layout::setup_beside;
use urdd_directory::outputs::{self, Output, OutputError, Target};
use urdd_import::Imported;
use urdd_source::note::{Note, NoteKind};

/// Writes the file, unless there is one: it may be a person's. Says so then, and where it cannot be written.
pub(super) fn write(imported: &Imported, target: &Path) -> Option<Note> {
    let text = imported.setup()?;
    let path = setup_beside(target);
    let own = Output { path: path.file_name()?.into(), bytes: text, replaces: false };
    let assumed = match outputs::write(Target::File(&path), vec![own]).err()? {
        OutputError::Exists(_) => {
            "it stays as it is; `urdd import` writes the new one elsewhere".to_owned()
        }
        error => format!("it is not written: {error}"),
    };
    Some(Note {
        kind: NoteKind::LeftBehind,
        file: path.display().to_string(),
        line: 0,
        column: 0,
        problem: "the description says other gains, or another base, than this file".to_owned(),
        assumed,
    })
}
