//! Asks the readers.

use std::path::Path;

use urdd_directory::position::LineIndex;
use urdd_format::index::Count;
use urdd_format::report::{Deed, ProgramEffect, ProgramResult};
use urdd_programs::{Effects, File, Program};
use urdd_xml::Counted;

use super::meshes::MeshFiles;
use super::places::Encoding;
use crate::settings::LintSettings;

/// Maximum number of effects of a program in a report; the rest are counted.
const KEPT: usize = 1_000;

/// What a program does with a file.
pub struct Answer {
    pub program: Program,
    /// Whether the settings name it.
    pub is_chosen: bool,
    pub effects: Effects,
}

/// Asks the programs that the settings name, and those that are always asked. Relative names refer to `folder`.
pub fn ask(file: Counted<'_>, folder: &Path, settings: &LintSettings) -> Vec<Answer> {
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
pub fn results(answers: &[Answer], encoding: &Encoding, text: &str) -> Vec<ProgramResult> {
    let lines = LineIndex::new(text);
    let effect = |effect: &urdd_programs::Effect| {
        let at = encoding.in_text(effect.at).map(|at| lines.position(at));
        ProgramEffect {
            does: deed(effect.deed),
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
            does: not_usual.map(|effect| effect.deed).max().map(deed),
            effects_cut: Count::saturating(all.len().saturating_sub(KEPT)),
            effects: all.into_iter().take(KEPT).map(effect).collect(),
        }
    };
    answers.iter().map(result).collect()
}

/// A deed as reports have it.
pub fn deed(deed: urdd_programs::Deed) -> Deed {
    match deed {
        urdd_programs::Deed::Reads => Deed::Reads,
        urdd_programs::Deed::Drops => Deed::Drops,
        urdd_programs::Deed::Refuses => Deed::Refuses,
        urdd_programs::Deed::Crashes => Deed::Crashes,
    }
}
