//! Findings about what xacro makes of a file, shown in the file.

use std::fs;

use lsp_types::{
    Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, Location, Position, Range,
};

use crate::diagnostics::{Found, at_the_top, diagnostic, marked, message, severity};
use crate::document::Snapshot;
use crate::failures::{failures, not_well_formed};
use crate::includes::{missing, that_includes};
use crate::project::Project;
use crate::uri;
use urdd_format::index::Count;
use urdd_format::report::{Place, WrittenAt};
use urdd_generate::read_source;
use urdd_lint::lint_source;
use urdd_validate::engine::Check;
use urdd_validate::finding::Finding;

/// What is wrong with the text as it is.
pub fn of_text(snapshot: &Snapshot) -> Vec<Found> {
    match not_well_formed(snapshot) {
        Some(found) => vec![found],
        None => missing(snapshot),
    }
}

/// What is wrong with the text, and with the robot that xacro makes of the file, if the user allows to expand it.
pub fn of_files(snapshot: &Snapshot, project: &Project) -> Vec<Found> {
    if let Some(found) = not_well_formed(snapshot) {
        return vec![found];
    }
    let mut found = missing(snapshot);
    let path = snapshot.path.as_ref().filter(|_| snapshot.options.xacro);
    let Some(path) = path.filter(|_| !is_part(snapshot)) else {
        return found;
    };
    let read = match read_source(path, &project.settings.source) {
        Ok(read) => read,
        Err(error) => {
            let message = error.to_string();
            found.push(at_the_top(snapshot, DiagnosticSeverity::ERROR, &message));
            return found;
        }
    };
    // Macros alone make no robot.
    if !read.text.contains("<link") {
        return found;
    }
    let examined = lint_source(path, &read, &project.settings);
    let examined = project.apply(snapshot, examined);
    found.extend(failures(snapshot, &examined));
    for check in &examined.checks {
        for finding in &check.findings {
            let places = std::iter::once(&finding.place).chain(&finding.more);
            found.extend(places.map(|place| of_place(snapshot, check, finding, place).into()));
        }
    }
    found
}

/// Whether only other files make a robot of it: `<robot>` without a name.
fn is_part(snapshot: &Snapshot) -> bool {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    !markup.elements.is_empty() && markup.attribute(text, 0, "name").is_none()
}

/// A finding at the place in the file that xacro made the element from, or at the element that includes that place's file;
/// if that is not known, at the element of the same name; else at the top, with the place in the expansion.
fn of_place(snapshot: &Snapshot, check: &Check, finding: &Finding, place: &Place) -> Diagnostic {
    let mut message = message(finding, place);
    let mut related = None;
    let offset = match place
        .written_at
        .as_ref()
        .map(|at| Written::new(snapshot, at))
    {
        Some(Written::Here(offset)) => offset,
        Some(Written::There {
            location,
            words,
            offset,
        }) => {
            message += &format!(" ({words})");
            related = location.map(|location| DiagnosticRelatedInformation {
                location,
                message: words,
            });
            offset
        }
        None => same_name(snapshot, place).unwrap_or_else(|| {
            let line = place.line.map_or(1, |line| line.get());
            message += &format!(" (line {line} of the expanded file)");
            snapshot.text.content_start()
        }),
    };
    let mut found = diagnostic(
        snapshot.text.range(marked(snapshot, offset)),
        severity(check.severity),
        check.rule.code.as_str(),
        &message,
        (place.expected.as_deref(), place.actual.as_deref()),
    );
    found.related_information = related.map(|one| vec![one]);
    found
}

/// Where an element is written.
enum Written {
    /// In the document, at a byte offset.
    Here(usize),
    /// In a file that the element at `offset` includes.
    There {
        location: Option<Location>,
        words: String,
        offset: usize,
    },
}

impl Written {
    fn new(snapshot: &Snapshot, at: &WrittenAt) -> Self {
        let count = |number: Option<Count>| {
            let number = number.map_or(1, |number| number.get());
            u32::try_from(number).unwrap_or(u32::MAX)
        };
        let (line, column) = (count(at.line), count(at.column));
        let file = fs::canonicalize(snapshot.folder.join(&at.file)).unwrap_or_default();
        let own = snapshot
            .path
            .as_ref()
            .and_then(|path| fs::canonicalize(path).ok());
        if own.is_some_and(|own| own == file) {
            return Written::Here(snapshot.text.reported(line, column));
        }
        let in_macro = at.macro_name.as_ref();
        let in_macro = in_macro.map_or_else(String::new, |name| format!(", in the macro `{name}`"));
        // Its columns cannot be counted without its text: the line is enough.
        let start = Position::new(line.saturating_sub(1), 0);
        Written::There {
            location: uri::of_path(&file).map(|uri| Location::new(uri, Range::new(start, start))),
            words: format!("written at {}:{line}{in_macro}", at.file),
            offset: that_includes(snapshot, &file).unwrap_or_else(|| snapshot.text.content_start()),
        }
    }
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
