//! The report as workflow commands of GitHub Actions: one line per finding, which Actions shows at the file in the pull
//! request, which needs no upload and no permissions; and a summary for the page of the run.

use std::fmt::{self, Write};

use super::human::{self, times};
use super::programs::cell;
use super::style::unit;
use super::unexamined::{NOT_EXAMINED, place_in, unexamined};
use super::variants::Variants;
use crate::run::{file_in, is_inside};
use urdd_format::escape;
use urdd_format::index::Count;
use urdd_format::readable::counted;
use urdd_format::report::{Place, Report, Severity, Status, Urdd};

/// Writes the report. `places` are the folders of its URDDs (see [`super::place::places`]).
///
/// # Errors
/// If writing fails.
pub fn github(report: &Report, places: &[String], out: &mut impl Write) -> fmt::Result {
    let variants = Variants::by_first_place(report, places);
    for (number, (urdd, place)) in report.urdds.iter().zip(places).enumerate() {
        if let Some(why) = unexamined(urdd) {
            let command = if why.is_asked_for { "error" } else { "warning" };
            write_place(command, place, &place_in(urdd, place, why), out)?;
            let mut text = why.reason.clone();
            for argument in &urdd.xacro_arguments {
                text += &format!("; with {argument}");
            }
            writeln!(out, ",title={NOT_EXAMINED}::{}", data(&text))?;
        }
        for check in urdd.checks.iter().filter(|check| check.status == Status::Crashed) {
            let reason = data(check.reason.as_deref().unwrap_or_default());
            writeln!(out, "::error title={} crashed::{reason}", check.code)?;
        }
        for (own, finding) in urdd.findings.iter().enumerate() {
            if variants.is_repeated(number, own) {
                continue;
            }
            let command = match finding.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Info => "notice",
            };
            let at = Place {
                file: finding.file.clone(),
                line: finding.line,
                column: finding.column,
                ..Place::default()
            };
            write_place(command, place, &at, out)?;
            let is_inside = is_inside(place, finding.file.as_deref());
            let mut text = finding.message.clone();
            let first = finding.places.first();
            let parts = [
                ("at", &first.filter(|_| !is_inside).map(|first| human::place(first, true))),
                ("macro", &first.and_then(human::macro_of).map(str::to_owned)),
                ("trail", &first.filter(|_| is_inside).and_then(human::trail_of)),
                ("of", &finding.subject),
                ("expected", &finding.expected),
                ("found", &finding.actual),
            ];
            for (label, part) in parts {
                if let Some(part) = part {
                    text += &format!("; {label}: {part}");
                }
            }
            match variants.words(number, own) {
                Some(words) => text += &format!("; in {words}"),
                None => urdd
                    .xacro_arguments
                    .iter()
                    .for_each(|argument| text += &format!("; with {argument}")),
            }
            text += &times(finding);
            let title = property(&format!("{} {}", finding.code, finding.name));
            writeln!(out, ",title={title}::{}", data(&text))?;
        }
    }
    Ok(())
}

/// Begins a command about a place in the folder of a URDD or URDF.
fn write_place(command: &str, folder: &str, place: &Place, out: &mut impl Write) -> fmt::Result {
    let file = place.file.as_deref();
    write!(out, "::{command} file={}", property(&file_in(folder, file)))?;
    let shown = |number: Option<Count>| number.filter(|_| is_inside(folder, file));
    if let Some(line) = shown(place.line) {
        write!(out, ",line={line}")?;
    }
    shown(place.column).map_or(Ok(()), |column| write!(out, ",col={column}"))
}

fn data(text: &str) -> String {
    // Line breaks are already escaped. A percent sign starts an escape sequence of Actions.
    escape::line(text).replace('%', "%25")
}

fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

/// Maximum number of rows: GitHub takes 1 MiB.
const ROWS: usize = 500;

/// Writes a summary as Markdown, for the page of a run: a row a URDF or URDD, with a column a program. All text of files is
/// in code spans.
///
/// # Errors
/// If writing fails.
pub fn markdown(report: &Report, out: &mut impl Write) -> fmt::Result {
    let totals = &report.totals;
    writeln!(
        out,
        "### `urdd`: {}, {} failed{}\n\n{}, {}, {}.\n",
        counted(totals.urdds.get(), unit(report)),
        totals.failed,
        match totals.not_examined.get() {
            0 => String::new(),
            count => format!(", {count} {NOT_EXAMINED}"),
        },
        counted(totals.error.get(), "error"),
        counted(totals.warning.get(), "warning"),
        counted(totals.info.get(), "info"),
    )?;
    let asked = report.urdds.iter().map(|urdd| &urdd.programs).find(|all| !all.is_empty());
    let programs = || asked.into_iter().flatten();
    let mut head = vec![unit(report).to_owned(), "findings".to_owned()];
    head.extend(programs().map(|program| program.name.clone()));
    write_row(&head, out)?;
    write_row(&vec!["---".to_owned(); head.len()], out)?;
    for urdd in report.urdds.iter().take(ROWS) {
        let mut cells = vec![in_table(&urdd.label()), findings(urdd)];
        cells.extend(programs().map(|program| in_table_words(&cell(urdd, &program.program))));
        write_row(&cells, out)?;
    }
    let more = report.urdds.len().saturating_sub(ROWS);
    if more > 0 {
        writeln!(out, "\n{} more are left out here.", counted(more, unit(report)))?;
    }
    Ok(())
}

fn write_row(cells: &[String], out: &mut impl Write) -> fmt::Result {
    writeln!(out, "| {} |", cells.join(" | "))
}

/// Text of a file in a cell.
fn in_table(text: &str) -> String {
    escape::code_span(text).replace('|', "\\|")
}

/// What a program does, as a cell: its reasons quote the file.
fn in_table_words((mark, words): &(&str, String)) -> String {
    if words.is_empty() { (*mark).to_owned() } else { format!("{mark} {}", in_table(words)) }
}

fn findings(urdd: &Urdd) -> String {
    let count = |severity: Severity| -> usize {
        let alike = urdd.findings.iter().filter(|finding| finding.severity == severity);
        alike.map(|finding| finding.count.get()).sum()
    };
    if let Some(why) = &urdd.not_examined {
        return format!("{NOT_EXAMINED}: {}", in_table(&why.reason));
    }
    match [Severity::Error, Severity::Warning].map(count) {
        [0, 0] => String::new(),
        [0, warnings] => counted(warnings, "warning"),
        [errors, 0] => counted(errors, "error"),
        [errors, warnings] => {
            format!("{}, {}", counted(errors, "error"), counted(warnings, "warning"))
        }
    }
}
