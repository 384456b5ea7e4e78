//! Findings as editors show them, changes that mend them, and what keeps rules from running: a text that is not XML, a rule that
//! crashed.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::path::Path;

use lsp_types::{
    CodeAction, CodeActionKind, CodeActionOrCommand, CodeActionParams, Diagnostic,
    DiagnosticRelatedInformation, DiagnosticSeverity, Location, NumberOrString, OneOf,
    OptionalVersionedTextDocumentIdentifier, Position, TextDocumentEdit, TextEdit, WorkspaceEdit,
};
use urdd_findings::check::Examined;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::finding::Finding;
use urdd_format::escape;
use urdd_format::index::Count;
use urdd_format::report::{Fix, Place, Severity};

use crate::document::Snapshot;
use crate::uri;

/// What diagnostics name as their source.
pub const SOURCE: &str = "urdd";

#[derive(Debug, Clone)]
pub struct Found {
    pub diagnostic: Diagnostic,
    /// Changes that mend it, the best first.
    pub repairs: Vec<Repair>,
}

#[derive(Debug, Clone)]
pub struct Repair {
    pub title: String,
    /// Whether it is the one right answer.
    pub is_safe: bool,
    pub edits: Vec<TextEdit>,
}

impl From<Diagnostic> for Found {
    fn from(diagnostic: Diagnostic) -> Self {
        Found { diagnostic, repairs: Vec::new() }
    }
}

/// A diagnostic. `values` are what is expected and what is found.
pub fn diagnostic(
    range: lsp_types::Range,
    severity: DiagnosticSeverity,
    code: &str,
    message: &str,
    values: (Option<&str>, Option<&str>),
) -> Diagnostic {
    let mut text = escape::line(message).into_owned();
    for (word, value) in [("expected", values.0), ("found", values.1)] {
        if let Some(value) = value {
            text += &format!("\n{word}: {}", escape::line(value));
        }
    }
    Diagnostic {
        range,
        severity: Some(severity),
        code: (!code.is_empty()).then(|| NumberOrString::String(code.to_owned())),
        source: Some(SOURCE.to_owned()),
        message: text,
        ..Diagnostic::default()
    }
}

/// An error at the start of a text, about all of it.
pub fn at_the_top(snapshot: &Snapshot, severity: DiagnosticSeverity, message: &str) -> Found {
    let end = snapshot.text.line_end(0);
    diagnostic(snapshot.text.range(0..end), severity, "", message, (None, None)).into()
}

/// The findings of a rule, each place by itself.
pub fn of_check(snapshot: &Snapshot, check: &Check) -> Vec<Found> {
    let places =
        check.findings.iter().flat_map(|finding| finding.places().map(move |p| (finding, p)));
    places.map(|(finding, place)| of_place(snapshot, check, finding, place)).collect()
}

/// A place of a finding of a rule, shown at a byte offset of the document.
pub fn of_offset(
    snapshot: &Snapshot,
    check: &Check,
    finding: &Finding,
    place: &Place,
    offset: usize,
    message: &str,
) -> Diagnostic {
    let severity = match finding.severity.unwrap_or(check.severity) {
        Severity::Error => DiagnosticSeverity::ERROR,
        Severity::Warning => DiagnosticSeverity::WARNING,
        Severity::Info => DiagnosticSeverity::INFORMATION,
    };
    let range = snapshot.text.range(marked(snapshot, offset));
    let values = (place.expected.as_deref(), place.actual.as_deref());
    diagnostic(range, severity, check.rule.code.as_str(), message, values)
}

fn of_place(snapshot: &Snapshot, check: &Check, finding: &Finding, place: &Place) -> Found {
    let at = offset(snapshot, place);
    let mut diagnostic = of_offset(snapshot, check, finding, place, at, &message(finding, place));
    let related: Vec<DiagnosticRelatedInformation> =
        place.related.iter().filter_map(|other| related(snapshot, other)).collect();
    diagnostic.related_information = (!related.is_empty()).then_some(related);
    Found {
        diagnostic,
        repairs: place.fixes.iter().filter_map(|fix| repair(snapshot, fix)).collect(),
    }
}

/// What is wrong at a place, with the link or joint if the message does not name it.
pub fn message(finding: &Finding, place: &Place) -> String {
    let message = place.message.as_ref().unwrap_or(&finding.message);
    let subject = place.subject.as_deref().unwrap_or_default();
    let name = subject.split('`').nth(1).unwrap_or_default();
    match subject.is_empty() || message.contains(&format!("`{name}`")) {
        true => message.clone(),
        false => format!("{subject}: {message}"),
    }
}

/// The offset of a place; the start of the text if it has none.
fn offset(snapshot: &Snapshot, place: &Place) -> usize {
    let column = place.column.map_or(1, Count::get);
    match place.line {
        Some(line) => snapshot.text.reported(line.get(), column),
        None => snapshot.text.content_start(),
    }
}

fn related(snapshot: &Snapshot, place: &Place) -> Option<DiagnosticRelatedInformation> {
    let message = place.message.clone().or_else(|| place.subject.clone());
    let is_here = place.file.as_deref().is_none_or(|file| file == snapshot.name());
    let location = if is_here {
        let range = snapshot.text.range(marked(snapshot, offset(snapshot, place)));
        Location { uri: snapshot.uri.clone(), range }
    } else {
        let line = place.line.map_or(1, Count::get);
        line_of(&snapshot.folder.join(place.file.as_deref()?), line)?
    };
    Some(further(location, &message.unwrap_or_default()))
}

/// The start of a line of another file, from 1. Its columns cannot be counted without its text: the line is enough.
pub fn line_of(file: &Path, line: usize) -> Option<Location> {
    let line = u32::try_from(line.saturating_sub(1)).unwrap_or(u32::MAX);
    let start = Position::new(line, 0);
    Some(Location { uri: uri::of_path(file)?, range: lsp_types::Range::new(start, start) })
}

/// A further place that a diagnostic points to.
pub fn further(location: Location, message: &str) -> DiagnosticRelatedInformation {
    DiagnosticRelatedInformation { location, message: escape::line(message).into_owned() }
}

/// A fix of a report; `None` if it changes another file.
fn repair(snapshot: &Snapshot, fix: &Fix) -> Option<Repair> {
    let name = snapshot.name();
    let edit = |edit: &urdd_format::report::TextEdit| {
        let start = snapshot.text.reported(edit.line.get(), edit.column.get());
        let end = snapshot.text.reported(edit.end_line.get(), edit.end_column.get());
        (edit.file == name).then(|| TextEdit {
            range: snapshot.text.range(start..end.max(start)),
            new_text: edit.text.clone(),
        })
    };
    Some(Repair {
        title: fix.message.clone(),
        is_safe: fix.is_safe,
        edits: fix.edits.iter().map(edit).collect::<Option<_>>()?,
    })
}

/// What to underline for a finding at an offset: the attribute, or the start tag as far as its first line goes.
pub fn marked(snapshot: &Snapshot, offset: usize) -> Range<usize> {
    let text = &snapshot.text;
    let markup = snapshot.markup();
    let end_of_line = text.line_end(offset).max(offset);
    let after = markup.elements.partition_point(|one| one.tag.start <= offset);
    let element = after.checked_sub(1).map(|last| &markup.elements[last]);
    let Some(element) = element.filter(|element| offset < element.tag.end) else {
        return offset..end_of_line.min(offset + 1).max(offset);
    };
    if element.tag.start == offset {
        return offset..element.tag.end.min(end_of_line);
    }
    let attribute = element
        .attributes
        .iter()
        .find(|attribute| attribute.name.start <= offset && offset <= attribute.value.end);
    match attribute {
        // With its second quote.
        Some(attribute) => offset..(attribute.value.end + 1).min(element.tag.end).min(end_of_line),
        None => offset..element.tag.end.min(end_of_line),
    }
}

/// What kept rules from running to their end.
pub fn failures(snapshot: &Snapshot, examined: &Examined) -> Vec<Found> {
    let mut failures = Vec::new();
    let is_said =
        |examined: &Examined| examined.checks.iter().any(|check| !check.findings.is_empty());
    if let Some(why) = examined.report.not_examined.as_ref().filter(|_| !is_said(examined)) {
        failures.push(at_the_top(snapshot, DiagnosticSeverity::ERROR, &why.reason));
    }
    for check in &examined.checks {
        if let Outcome::Crashed(reason) = &check.outcome {
            let message = format!(
                "rule {} crashed: {reason}; this is a bug in urdd, please report it",
                check.rule.code.as_str()
            );
            failures.push(at_the_top(snapshot, DiagnosticSeverity::WARNING, &message));
        }
    }
    failures
}

/// Why a text is not XML, if it is not.
pub fn not_well_formed(snapshot: &Snapshot) -> Option<Found> {
    let text = snapshot.text.content();
    let error = urdd_xml::parse(text, urdd_xml::Kind::Robot).err()?;
    let offset = snapshot.text.content_start() + error.offset(text);
    let end = snapshot.text.line_end(offset).max(offset);
    let range = snapshot.text.range(offset..end);
    let message = error.sentence(text);
    Some(diagnostic(range, DiagnosticSeverity::ERROR, "", &message, (None, None)).into())
}

/// All safe fixes of a document, for editors that apply them on save.
pub const FIX_ALL: CodeActionKind = CodeActionKind::SOURCE_FIX_ALL;

/// The actions at a range. `has_versions` states whether the editor takes edits of a version of a document.
pub fn code_actions(
    snapshot: &Snapshot,
    found: &[Found],
    params: &CodeActionParams,
    has_versions: bool,
) -> Vec<CodeActionOrCommand> {
    let wanted = params.context.only.as_deref();
    let wants = |kind: &CodeActionKind| {
        wanted.is_none_or(|wanted| {
            wanted.iter().any(|one| {
                kind.as_str() == one.as_str()
                    || kind.as_str().starts_with(&format!("{}.", one.as_str()))
            })
        })
    };
    let edit = |edits: Vec<TextEdit>| workspace_edit(snapshot, edits, has_versions);
    let mut actions = Vec::new();
    if wants(&CodeActionKind::QUICKFIX) {
        for one in found.iter().filter(|one| touch(one.diagnostic.range, params.range)) {
            for (place, repair) in one.repairs.iter().enumerate() {
                actions.push(CodeAction {
                    title: repair.title.clone(),
                    kind: Some(CodeActionKind::QUICKFIX),
                    diagnostics: Some(vec![one.diagnostic.clone()]),
                    edit: Some(edit(repair.edits.clone())),
                    is_preferred: Some(repair.is_safe && place == 0),
                    ..CodeAction::default()
                });
            }
        }
    }
    let safe = all_safe(found);
    if !safe.is_empty() && wants(&FIX_ALL) {
        actions.push(CodeAction {
            title: format!("fix all safe findings ({})", safe.len()),
            kind: Some(FIX_ALL),
            edit: Some(edit(safe.into_iter().flatten().collect())),
            ..CodeAction::default()
        });
    }
    actions.into_iter().map(CodeActionOrCommand::CodeAction).collect()
}

/// The edits of the first safe fix of each finding, without those that overlap earlier ones.
fn all_safe(found: &[Found]) -> Vec<Vec<TextEdit>> {
    let mut taken: Vec<Vec<TextEdit>> = Vec::new();
    // The ends of edits by their beginnings: none touches another repair.
    let mut ends: BTreeMap<Position, Position> = BTreeMap::new();
    for one in found {
        let Some(repair) = one.repairs.iter().find(|repair| repair.is_safe) else {
            continue;
        };
        let overlaps = |edit: &TextEdit| {
            let before = ends.range(..=edit.range.end).next_back();
            before.is_some_and(|(_, end)| *end >= edit.range.start)
        };
        if !repair.edits.iter().any(overlaps) {
            for edit in &repair.edits {
                let end = ends.entry(edit.range.start).or_insert(edit.range.end);
                *end = edit.range.end.max(*end);
            }
            taken.push(repair.edits.clone());
        }
    }
    taken
}

/// Whether two ranges overlap, or touch.
fn touch(a: lsp_types::Range, b: lsp_types::Range) -> bool {
    a.start <= b.end && b.start <= a.end
}

fn workspace_edit(snapshot: &Snapshot, edits: Vec<TextEdit>, has_versions: bool) -> WorkspaceEdit {
    let uri = snapshot.uri.clone();
    if has_versions {
        let version = Some(snapshot.version);
        let edit = TextDocumentEdit {
            text_document: OptionalVersionedTextDocumentIdentifier { uri, version },
            edits: edits.into_iter().map(OneOf::Left).collect(),
        };
        return WorkspaceEdit {
            document_changes: Some(lsp_types::DocumentChanges::Edits(vec![edit])),
            ..WorkspaceEdit::default()
        };
    }
    #[expect(clippy::mutable_key_type, reason = "the protocol's type; URIs are not changed")]
    let changes = HashMap::from([(uri, edits)]);
    WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() }
}
