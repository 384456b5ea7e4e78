//! A summary as Markdown, for the page of a run of GitHub Actions: a row a URDF or URDD, with a column a program. All text of
//! files is in code spans.

use std::fmt::{self, Write};

use super::programs::cell;
use super::words::{plural, unit};
use urdd_format::escape;
use urdd_format::report::{Report, Severity, Urdd, Verdict};

/// Maximum number of rows: GitHub takes 1 MiB.
const ROWS: usize = 500;

/// Writes the summary.
///
/// # Errors
/// If writing fails.
pub fn markdown(report: &Report, out: &mut impl Write) -> fmt::Result {
    let totals = &report.totals;
    writeln!(
        out,
        "### `urdd`: {}, {} failed\n\n{}, {}, {}.\n",
        plural(totals.urdds.get(), unit(report)),
        report.urdds.iter().filter(|urdd| urdd.verdict != Verdict::Pass).count(),
        plural(totals.error.get(), "error"),
        plural(totals.warning.get(), "warning"),
        plural(totals.info.get(), "info"),
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
        writeln!(out, "\n{} more are left out here.", plural(more, unit(report)))?;
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
    match [Severity::Error, Severity::Warning].map(count) {
        _ if urdd.verdict == Verdict::Unreadable => "unreadable".to_owned(),
        [0, 0] => String::new(),
        [0, warnings] => plural(warnings, "warning"),
        [errors, 0] => plural(errors, "error"),
        [errors, warnings] => {
            format!("{}, {}", plural(errors, "error"), plural(warnings, "warning"))
        }
    }
}
