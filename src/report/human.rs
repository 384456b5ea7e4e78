//! The report for a person: by URDD, then by module; what is wrong, where, and what to do.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use crate::format::index::Count;

use super::model::{Finding, Report, Severity, Status, Urdd, Verdict};

/// How the human report looks.
#[derive(Debug, Clone, Copy, Default)]
pub struct Style {
    /// With colours, for a terminal.
    pub color: bool,
    /// Only what has findings, and the summary.
    pub quiet: bool,
}

const BOLD: &str = "\x1b[1m";
const DIM: &str = "\x1b[2m";
const RED: &str = "\x1b[31m";
const GREEN: &str = "\x1b[32m";
const YELLOW: &str = "\x1b[33m";
const BLUE: &str = "\x1b[34m";

impl Style {
    fn paint(self, code: &str, text: impl fmt::Display) -> String {
        if self.color {
            format!("{code}{text}\x1b[0m")
        } else {
            text.to_string()
        }
    }
}

/// Writes the report.
///
/// # Errors
/// Where writing fails.
pub fn write(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    for urdd in &report.urdds {
        if !(style.quiet && urdd.verdict == Verdict::Pass && urdd.findings.is_empty()) {
            write_urdd(urdd, style, out)?;
        }
    }
    for ignore in &report.stale_ignores {
        writeln!(
            out,
            "{} the ignore of {} at `{}` in the settings matches nothing: take it out, or mend its path",
            style.paint(YELLOW, "note:"),
            ignore.code,
            ignore.path
        )?;
    }
    write_summary(report, style, out)
}

fn write_urdd(urdd: &Urdd, style: Style, out: &mut impl Write) -> fmt::Result {
    let verdict = match urdd.verdict {
        Verdict::Pass => style.paint(GREEN, "pass"),
        Verdict::Fail => style.paint(RED, "FAIL"),
        Verdict::Unreadable => style.paint(RED, "UNREADABLE"),
        Verdict::Incomplete => style.paint(RED, "INCOMPLETE"),
    };
    writeln!(
        out,
        "{} {verdict}  {}",
        style.paint(BOLD, &urdd.path),
        style.paint(DIM, describe(urdd))
    )?;
    if let Some(reason) = &urdd.reason {
        writeln!(out, "  the folder cannot be read: {reason}")?;
    }
    let mut above = None;
    for finding in &urdd.findings {
        let title = match (&finding.module, &finding.file) {
            (Some(module), _) => module.as_str(),
            (None, Some(file)) if file.ends_with(".urdf") => "the URDF",
            _ => "the directory",
        };
        if above != Some(title) {
            above = Some(title);
            writeln!(out, "  {}", style.paint(BOLD, title))?;
        }
        write_finding(finding, style, out)?;
    }
    for check in urdd
        .checks
        .iter()
        .filter(|check| check.status == Status::Crashed)
    {
        writeln!(
            out,
            "  {} {} ran into a fault of its own and checked nothing: {}. Please report this.",
            style.paint(RED, "crash"),
            check.code,
            check.reason.as_deref().unwrap_or_default()
        )?;
    }
    write_skipped(urdd, style, out)?;
    writeln!(out)
}

/// The robot's name and size, and the formats of its modules.
fn describe(urdd: &Urdd) -> String {
    let mut parts = Vec::new();
    if let Some(name) = &urdd.name {
        parts.push(format!("robot {name:?}"));
    }
    let sizes = [
        (urdd.size.links, "link"),
        (urdd.size.joints, "joint"),
        (urdd.size.dofs, "DOF"),
    ];
    parts.extend(
        sizes
            .into_iter()
            .filter_map(|(size, unit)| Some(plural(size?.get(), unit))),
    );
    let legacy = urdd
        .modules
        .iter()
        .any(|module| module.profile.as_deref() == Some("legacy"));
    if !urdd.modules.is_empty() {
        let family = if legacy { " (legacy)" } else { "" };
        parts.push(format!("{}{family}", plural(urdd.modules.len(), "module")));
    }
    parts.join(", ")
}

/// Writes one finding.
pub(super) fn write_finding(finding: &Finding, style: Style, out: &mut impl Write) -> fmt::Result {
    let (color, word) = match finding.severity {
        Severity::Error => (RED, "error"),
        Severity::Warning => (YELLOW, "warning"),
        Severity::Info => (BLUE, "info"),
    };
    let times = if finding.count.get() > 1 {
        format!(" ({} times)", finding.count)
    } else {
        String::new()
    };
    let code = style.paint(BOLD, &finding.code);
    writeln!(
        out,
        "    {} {code} {}{times}",
        style.paint(color, word),
        finding.name
    )?;
    let place = place(
        finding.file.as_deref(),
        finding.pointer.as_deref(),
        finding.line,
        finding.column,
    );
    if !place.is_empty() {
        writeln!(out, "      {} {place}", style.paint(DIM, "at"))?;
    }
    writeln!(out, "      {}", finding.message)?;
    if let Some(expected) = &finding.expected {
        writeln!(out, "      {} {expected}", style.paint(DIM, "expected:"))?;
    }
    if let Some(actual) = &finding.actual {
        writeln!(out, "      {}    {actual}", style.paint(DIM, "found:"))?;
    }
    if let Some(tolerance) = finding.tolerance {
        writeln!(
            out,
            "      {} {tolerance:.1e}",
            style.paint(DIM, "tolerance:")
        )?;
    }
    let shown = 1 + finding.more.len();
    for other in &finding.more {
        let file = if other.file == finding.file {
            None
        } else {
            other.file.as_deref()
        };
        let place = self::place(file, other.pointer.as_deref(), other.line, other.column);
        let found = other
            .actual
            .as_ref()
            .map(|actual| format!(": {actual}"))
            .unwrap_or_default();
        writeln!(out, "      {} {place}{found}", style.paint(DIM, "also"))?;
    }
    if finding.count.get() > shown {
        writeln!(
            out,
            "      {}",
            style.paint(DIM, format!("and {} more", finding.count.get() - shown))
        )?;
    }
    Ok(())
}

fn place(
    file: Option<&str>,
    pointer: Option<&str>,
    line: Option<Count>,
    column: Option<Count>,
) -> String {
    let mut place = file.unwrap_or_default().to_owned();
    if let (Some(line), Some(column)) = (line, column) {
        let colon = if place.is_empty() { "" } else { ":" };
        place.push_str(&format!("{colon}{line}:{column}"));
    }
    if let Some(pointer) = pointer.filter(|pointer| !pointer.is_empty()) {
        let space = if place.is_empty() { "" } else { " " };
        place.push_str(&format!("{space}{pointer}"));
    }
    place
}

/// What was not checked, by reason. Rules that are for another kind of URDD are not worth a word,
/// and those about modules that are not here no more than one line.
fn write_skipped(urdd: &Urdd, style: Style, out: &mut impl Write) -> fmt::Result {
    let mut by_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut about_absent_modules = 0;
    for check in urdd
        .checks
        .iter()
        .filter(|check| check.status == Status::Skipped)
    {
        let reason = check.reason.as_deref().unwrap_or_default();
        if reason.starts_with("there is no ") && reason.ends_with("_module") {
            about_absent_modules += 1;
        } else if !reason.ends_with("a legacy URDD") {
            by_reason.entry(reason).or_default().push(&check.code);
        }
    }
    let label = style.paint(DIM, "not checked:");
    for (reason, codes) in by_reason {
        writeln!(out, "  {label} {}: {reason}", list(&codes))?;
    }
    if about_absent_modules > 0 {
        let rules = plural(about_absent_modules, "rule");
        writeln!(out, "  {label} {rules} about modules that are not here")?;
    }
    Ok(())
}

/// Codes, or where they are many, how many of which families.
fn list(codes: &[&str]) -> String {
    const MOST: usize = 8;
    if codes.len() <= MOST {
        return codes.join(" ");
    }
    let mut families: Vec<&str> = codes
        .iter()
        .map(|code| &code[..code.len().min(3)])
        .collect();
    families.sort_unstable();
    families.dedup();
    format!("{} ({})", plural(codes.len(), "rule"), families.join(", "))
}

fn write_summary(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    let totals = &report.totals;
    let verdicts = [
        (report.count(Verdict::Pass), "passed"),
        (report.count(Verdict::Fail), "failed"),
        (report.count(Verdict::Unreadable), "unreadable"),
        (report.count(Verdict::Incomplete), "incomplete"),
    ];
    let verdicts: Vec<String> = verdicts
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, word)| format!("{count} {word}"))
        .collect();
    writeln!(
        out,
        "{}: {}. {}: {}, {}, {}.",
        style.paint(BOLD, plural(totals.urdds.get(), "URDD")),
        verdicts.join(", "),
        plural(
            totals.error.get() + totals.warning.get() + totals.info.get(),
            "finding"
        ),
        plural(totals.error.get(), "error"),
        plural(totals.warning.get(), "warning"),
        plural(totals.info.get(), "info"),
    )?;
    let findings = report.urdds.iter().flat_map(|urdd| &urdd.findings);
    if let Some(worst) = findings.min_by_key(|finding| finding.severity) {
        let hint = format!("`urdd explain {}` says more about a rule.", worst.code);
        writeln!(out, "{}", style.paint(DIM, hint))?;
    }
    Ok(())
}

fn plural(count: usize, unit: &str) -> String {
    format!("{count} {unit}{}", if count == 1 { "" } else { "s" })
}
