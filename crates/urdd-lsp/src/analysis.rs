//! Finds what is wrong with a document, and what still stands of that in a later version.

use std::collections::BTreeSet;
use std::ops::Range;

use lsp_types::{DiagnosticRelatedInformation, DiagnosticSeverity, NumberOrString, TextEdit};
use urdd_directory::cancellation::Cancellation;
use urdd_findings::check::Outcome;
use urdd_findings::report::programs;
use urdd_lint::settings::WITHOUT_MESHES;
use urdd_lint::{LintSettings, lint_text};

use crate::diagnostics::{Found, at_the_top, failures, of_check};
use crate::document::{FileKind, Snapshot};
use crate::project::Project;
use crate::{urdd_documents, xacro};

/// How much is examined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Only the text: while somebody types.
    Text,
    /// Mesh files too, and what xacro makes of the file: when it is opened or saved.
    Files,
}

/// What was found in a version of a document.
#[derive(Debug, Default)]
pub struct Analysis {
    pub found: Vec<Found>,
    /// The rules that only [`Depth::Files`] runs; those of the last run stay until then.
    pub postponed: Postponed,
    /// What programs do with a URDF, a line for those that do the same.
    pub programs: Vec<String>,
}

#[derive(Debug, Default, PartialEq, Eq)]
pub enum Postponed {
    /// Every rule was run.
    #[default]
    None,
    Codes(BTreeSet<&'static str>),
    /// All that [`Depth::Files`] finds.
    All,
}

impl Analysis {
    /// Findings of a run of every rule.
    pub fn of(found: Vec<Found>) -> Self {
        Analysis { found, ..Analysis::default() }
    }

    /// Examines a document. `None` if it is cancelled.
    pub fn new(snapshot: &Snapshot, depth: Depth, cancellation: &Cancellation) -> Option<Self> {
        let analysis = match (snapshot.kind, snapshot.excess()) {
            (FileKind::Other, _) => Analysis::default(),
            (_, Some(excess)) => return Some(too_large(snapshot, excess)),
            (FileKind::Urdf | FileKind::Xacro, None) => of_xml(snapshot, depth, cancellation),
            (FileKind::Urdd { schema, is_yaml }, None) => {
                let found = urdd_documents::check(snapshot, schema, is_yaml);
                Analysis::of(found.into_iter().map(Found::from).collect())
            }
        };
        (!cancellation.is_cancelled()).then_some(analysis)
    }
}

fn too_large(snapshot: &Snapshot, excess: &str) -> Analysis {
    let command = match snapshot.kind {
        FileKind::Urdd { .. } => "urdd validate",
        _ => "urdd lint",
    };
    let message =
        format!("the file is too large for the editor: {excess}; `{command}` examines it");
    Analysis::of(vec![at_the_top(snapshot, DiagnosticSeverity::WARNING, &message)])
}

fn of_xml(snapshot: &Snapshot, depth: Depth, cancellation: &Cancellation) -> Analysis {
    let project = Project::of(snapshot, cancellation);
    if project.is_excluded() {
        return Analysis::default();
    }
    let mut analysis = match (&snapshot.kind, depth) {
        (FileKind::Xacro, Depth::Text) => {
            let found = xacro::of_text(snapshot);
            Analysis { found, postponed: Postponed::All, ..Analysis::default() }
        }
        (FileKind::Xacro, Depth::Files) => Analysis::of(xacro::of_files(snapshot, &project)),
        _ => of_urdf(snapshot, depth, &project),
    };
    analysis.found.extend(project.faults);
    analysis
}

fn of_urdf(snapshot: &Snapshot, depth: Depth, project: &Project) -> Analysis {
    let settings =
        LintSettings { without_meshes: depth == Depth::Text, ..project.settings.clone() };
    let text = snapshot.text.content();
    let examined = lint_text(text, &snapshot.name(), &snapshot.folder, &settings);
    let examined = project.apply(snapshot, examined);
    let checks = examined.checks.iter();
    let mut found: Vec<Found> =
        checks.clone().flat_map(|check| of_check(snapshot, check)).collect();
    found.extend(failures(snapshot, &examined));
    let waiting = checks.filter(|check| check.outcome == Outcome::Skipped(WITHOUT_MESHES));
    let postponed = match depth {
        Depth::Text => Postponed::Codes(waiting.map(|check| check.rule.code.as_str()).collect()),
        Depth::Files => Postponed::None,
    };
    Analysis { found, postponed, programs: programs::lines(examined) }
}

/// The findings of an earlier version that still stand in a later one.
pub fn kept(
    (before, old): (&Snapshot, &Analysis),
    now: &Snapshot,
    postponed: &Postponed,
) -> Vec<Found> {
    let is_postponed = |found: &&Found| match (postponed, &found.diagnostic.code) {
        (Postponed::None, _) => false,
        (Postponed::All, _) => true,
        (Postponed::Codes(codes), Some(NumberOrString::String(code))) => {
            codes.contains(code.as_str())
        }
        (Postponed::Codes(_), _) => false,
    };
    let old = old.found.iter().filter(is_postponed);
    old.filter_map(|found| moved(found, before, now)).collect()
}

fn moved(found: &Found, before: &Snapshot, now: &Snapshot) -> Option<Found> {
    let mut found = found.clone();
    let diagnostic = &mut found.diagnostic;
    diagnostic.range = moved_range(diagnostic.range, before, now)?;
    let others = diagnostic.related_information.iter_mut().flatten();
    for DiagnosticRelatedInformation { location, .. } in others {
        if location.uri == before.uri {
            location.range = moved_range(location.range, before, now)?;
        }
    }
    found.repairs.retain_mut(|repair| {
        let mut edits = repair.edits.iter_mut();
        edits.all(|TextEdit { range, .. }| match moved_range(*range, before, now) {
            Some(new) => {
                *range = new;
                true
            }
            None => false,
        })
    });
    Some(found)
}

/// A range in a later version; `None` if the link or joint around it is not the same to the byte.
fn moved_range(
    range: lsp_types::Range,
    before: &Snapshot,
    now: &Snapshot,
) -> Option<lsp_types::Range> {
    let (start, end) = (before.text.offset(range.start), before.text.offset(range.end));
    let (kind, name, old) = around(before, start).filter(|(.., old)| end <= old.end)?;
    let new = named(now, &kind, &name)?;
    if before.text.as_str().get(old.clone()) != now.text.as_str().get(new.clone()) {
        return None;
    }
    let shifted = |offset: usize| offset - old.start + new.start;
    Some(now.text.range(shifted(start)..shifted(end)))
}

/// The link or joint around an offset: what it is, its name and its bytes.
fn around(snapshot: &Snapshot, offset: usize) -> Option<(String, String, Range<usize>)> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let after = markup.elements.partition_point(|one| one.tag.start <= offset);
    let mut ancestors = markup.ancestors(after.checked_sub(1)?);
    let part = ancestors.find(|one| matches!(markup.name(text, *one), "link" | "joint"))?;
    let element = &markup.elements[part];
    let name = markup.value(text, part, "name")?;
    let kind = markup.name(text, part).to_owned();
    let range = element.tag.start..element.end;
    range.contains(&offset).then(|| (kind, name.into_owned(), range))
}

/// The bytes of the link or joint of a name.
fn named(snapshot: &Snapshot, kind: &str, name: &str) -> Option<Range<usize>> {
    let element = snapshot.outline().element(kind, name)?;
    let element = &snapshot.markup().elements[element];
    Some(element.tag.start..element.end)
}
