//! The report for people: by URDD, then by module; what is wrong, where, and what to do. For many URDDs, only the
//! summary is written: see `summary`.
//!
//! Text from files is escaped here, field by field: see [`urdd_format::escape`].

use std::cmp::Reverse;
use std::fmt::{self, Write};
use std::path::Path;

use urdd_directory::file_type::FileType;
use urdd_format::escape::{self, line as safe};
use urdd_format::readable::{counted, number};
use urdd_format::registry::ModuleKind;

use super::style::{
    BOLD, DIM, GREEN, RED, Style, YELLOW, is_in_part, list, severity, unit, unverified,
};
use super::unexamined::{self, NOT_EXAMINED, unexamined};
use super::variants::Variants;
use super::{programs, summary};
use crate::part::SkipReason;
use crate::run::by_reason;
use urdd_format::report::{
    Cause, CheckStatus, Deed, Finding, ImportedFrom, Kind, MacroPlace, Magnitude, Place, Report,
    Skipped, Status, Urdd, Verdict,
};

/// Maximum number of URDDs that are shown one by one. More are summarized.
pub const FEW: usize = 3;

/// Writes the report.
///
/// # Errors
/// If writing fails.
pub fn write(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    let many = report.urdds.len() > FEW;
    let variants = Variants::new(report, None);
    for (robot, urdd) in report.urdds.iter().enumerate() {
        let open = urdd.not_examined.is_some() || urdd.verdict == Verdict::Incomplete;
        let silent = style.quiet && urdd.verdict == Verdict::Pass && urdd.findings.is_empty();
        if !silent && (!many || style.full || open) {
            write_urdd((&variants, robot), style, many && !style.full, out)?;
        }
    }
    if many {
        summary::write(report, style, out)?;
    }
    for ignore in &report.stale_ignores {
        let code = ignore.code.as_deref().unwrap_or("all rules");
        writeln!(
            out,
            "{} the ignore of {code} at `{}` matches nothing: remove it, or correct it",
            style.paint(YELLOW, "note:"),
            safe(&ignore.path)
        )?;
    }
    write_totals(report, style, out)
}

/// Writes one URDD; if `brief`, only why it was not fully examined.
fn write_urdd(
    (variants, robot): (&Variants<'_>, usize),
    style: Style,
    brief: bool,
    out: &mut impl Write,
) -> fmt::Result {
    let urdd = variants.robot(robot);
    let verdict = match (urdd.verdict, &urdd.not_examined) {
        (Verdict::Incomplete, _) => style.paint(RED, "INCOMPLETE"),
        (_, Some(why)) if !why.is_asked_for => style.paint(YELLOW, "not examined"),
        (Verdict::Unreadable, _) | (_, Some(_)) => style.paint(RED, "NOT EXAMINED"),
        (Verdict::Pass, None) if is_in_part(urdd) => style.paint(YELLOW, "pass in part"),
        (Verdict::Pass, None) => style.paint(GREEN, "pass"),
        (Verdict::Fail, None) => style.paint(RED, "FAIL"),
    };
    writeln!(
        out,
        "{} {verdict}  {}",
        style.paint(BOLD, safe(&urdd.label())),
        style.paint(DIM, describe(urdd))
    )?;
    if let Some(why) = unexamined(urdd) {
        if let Some(at) = unexamined::words(why) {
            writeln!(out, "  at {}", safe(&at))?;
        }
        let what = if why.cause == Cause::Unreadable { "it cannot be read: " } else { "" };
        writeln!(out, "  {what}{}", safe(&why.reason))?;
    }
    if !brief {
        write_findings((variants, robot), style, out)?;
    }
    let crashed = |check: &&CheckStatus| check.status == Status::Crashed;
    for check in urdd.checks.iter().filter(crashed) {
        writeln!(
            out,
            "  {} {} crashed and checked nothing: {}. Please report this.",
            style.paint(RED, "crash"),
            check.code,
            safe(check.reason.as_deref().unwrap_or_default())
        )?;
    }
    if !brief {
        write_skipped(urdd, style, out)?;
        if let Some(imported) = &urdd.imported {
            write_imported(imported, style, out)?;
        }
        write_programs(urdd, style, out)?;
        let is_read = urdd.not_examined.is_none();
        if style.suggests_lint && urdd.kind == Kind::Urdf && is_read {
            let hint =
                "this is a URDF: `urdd lint` finds more in it, `urdd generate` makes a URDD of it";
            writeln!(out, "  {}", style.paint(DIM, hint))?;
        }
    }
    writeln!(out)
}

fn write_findings(
    (variants, robot): (&Variants<'_>, usize),
    style: Style,
    out: &mut impl Write,
) -> fmt::Result {
    let (urdd, mut above) = (variants.robot(robot), None);
    let is_urdf = |file: &str| urdd.kind == Kind::Urdf || FileType::Urdf.is_of(Path::new(file));
    let all = urdd.findings.iter().enumerate();
    for (own, finding) in all.filter(|(own, _)| !variants.is_repeated(robot, *own)) {
        let title = match (&finding.module, &finding.file) {
            (Some(module), _) => module.as_str(),
            (None, Some(file)) if is_urdf(file) => "the URDF",
            _ => "the directory",
        };
        if above != Some(title) {
            above = Some(title);
            writeln!(out, "  {}", style.paint(BOLD, safe(title)))?;
        }
        write_finding(finding, style, out)?;
        if let Some(words) = variants.words(robot, own) {
            writeln!(out, "      {} {}", style.paint(DIM, "in"), safe(&words))?;
        }
    }
    if let Some((count, first)) = variants.repeats(robot) {
        let text = format!("{} as of {}", counted(count, "finding"), safe(&first.label()));
        writeln!(out, "  {}", style.paint(DIM, text))?;
    }
    Ok(())
}

/// The robot's name and size, and the number and family of its modules.
fn describe(urdd: &Urdd) -> String {
    let mut parts = Vec::new();
    if let Some(name) = &urdd.name {
        parts.push(format!("robot {}", escape::quoted(name)));
    }
    let sizes = [(urdd.size.links, "link"), (urdd.size.joints, "joint"), (urdd.size.dofs, "DOF")];
    parts.extend(sizes.into_iter().filter_map(|(size, unit)| Some(counted(size?.get(), unit))));
    let legacy = urdd.modules.iter().any(|module| module.profile.as_deref() == Some("legacy"));
    if !urdd.modules.is_empty() {
        let family = if legacy { " (legacy)" } else { "" };
        parts.push(format!("{}{family}", counted(urdd.modules.len(), "module")));
    }
    parts.join(", ")
}

pub(super) fn write_finding(finding: &Finding, style: Style, out: &mut impl Write) -> fmt::Result {
    let times = times(finding);
    let code = style.paint(BOLD, &finding.code);
    let word = severity(finding.severity, style);
    writeln!(out, "    {word} {code} {}{times}", finding.name)?;
    let mut places = finding.places.iter();
    let first = places.next();
    let at = first.map(|first| place(first, true)).unwrap_or_default();
    if !at.is_empty() {
        writeln!(out, "      {} {at}", style.paint(DIM, "at"))?;
    }
    writeln!(out, "      {}", safe(&finding.message))?;
    let mut line = |label: &str, text: &str| {
        let label = style.paint(DIM, format!("{label}:"));
        writeln!(out, "      {label} {}", safe(text))
    };
    if let Some(expected) = &finding.expected {
        line("expected", expected)?;
    }
    // Skips what the message already contains.
    const WORDS: usize = 8;
    let repeats = |actual: &&String| {
        let said = finding.message.contains(*actual);
        said && (finding.expected.is_none() || actual.len() > WORDS)
    };
    if let Some(actual) = finding.actual.as_ref().filter(|actual| !repeats(actual)) {
        line("found", &format!("   {actual}"))?;
    }
    if let (Some(magnitude), true) = (&finding.magnitude, is_bare(&finding.actual)) {
        line("off by", &format!("  {}", off_by(magnitude)))?;
    }
    if let Some(tolerance) = finding.tolerance {
        line("tolerance", &number(tolerance, 2))?;
    }
    let shown = style.max_places.max(1);
    for other in first.into_iter().flat_map(|first| &first.related) {
        let at = place(other, other.file != finding.file);
        let text = safe(other.message.as_deref().unwrap_or_default());
        writeln!(out, "      {} {at}: {text}", style.paint(DIM, "see"))?;
    }
    for other in places.take(shown - 1) {
        let at = place(other, other.file != finding.file);
        let mut text = format!("      {} {at}", style.paint(DIM, "also"));
        if let Some(actual) = &other.actual {
            text += &format!(": {}", safe(actual));
        }
        if let (Some(magnitude), true) = (&other.magnitude, is_bare(&other.actual)) {
            text += &format!(", off by {}", off_by(magnitude));
        }
        writeln!(out, "{text}")?;
    }
    let shown = shown.min(finding.places.len());
    if finding.count.get() > shown {
        let more = format!("and {} more", finding.count.get() - shown);
        writeln!(out, "      {}", style.paint(DIM, more))?;
    }
    Ok(())
}

/// How often a folded finding was found.
pub(super) fn times(finding: &Finding) -> String {
    if finding.count.get() > 1 { format!(" ({} times)", finding.count) } else { String::new() }
}

/// Whether the value found consists of numbers only, which do not show the difference.
fn is_bare(actual: &Option<String>) -> bool {
    let bare =
        |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | ',' | ' ' | '[' | ']');
    actual.as_ref().is_none_or(|actual| actual.chars().all(bare))
}

/// The difference of numbers, to four digits.
pub(super) fn off_by(magnitude: &Magnitude) -> String {
    let number = magnitude.value.map_or_else(|| "no number".to_owned(), |value| number(value, 4));
    match magnitude.unit.as_str() {
        "" => number,
        unit => format!("{number} {unit}"),
    }
}

/// File, line and column, pointer, subject, macro, and how xacro came there. Line and column are omitted within the first line of a file: in a file of
/// one line, the pointer and the subject are more useful.
pub(super) fn place(found: &Place, with_file: bool) -> String {
    let file = found.file.as_deref().filter(|_| with_file);
    let mut place = safe(file.unwrap_or_default()).into_owned();
    let pointer = found.pointer.as_deref().filter(|text| !text.is_empty());
    if let (Some(line), Some(column)) = (found.line, found.column)
        && (line.get() > 1 || column.get() == 1 || pointer.is_none())
    {
        let colon = if place.is_empty() { "" } else { ":" };
        place.push_str(&format!("{colon}{line}:{column}"));
    }
    let parts = [
        pointer.map(|pointer| safe(pointer).into_owned()),
        found.subject.as_ref().map(|subject| format!("({})", safe(subject))),
        macro_of(found).map(in_macro),
    ];
    for part in parts.into_iter().flatten() {
        let space = if place.is_empty() { "" } else { " " };
        place.push_str(&format!("{space}{part}"));
    }
    if let Some(trail) = trail_of(found) {
        place.push_str(&format!(", {trail}"));
    }
    place
}

/// The macro of a xacro file that holds a place.
pub(super) fn macro_of(found: &Place) -> Option<&str> {
    found.written_at.as_ref()?.macro_name.as_deref()
}

fn in_macro(name: &str) -> String {
    format!("in the macro {}", escape::quoted(name))
}

/// Maximum number of calls of macros that are named: that in the file that is expanded is the last.
const CALLS: usize = 3;

/// Where the value of a place is used, and by which calls of macros xacro came there.
pub(super) fn trail_of(found: &Place) -> Option<String> {
    let written = found.written_at.as_ref()?;
    let at = |place: &MacroPlace| format!("{}:{}:{}", safe(&place.file), place.line, place.column);
    let used_at = |place: &MacroPlace| {
        let macro_name = place.macro_name.as_deref().map(in_macro);
        format!("by {} {}", at(place), macro_name.unwrap_or_default()).trim_end().to_owned()
    };
    let mut parts: Vec<String> = written.used_at.iter().map(used_at).collect();
    let left_out = written.calls.len().saturating_sub(CALLS);
    for (number, call) in written.calls.iter().enumerate() {
        match number {
            _ if number < CALLS - 1 || number + 1 == written.calls.len() => {
                parts.push(format!("called at {}", at(call)));
            }
            _ if number == CALLS - 1 => parts.push(format!("by {left_out} other calls")),
            _ => {}
        }
    }
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// What was not checked, by reason. Rules for other formats are not mentioned, nor are rules about absent modules that
/// no class requires. Rules about other absent modules take one line.
fn write_skipped(urdd: &Urdd, style: Style, out: &mut impl Write) -> fmt::Result {
    let label = style.paint(DIM, "not checked:");
    for open in &urdd.not_checked {
        let reason = safe(&open.reason);
        writeln!(out, "  {label} {}: {reason}", list(&open.codes))?;
    }
    for text in unverified(urdd) {
        writeln!(out, "  {label} {text}")?;
    }
    for (reason, codes) in by_reason(&urdd.checks, Skipped::Ignored) {
        writeln!(out, "  {label} {}: {}", list(&codes), safe(reason))?;
    }
    let optional = ModuleKind::ALL.iter().filter(|kind| kind.is_optional());
    let normal: Vec<_> = optional.map(|kind| Some(SkipReason::absent(*kind).to_string())).collect();
    let absent = |check: &&CheckStatus| {
        check.skipped == Some(Skipped::Absent) && !normal.contains(&check.reason)
    };
    let absent = urdd.checks.iter().filter(absent).count();
    if absent > 0 {
        let rules = counted(absent, "rule");
        writeln!(out, "  {label} {rules} about modules that are not here")?;
    }
    Ok(())
}

/// What an import made of a description that is no URDF.
fn write_imported(imported: &ImportedFrom, style: Style, out: &mut impl Write) -> fmt::Result {
    let format = imported.format.to_uppercase();
    writeln!(out, "  {} {}", style.paint(DIM, "imported from"), safe(&format))?;
    for part in &imported.lost {
        writeln!(out, "    {} {} ({})", style.paint(YELLOW, "lost"), safe(&part.what), part.count)?;
    }
    for part in &imported.otherwise {
        let how = safe(part.how.as_deref().unwrap_or_default());
        writeln!(out, "    {} ({}): {how}", safe(&part.what), part.count)?;
    }
    for note in &imported.notes {
        writeln!(out, "    {}", safe(note))?;
    }
    Ok(())
}

/// What programs do with a URDF.
fn write_programs(urdd: &Urdd, style: Style, out: &mut impl Write) -> fmt::Result {
    let lines = programs::describe(urdd);
    let paint = |(does, text): &(Option<Deed>, String)| {
        let color = match does {
            Some(Deed::Refuses | Deed::Crashes) => RED,
            Some(Deed::Drops | Deed::Reads) => YELLOW,
            None => GREEN,
        };
        style.paint(color, safe(text))
    };
    let lines: Vec<String> = lines.iter().map(paint).collect();
    if lines.is_empty() { Ok(()) } else { writeln!(out, "  {}", lines.join(" · ")) }
}

fn write_totals(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    let totals = &report.totals;
    let parts = report.urdds.iter();
    let parts = parts.filter(|urdd| urdd.verdict == Verdict::Pass && is_in_part(urdd));
    let parts = match parts.count() {
        0 => String::new(),
        count => format!(" ({count} in part)"),
    };
    let passed = format!("passed{parts}");
    let failed = report.count(Verdict::Fail);
    let verdicts = [
        (totals.passed.get(), passed.as_str()),
        (failed, "failed"),
        (totals.failed.get() - failed, "incomplete"),
        (totals.not_examined.get(), NOT_EXAMINED),
    ];
    let some = verdicts.into_iter().filter(|(count, _)| *count > 0);
    let verdicts: Vec<String> = some.map(|(count, word)| format!("{count} {word}")).collect();
    writeln!(
        out,
        "{}: {}. {}: {}, {}, {}.",
        style.paint(BOLD, counted(totals.urdds.get(), unit(report))),
        verdicts.join(", "),
        counted(totals.error.get() + totals.warning.get() + totals.info.get(), "finding"),
        counted(totals.error.get(), "error"),
        counted(totals.warning.get(), "warning"),
        counted(totals.info.get(), "info"),
    )?;
    let findings = report.urdds.iter().flat_map(|urdd| &urdd.findings);
    if let Some(worst) = findings.min_by_key(|finding| Reverse(finding.severity)) {
        let hint = format!("`urdd explain {}` says more about a rule.", worst.code);
        writeln!(out, "{}", style.paint(DIM, hint))?;
    }
    Ok(())
}
