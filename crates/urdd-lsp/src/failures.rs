//! What keeps rules from running: a text that is not XML, a rule that crashed.

use lsp_types::DiagnosticSeverity;

use crate::diagnostics::{Found, at_the_top, diagnostic};
use crate::document::Snapshot;
use urdd_findings::check::Outcome;
use urdd_findings::examined::Examined;
use urdd_format::report::Verdict;

/// What kept rules from running to their end.
pub fn failures(snapshot: &Snapshot, examined: &Examined) -> Vec<Found> {
    let mut failures = Vec::new();
    if let (Verdict::Unreadable | Verdict::Incomplete, Some(reason)) =
        (examined.report.verdict, &examined.report.reason)
    {
        failures.push(at_the_top(snapshot, DiagnosticSeverity::ERROR, reason));
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
    let words = error.words(text);
    let message = format!("not well-formed XML: {words}");
    Some(diagnostic(range, DiagnosticSeverity::ERROR, "", &message, (None, None)).into())
}
