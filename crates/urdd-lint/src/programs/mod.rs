//! What programs do with a URDF: their readers are asked, and what they say becomes findings and a line a program.

mod answers;
mod attach;
mod faults;
mod fixes;
mod meshes;
mod places;
mod seen;
mod severity;
mod words;

use std::path::Path;

use urdd_format::report::ProgramResult;

pub use attach::{Left, attach, attach_all};
use faults::Faulty;

use crate::settings::LintSettings;

/// What programs do with a file.
pub struct Asked {
    /// What reports say.
    pub results: Vec<ProgramResult>,
    /// The faults that programs name, in order of place.
    faults: Vec<Faulty>,
    /// Whether the settings name programs.
    has_chosen: bool,
    encoding: places::Encoding,
}

impl Asked {
    /// Asks the programs about a file of which `text` is the text. Relative names refer to `folder`.
    pub fn about(bytes: &[u8], text: &str, folder: &Path, settings: &LintSettings) -> Self {
        let answers = answers::ask(bytes, folder, settings);
        let encoding = places::Encoding::of(bytes, text);
        Asked {
            results: answers::results(&answers, &encoding, text),
            faults: faults::faults(&answers, bytes),
            has_chosen: !settings.report.programs.is_empty(),
            encoding,
        }
    }
}
