//! What is wrong with a document of a URDD.

use std::ops::Range;

use lsp_types::{Diagnostic, DiagnosticSeverity};
use serde_json::Value;

use crate::diagnostics::diagnostic;
use crate::document::Snapshot;
use crate::kind::Schema;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::position::{self, Position};
use urdd_directory::regular;
use urdd_directory::text_fault::{TextFault, TextFaultKind, TextFaults};
use urdd_directory::yaml::{self as mirror, places};
use urdd_document::schema_check::SchemaViolation;

/// The faults of a document: of its text, and of its schema.
pub fn check(snapshot: &Snapshot, schema: Option<Schema>, is_yaml: bool) -> Vec<Diagnostic> {
    if is_yaml { of_yaml(snapshot, schema) } else { of_json(snapshot, schema) }
}

fn of_json(snapshot: &Snapshot, schema: Option<Schema>) -> Vec<Diagnostic> {
    let document = match json::read(snapshot.text.as_str().as_bytes()) {
        Ok(document) => document,
        Err(error) => return faults(snapshot, &error.faults),
    };
    let mut found = faults(snapshot, &document.faults);
    let violations = schema.map_or_else(Vec::new, |schema| schema.violations(&document.value));
    let places: Vec<String> = violations.iter().map(SchemaViolation::place).collect();
    let places: Vec<&str> = places.iter().map(String::as_str).collect();
    let places = position::locate_all(&document.text, &places);
    found.extend(violations.iter().zip(places).map(|(violation, place)| {
        let offset = place.map_or(0, |place| offset(snapshot, place));
        of_violation(snapshot, violation, value_at(snapshot, offset))
    }));
    found
}

fn of_yaml(snapshot: &Snapshot, schema: Option<Schema>) -> Vec<Diagnostic> {
    let text = snapshot.text.as_str();
    let own = places::read(text);
    // It is a copy of module.json; without that, at least its form is checked.
    let beside = snapshot.path.as_ref().and_then(|path| {
        let bytes = regular::read(&path.with_file_name("module.json"), MAX_DOCUMENT_BYTES).ok()?;
        Some(json::read(&bytes).ok()?.value)
    });
    let value = beside.as_ref().or(own.as_ref().map(|own| &own.value)).unwrap_or(&Value::Null);
    let mut found = faults(snapshot, &mirror::check_mirror(text.as_bytes(), value));
    let (Some(own), Some(schema)) = (own, schema) else {
        return found;
    };
    for violation in schema.violations(&own.value) {
        let range = own.range(&violation.place()).unwrap_or_else(|| value_at(snapshot, 0));
        found.push(of_violation(snapshot, &violation, range));
    }
    found
}

fn of_violation(
    snapshot: &Snapshot,
    violation: &SchemaViolation,
    range: Range<usize>,
) -> Diagnostic {
    let (expected, actual) = (violation.expected.as_deref(), violation.actual.as_deref());
    diagnostic(
        snapshot.text.range(range),
        DiagnosticSeverity::ERROR,
        "SCH001",
        &violation.message,
        (expected, actual),
    )
}

fn faults(snapshot: &Snapshot, faults: &TextFaults) -> Vec<Diagnostic> {
    let one = |fault: &TextFault| {
        let offset = fault.position.map_or(0, |place| offset(snapshot, place));
        diagnostic(
            snapshot.text.range(value_at(snapshot, offset)),
            DiagnosticSeverity::ERROR,
            code(fault.kind),
            &fault.message,
            (fault.expected.as_deref(), fault.found.as_deref()),
        )
    };
    faults.iter().map(one).collect()
}

fn offset(snapshot: &Snapshot, place: Position) -> usize {
    snapshot.text.reported(place.line as usize, place.column as usize)
}

/// The value that begins at an offset: a text, a word, or a bracket.
fn value_at(snapshot: &Snapshot, start: usize) -> Range<usize> {
    let text = snapshot.text.as_str();
    let rest = &text[start..snapshot.text.line_end(start).max(start)];
    let length = match rest.as_bytes().first() {
        Some(b'{' | b'[' | b'}' | b']' | b',' | b':') => 1,
        Some(b'"') => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
        _ => rest.find([',', ']', '}', ' ', '\t']).unwrap_or(rest.len()),
    };
    start..start + length
}

/// The rule that the validator has for a fault.
fn code(kind: TextFaultKind) -> &'static str {
    use TextFaultKind as Kind;
    match kind {
        Kind::Syntax => "JSN001",
        Kind::DuplicateKey => "JSN002",
        Kind::NotUtf8 => "JSN003",
        Kind::ByteOrderMark => "JSN004",
        Kind::NonFiniteNumber => "JSN005",
        Kind::TooDeep => "JSN006",
        Kind::YamlSyntax
        | Kind::YamlNotUtf8
        | Kind::YamlByteOrderMark
        | Kind::YamlDirective
        | Kind::YamlSeveralDocuments
        | Kind::YamlNonStringKey => "YML001",
        Kind::YamlTag => "YML002",
        Kind::YamlAnchorOrAlias => "YML003",
        Kind::YamlMergeKey => "YML004",
        Kind::YamlDuplicateKey => "YML005",
        Kind::YamlAmbiguousScalar => "YML006",
        Kind::YamlDiffers => "YML007",
        Kind::YamlTooDeep => "YML008",
    }
}
