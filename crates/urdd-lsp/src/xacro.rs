//! Findings about what xacro makes of a file, shown in the file.

use lsp_types::{Diagnostic, DiagnosticSeverity};

use crate::diagnostics::{Found, at_the_top, diagnostic, marked, message, severity};
use crate::document::Snapshot;
use crate::failures::{failures, not_well_formed};
use urdd_directory::cancellation::Cancellation;
use urdd_format::report::{Place, WrittenAt};
use urdd_generate::read_source;
use urdd_lint::lint_text;
use urdd_validate::engine::Check;
use urdd_validate::finding::Finding;

/// Whether the file is well-formed, and what is wrong with the expanded robot, if the user allows to expand it.
pub fn findings(snapshot: &Snapshot, cancellation: &Cancellation) -> Vec<Found> {
    if let Some(found) = not_well_formed(snapshot) {
        return vec![found];
    }
    let path = snapshot.path.as_ref().filter(|_| snapshot.options.xacro);
    let Some(path) = path else {
        return Vec::new();
    };
    let settings = snapshot.options.lint_settings(cancellation);
    let read = match read_source(path, &settings.source) {
        Ok(read) => read,
        Err(error) => {
            let message = error.to_string();
            return vec![at_the_top(snapshot, DiagnosticSeverity::ERROR, &message)];
        }
    };
    let examined = lint_text(&read.text, &snapshot.name(), &read.folder, &settings);
    let mut examined = [examined];
    settings.report.apply(&mut examined);
    let [examined] = examined;
    let mut found = failures(snapshot, &examined);
    for check in &examined.checks {
        for finding in &check.findings {
            let places = std::iter::once(&finding.place).chain(&finding.more);
            found.extend(places.map(|place| of_place(snapshot, check, finding, place).into()));
        }
    }
    found
}

/// A finding at the place in the file that xacro made the element from, if that is known, or at the element of the same
/// name; else at the top, with the place in the expansion.
fn of_place(snapshot: &Snapshot, check: &Check, finding: &Finding, place: &Place) -> Diagnostic {
    let message = message(finding, place);
    let offset =
        written(snapshot, place.written_at.as_ref()).or_else(|| same_name(snapshot, place));
    let (offset, message) = match offset {
        Some(offset) => (offset, message),
        None => {
            let line = place.line.map_or(1, |line| line.get());
            let message = format!("{message} (line {line} of the expanded file)");
            (snapshot.text.content_start(), message)
        }
    };
    diagnostic(
        snapshot.text.range(marked(snapshot, offset)),
        severity(check.severity),
        check.rule.code.as_str(),
        &message,
        (place.expected.as_deref(), place.actual.as_deref()),
    )
}

fn written(snapshot: &Snapshot, at: Option<&WrittenAt>) -> Option<usize> {
    let at = at.filter(|at| at.file == snapshot.name())?;
    let as_u32 = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let column = at.column.map_or(1, |column| column.get());
    Some(
        snapshot
            .text
            .reported(as_u32(at.line?.get()), as_u32(column)),
    )
}

/// The element that a place's subject, such as ``link `base` ``, names.
fn same_name(snapshot: &Snapshot, place: &Place) -> Option<usize> {
    let subject = place.subject.as_deref()?;
    let mut parts = subject.split('`');
    let kind = parts.next()?.trim();
    let name = parts.next()?;
    let outline = snapshot.outline();
    let element = match kind {
        "link" => outline.link(name)?.element,
        "joint" => outline.joint(name)?.element,
        _ => return None,
    };
    Some(snapshot.markup().elements[element].tag.start)
}
