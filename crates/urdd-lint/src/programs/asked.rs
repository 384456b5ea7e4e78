//! Asks the readers what programs do with a file.

use std::path::Path;

use urdd_directory::position::LineIndex;
use urdd_format::index::Count;
use urdd_format::report::{ProgramEffect, ProgramResult};
use urdd_programs::{Effect, File, Program};
use urdd_xml::Counted;

use super::faults::{Answer, Faulty, faults};
use super::meshes::MeshFiles;
use crate::settings::LintSettings;

/// Maximum number of effects of a program in a report; the rest are counted.
const KEPT: usize = 1_000;

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
        let (bytes, answers) = (file.bytes(), ask(file, folder, settings));
        let encoding = Encoding::of(bytes, text);
        Asked {
            results: results(&answers, &encoding, text),
            faults: faults(answers, bytes),
            has_chosen: !settings.report.programs.is_empty(),
            encoding,
        }
    }
}

/// Asks the programs that the settings name, and those that are always asked. Relative names refer to `folder`.
fn ask(file: Counted<'_>, folder: &Path, settings: &LintSettings) -> Vec<Answer> {
    let meshes = MeshFiles::new(folder, settings);
    let find = |name: &str| meshes.mesh(name);
    let file = File::new(file, &find);
    let mut chosen: Vec<Program> = Vec::new();
    for program in settings.report.programs.iter().flat_map(|name| Program::of_name(name)) {
        if !chosen.contains(&program) {
            chosen.push(program);
        }
    }
    let others = Program::ALL.into_iter().filter(|one| one.is_asked() && !chosen.contains(one));
    let all = chosen.iter().copied().chain(others);
    let mut answers = Vec::new();
    for program in all {
        if settings.report.cancellation.is_cancelled() {
            break;
        }
        let is_chosen = chosen.contains(&program);
        answers.push(Answer { program, is_chosen, effects: program.read(&file) });
    }
    answers
}

/// The answers as reports have them.
fn results(answers: &[Answer], encoding: &Encoding, text: &str) -> Vec<ProgramResult> {
    let lines = LineIndex::new(text);
    let effect = |effect: &Effect| {
        let at = encoding.in_text(effect.at).map(|at| lines.position(at));
        ProgramEffect {
            does: effect.deed,
            line: at.map(|at| Count(at.line)),
            column: at.map(|at| Count(at.column)),
            part: Some(effect.part.to_string()).filter(|part| !part.is_empty()),
            reason: effect.fault.to_string(),
            makes: effect.makes.clone(),
            is_usual: effect.fault.is_usual(),
        }
    };
    let result = |answer: &Answer| {
        let mut all: Vec<_> = answer.effects.0.iter().collect();
        all.sort_by_key(|effect| (effect.at, effect.deed));
        let not_usual = answer.effects.0.iter().filter(|effect| !effect.fault.is_usual());
        ProgramResult {
            program: answer.program.id().to_owned(),
            name: answer.program.name().to_owned(),
            family: answer.program.family().to_owned(),
            version: answer.program.version().to_owned(),
            is_chosen: answer.is_chosen,
            does: not_usual.map(|effect| effect.deed).max(),
            effects_cut: Count::saturating(all.len().saturating_sub(KEPT)),
            effects: all.into_iter().take(KEPT).map(effect).collect(),
        }
    };
    answers.iter().map(result).collect()
}

/// How the bytes of a file become its text.
pub enum Encoding {
    /// They are the text, behind so many bytes of a mark.
    Utf8 { mark: usize },
    /// Each is a character: where it begins in the text.
    Bytes(Vec<usize>),
    /// Several are a character.
    Other,
}

impl Encoding {
    pub fn of(bytes: &[u8], text: &str) -> Self {
        if bytes.ends_with(text.as_bytes()) {
            return Encoding::Utf8 { mark: bytes.len() - text.len() };
        }
        let offsets: Vec<usize> = text.char_indices().map(|(offset, _)| offset).collect();
        if offsets.len() == bytes.len() { Encoding::Bytes(offsets) } else { Encoding::Other }
    }

    /// The offset in the text of a byte of the file, if it is known.
    pub fn in_text(&self, at: usize) -> Option<usize> {
        match self {
            Encoding::Utf8 { mark } => Some(at.saturating_sub(*mark)),
            Encoding::Bytes(offsets) => offsets.get(at).or(offsets.last()).copied(),
            Encoding::Other => None,
        }
    }
}
