//! The report as workflow commands of GitHub Actions: one line per finding, which Actions shows at the file in the pull
//! request. Needs no upload and no permissions.

use std::fmt::{self, Write};

use super::human::{self, times};
use super::place::{file_in, is_inside};
use urdd_format::escape;
use urdd_format::report::{Report, Severity, Status};

/// Writes the report. `places` are the folders of its URDDs (see [`super::place::places`]).
///
/// # Errors
/// If writing fails.
pub fn github(report: &Report, places: &[String], out: &mut impl Write) -> fmt::Result {
    for (urdd, place) in report.urdds.iter().zip(places) {
        if let Some(reason) = &urdd.reason {
            let file = property(&file_in(place, None));
            let verdict = urdd.verdict.as_str();
            writeln!(out, "::error file={file},title={verdict}::{}", data(reason))?;
        }
        for check in urdd.checks.iter().filter(|check| check.status == Status::Crashed) {
            let reason = data(check.reason.as_deref().unwrap_or_default());
            writeln!(out, "::error title={} crashed::{reason}", check.code)?;
        }
        for finding in &urdd.findings {
            let command = match finding.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Info => "notice",
            };
            let file = property(&file_in(place, finding.file.as_deref()));
            write!(out, "::{command} file={file}")?;
            let is_inside = is_inside(place, finding.file.as_deref());
            if let Some(line) = finding.line.filter(|_| is_inside) {
                write!(out, ",line={line}")?;
            }
            if let Some(column) = finding.column.filter(|_| is_inside) {
                write!(out, ",col={column}")?;
            }
            let mut text = finding.message.clone();
            let first = finding.places.first();
            let parts = [
                ("at", &first.filter(|_| !is_inside).map(|first| human::place(first, true))),
                ("macro", &first.and_then(human::macro_of).map(str::to_owned)),
                ("of", &finding.subject),
                ("expected", &finding.expected),
                ("found", &finding.actual),
            ];
            for (label, part) in parts {
                if let Some(part) = part {
                    text += &format!("; {label}: {part}");
                }
            }
            for argument in &urdd.xacro_arguments {
                text += &format!("; with {argument}");
            }
            text += &times(finding);
            let title = property(&format!("{} {}", finding.code, finding.name));
            writeln!(out, ",title={title}::{}", data(&text))?;
        }
    }
    Ok(())
}

/// The text of a command.
fn data(text: &str) -> String {
    // Line breaks are already escaped. A percent sign starts an escape sequence of Actions.
    escape::line(text).replace('%', "%25")
}

/// A property of a command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
