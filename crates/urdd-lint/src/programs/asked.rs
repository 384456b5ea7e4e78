//! Asks the readers what programs do with a file.

use std::path::Path;

use urdd_directory::position::LineIndex;
use urdd_format::index::Count;
use urdd_format::report::{ProgramEffect, ProgramResult};
use urdd_programs::{Effect, File, Program};
use urdd_source::TextOffsets;
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
}

impl Asked {
    /// Asks the programs about a file of which `text` is the text; `offsets` says where its bytes are there. Relative names
    /// refer to `folder`.
    pub fn about(
        file: Counted<'_>,
        text: &str,
        offsets: &TextOffsets,
        folder: &Path,
        settings: &LintSettings,
    ) -> Self {
        let mut answers = ask(file, folder, settings);
        for effect in answers.iter_mut().flat_map(|answer| &mut answer.effects.0) {
            effect.at = offsets.of(effect.at);
        }
        Asked {
            results: results(&answers, text),
            faults: faults(answers, text),
            has_chosen: !settings.report.programs.is_empty(),
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
fn results(answers: &[Answer], text: &str) -> Vec<ProgramResult> {
    let lines = LineIndex::new(text);
    let effect = |effect: &Effect| {
        let at = lines.position(effect.at);
        ProgramEffect {
            does: effect.deed,
            line: Some(Count(at.line)),
            column: Some(Count(at.column)),
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
