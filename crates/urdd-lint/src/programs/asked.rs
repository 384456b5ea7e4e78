//! What programs do with a file.

use std::path::Path;

use urdd_format::report::ProgramResult;
use urdd_xml::Counted;

use super::answers;
use super::faults::{Faulty, faults};
use super::places::Encoding;
use crate::settings::LintSettings;

/// What programs do with a file.
pub struct Asked {
    /// What reports say.
    pub results: Vec<ProgramResult>,
    /// The faults that programs name, in order of place.
    pub(super) faults: Vec<Faulty>,
    /// Whether the settings name programs.
    pub(super) has_chosen: bool,
    pub(super) encoding: Encoding,
}

impl Asked {
    /// Asks the programs about a file of which `text` is the text. Relative names refer to `folder`.
    pub fn about(file: Counted<'_>, text: &str, folder: &Path, settings: &LintSettings) -> Self {
        let (bytes, answers) = (file.bytes(), answers::ask(file, folder, settings));
        let encoding = Encoding::of(bytes, text);
        let results = answers::results(&answers, &encoding, text);
        Asked {
            results,
            faults: faults(answers, bytes),
            has_chosen: !settings.report.programs.is_empty(),
            encoding,
        }
    }
}
