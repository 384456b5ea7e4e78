//! Documents of a URDD: `urdd.json`, and `module.json` and `module.yaml` of each module, by their schemas. What is wrong with
//! one, and what its values mean.

use std::ops::Range;

use lsp_types::{Diagnostic, DiagnosticSeverity, Hover, Position};
use serde_json::Value;
use urdd_directory::json_scan::pointer_at;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::position::{TextFault, TextFaultKind, TextFaults};
use urdd_directory::yaml::{self as mirror, places};
use urdd_directory::{json, position, regular};
use urdd_document::schema_check::SchemaViolation;
use urdd_format::annotations;
use urdd_format::schema::Variant;

use crate::diagnostics::diagnostic;
use crate::document::{Schema, Snapshot};
use crate::text::markdown;

/// How many references to other parts of the schema are followed.
const MOST_REFERENCES: usize = 20;

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

fn offset(snapshot: &Snapshot, place: position::Position) -> usize {
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

/// What the value at a position means.
pub fn hover(snapshot: &Snapshot, schema: Schema, is_yaml: bool, at: Position) -> Option<Hover> {
    if snapshot.is_too_large() {
        return None;
    }
    let text = snapshot.text.as_str();
    let offset = snapshot.text.offset(at);
    let pointer = match is_yaml {
        true => places::read(text)?.pointer_at(offset)?.to_owned(),
        // The token at the cursor counts, also at its start.
        false => pointer_at(text, (offset + 1).min(text.len())),
    };
    let whole = schema.subject.schema(Variant::Strict);
    let words = words(&whole, &pointer)?;
    let shown = match pointer.as_str() {
        "" => schema.subject.id(),
        pointer => pointer.to_owned(),
    };
    Some(markdown(format!("**`{shown}`**\n\n{words}"), None))
}

/// The description of the value at a pointer, with its unit, frame and length.
fn words(whole: &Value, pointer: &str) -> Option<String> {
    let mut parts = vec![whole];
    for segment in pointer.split('/').skip(1) {
        let key = segment.replace("~1", "/").replace("~0", "~");
        let inner = parts.iter().flat_map(|part| meant(whole, part));
        parts = inner.filter_map(|part| inside(part, &key)).collect();
    }
    let all: Vec<&Value> = parts.iter().flat_map(|part| meant(whole, part)).collect();
    let mut words: Vec<String> = Vec::new();
    for part in all {
        let description = part["description"].as_str().unwrap_or_default().to_owned();
        for text in [description, annotations::sentence(part), values(part)] {
            if !text.is_empty() && !words.contains(&text) {
                words.push(text);
            }
        }
    }
    (!words.is_empty()).then(|| words.join("\n\n"))
}

/// The schema of an element or member.
fn inside<'s>(schema: &'s Value, key: &str) -> Option<&'s Value> {
    if let Some(member) = schema.get("properties").and_then(|all| all.get(key)) {
        return Some(member);
    }
    if let Ok(index) = key.parse::<usize>() {
        let tuple = schema.get("prefixItems").and_then(|all| all.get(index));
        if let Some(element) = tuple.or_else(|| schema.get("items")) {
            return Some(element);
        }
    }
    schema.get("additionalProperties").filter(|other| other.is_object())
}

/// A schema, and those that it refers to or is a choice of.
fn meant<'s>(whole: &'s Value, schema: &'s Value) -> Vec<&'s Value> {
    let mut found = vec![schema];
    let mut next = 0;
    while let Some(one) = found.get(next).copied().filter(|_| found.len() < MOST_REFERENCES) {
        next += 1;
        let reference = one["$ref"].as_str().and_then(|reference| reference.strip_prefix('#'));
        found.extend(reference.and_then(|pointer| whole.pointer(pointer)));
        for choice in ["allOf", "anyOf", "oneOf"] {
            found.extend(one[choice].as_array().into_iter().flatten());
        }
    }
    found
}

fn values(schema: &Value) -> String {
    if let Some(value) = schema.get("const") {
        return format!("`{value}`");
    }
    let words = schema["enum"].as_array().into_iter().flatten();
    let values: Vec<String> = words.map(|value| format!("`{value}`")).collect();
    if values.is_empty() { String::new() } else { format!("One of {}.", values.join(", ")) }
}
