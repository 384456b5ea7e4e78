//! The report on many URDDs: a table of URDDs by family of rules, and the causes of the findings, in the order in which
//! to fix them.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write};

use super::programs;
use super::style::{
    BOLD, DIM, GREEN, MODEL_NOT_VERIFIED, RED, Style, YELLOW, not_verified, severity, unit,
};
use crate::code::Code;
use crate::run::file_in;
use urdd_format::escape::line as safe;
use urdd_format::readable::counted;
use urdd_format::report::{Consequence, Finding, Place, Report, Severity, Status, Urdd, Verdict};

/// The column of a family of rules in the table. Most families have their own.
pub fn column(family: &str) -> &str {
    match family {
        "JSN" | "YML" | "SCH" | "EXT" => "TXT",
        "CMP" => "URD",
        "CNF" | "LOP" => "KIN",
        "LRN" | "SPH" => "SHP",
        own => own,
    }
}

/// The columns of all rules, in the order of their codes.
pub fn columns() -> Vec<&'static str> {
    let mut seen = BTreeSet::new();
    let columns = Code::ALL.iter().map(|code| column(code.family()));
    columns.filter(|column| seen.insert(*column)).collect()
}

/// Maximum number of table rows, of causes of errors, and of causes of warnings and infos, without `--full`.
const ROWS: usize = 60;
const CAUSES: usize = 10;
const LESSER: usize = 5;
/// Maximum length of a URDD's name, in characters; in the table, it may fill a row of this length.
const NAME: usize = 28;
const ROW: usize = 80;

pub(super) fn write(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    write_table(report, style, out)?;
    let all = causes(report);
    let unit = unit(report);
    let (errors, lesser): (Vec<_>, Vec<_>) =
        all.iter().partition(|cause| cause.first.severity == Severity::Error);
    if !errors.is_empty() {
        let title = format!("What to fix first ({} of errors)", counted(errors.len(), "cause"));
        writeln!(out, "{}", style.paint(BOLD, title))?;
        let mut above = None;
        write_some(&errors, CAUSES, style, out, |cause, out| {
            let consequence = cause.first.consequence;
            if above.replace(consequence) != Some(consequence) {
                writeln!(out, "  {}", words(consequence))?;
            }
            write_cause(cause, unit, style, out)
        })?;
    }
    if !lesser.is_empty() {
        writeln!(out, "{}", style.paint(BOLD, "Warnings, and worth knowing"))?;
        write_some(&lesser, LESSER, style, out, |cause, out| write_cause(cause, unit, style, out))?;
    }
    write_not_checked(report, style, out)?;
    write_programs(report, style, out)?;
    if !style.full {
        let hint = format!("In full: one {unit}, or --full; every place: --format json.");
        writeln!(out, "{}", style.paint(DIM, hint))?;
    }
    Ok(())
}

/// How many URDFs each program loads.
fn write_programs(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    let counts = programs::counts(report);
    if counts.is_empty() {
        return Ok(());
    }
    let words = ["load", "otherwise than written", "refused"];
    writeln!(out, "{}", style.paint(BOLD, "What programs do"))?;
    let widest = counts.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    for (name, counts) in counts {
        let some = counts.into_iter().zip(words).filter(|(count, _)| *count > 0);
        let some: Vec<String> = some.map(|(count, word)| format!("{count} {word}")).collect();
        let why = programs::unsaid(report, name);
        let why = why.map(|(why, count)| format!("; {count}: {}", safe(why))).unwrap_or_default();
        let line = format!("  {name:widest$}  {}{why}", some.join(", "));
        writeln!(out, "{}", shorten(&line, style.width))?;
    }
    writeln!(out)
}

/// Writes items, without `--full` no more than `most` and the number of others, and an empty line.
fn write_some<T, W: Write>(
    items: &[T],
    most: usize,
    style: Style,
    out: &mut W,
    mut write: impl FnMut(&T, &mut W) -> fmt::Result,
) -> fmt::Result {
    let most = if style.full { items.len() } else { most };
    for item in items.iter().take(most) {
        write(item, out)?;
    }
    write_more(items.len(), most, style, out)?;
    writeln!(out)
}

fn write_more(of: usize, shown: usize, style: Style, out: &mut impl Write) -> fmt::Result {
    if of <= shown {
        return Ok(());
    }
    let text = format!("and {} more; --full lists them", of - shown);
    writeln!(out, "    {}", style.paint(DIM, text))
}

fn words(consequence: Consequence) -> &'static str {
    match consequence {
        Consequence::WrongMotion => "wrong motion",
        Consequence::WrongPlace => "wrong place",
        Consequence::MissingGeometry => "missing geometry",
        Consequence::Collisions => "missed or false collisions",
        Consequence::Format => "format",
        Consequence::Appearance => "appearance",
        Consequence::Looseness => "looseness",
    }
}

fn write_cause(cause: &Cause<'_>, unit: &str, style: Style, out: &mut impl Write) -> fmt::Result {
    let code = style.paint(BOLD, &cause.first.code);
    let word = severity(cause.first.severity, style);
    let times = match cause.times {
        1 => "once".to_owned(),
        times => format!("{times} times"),
    };
    let mut text = format!("{times} in {}", counted(cause.urdds.len(), unit));
    if cause.subjects > 1 && cause.subjects < cause.times {
        text += &format!(", at {} {}", cause.subjects, kinds(cause));
    }
    if cause.borrowed > 0 {
        let text_of = |count| counted(count, unit);
        text += &format!(", {} only by the parts that it names", text_of(cause.borrowed));
    }
    writeln!(out, "    {word} {code} {}: {text}", cause.first.name)?;
    let urdd = cause.urdds.first().map(|path| ending(&safe(path), NAME)).unwrap_or_default();
    let example = format!("      {urdd}: {}", safe(&cause.first.message));
    writeln!(out, "{}", style.paint(DIM, shorten(&example, style.width)))
}

fn kinds(cause: &Cause<'_>) -> &'static str {
    let subject = cause.first.subject.as_deref().unwrap_or_default();
    if subject.contains(", ") {
        "pairs of links"
    } else if subject.starts_with("joint") {
        "joints"
    } else if subject.starts_with("DOF") {
        "DOFs"
    } else {
        "links"
    }
}

/// Writes what could not be checked, by reason.
fn write_not_checked(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    let mut by_reason: BTreeMap<&str, (usize, BTreeSet<&str>)> = BTreeMap::new();
    for open in report.urdds.iter().flat_map(|urdd| &urdd.not_checked) {
        let (urdds, codes) = by_reason.entry(&open.reason).or_default();
        *urdds += 1;
        codes.extend(open.codes.iter().map(String::as_str));
    }
    let unverified = report.urdds.iter().map(|urdd| urdd.geometry_not_verified.len());
    let unverified: Vec<usize> = unverified.filter(|links| *links > 0).collect();
    let models = report.urdds.iter().filter(|urdd| urdd.model_not_verified.is_some()).count();
    if by_reason.is_empty() && unverified.is_empty() && models == 0 {
        return Ok(());
    }
    writeln!(out, "{}", style.paint(BOLD, "Not checked"))?;
    if !unverified.is_empty() {
        let urdds = counted(unverified.len(), unit(report));
        let text = not_verified(unverified.iter().sum());
        writeln!(out, "    {text}, in {urdds}")?;
    }
    if models > 0 {
        let urdds = counted(models, unit(report));
        writeln!(out, "    {}, in {urdds}", MODEL_NOT_VERIFIED)?;
    }
    let mut reasons: Vec<_> = by_reason.into_iter().collect();
    reasons.sort_by_key(|(_, (urdds, _))| Reverse(*urdds));
    write_some(&reasons, LESSER, style, out, |(reason, (urdds, codes)), out| {
        let rules = counted(codes.len(), "rule");
        let text = format!("    {rules} in {}: {}", counted(*urdds, unit(report)), safe(reason));
        writeln!(out, "{}", shorten(&text, style.width))
    })
}

/// A path, or its end: what tells robots of one folder or file apart is there.
pub fn ending(text: &str, longest: usize) -> String {
    let length = text.chars().count();
    if length <= longest {
        return text.to_owned();
    }
    let last = text.chars().skip(length - longest.saturating_sub(1));
    std::iter::once('…').chain(last).collect()
}

fn shorten(text: &str, longest: usize) -> String {
    if text.chars().nth(longest).is_none() {
        return text.to_owned();
    }
    text.chars().take(longest.saturating_sub(1)).chain(['…']).collect()
}

fn write_table(report: &Report, style: Style, out: &mut impl Write) -> fmt::Result {
    let mut columns = columns();
    let worth = |urdd: &&Urdd| {
        let unknown = |column: &&str| cell(urdd, column).0 == Cell::Unknown;
        !urdd.findings.is_empty() || urdd.verdict != Verdict::Pass || columns.iter().any(unknown)
    };
    let rows: Vec<&Urdd> = report.urdds.iter().filter(worth).collect();
    let clean = report.urdds.len() - rows.len();
    let most = if style.full { rows.len() } else { ROWS };
    columns.retain(|column| rows.iter().any(|urdd| cell(urdd, column).0 != Cell::Absent));
    if !rows.is_empty() {
        let shown = rows.iter().take(most);
        let longest = NAME.max(ROW.saturating_sub(5 * columns.len()));
        let names: Vec<String> = shown.map(|urdd| ending(&safe(&urdd.label()), longest)).collect();
        let lengths = names.iter().map(|name| name.chars().count());
        let width = lengths.max().unwrap_or(0).max(4);
        let titles: String = columns.iter().map(|title| format!(" {title:>4}")).collect();
        let heading = format!("{:width$}{titles}", unit(report));
        writeln!(out, "{}", style.paint(BOLD, heading))?;
        for (name, urdd) in names.iter().zip(&rows) {
            write!(out, "{name:width$}")?;
            for column in &columns {
                let (cell, text) = cell(urdd, column);
                let text = format!("{text:>4}");
                let text = match cell {
                    Cell::Error => style.paint(RED, text),
                    Cell::Lesser | Cell::Unknown => style.paint(YELLOW, text),
                    Cell::Sound => style.paint(GREEN, text),
                    Cell::Absent => style.paint(DIM, text),
                };
                write!(out, " {text}")?;
            }
            writeln!(out)?;
        }
        write_more(rows.len(), most, style, out)?;
        let key =
            "errors; 3w: warnings only; 3i: infos only; ok; ?: not checked; -: nothing to check";
        writeln!(out, "{}", style.paint(DIM, key))?;
    }
    if clean > 0 {
        let others = if rows.is_empty() { "" } else { " more" };
        let text = format!("{}{others} without findings", counted(clean, unit(report)));
        writeln!(out, "{}", style.paint(GREEN, text))?;
    }
    writeln!(out)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Cell {
    Error,
    Lesser,
    Unknown,
    Sound,
    Absent,
}

/// The result of a column's rules for a URDD.
fn cell(urdd: &Urdd, title: &str) -> (Cell, String) {
    let of_family = |code: &str| code.get(..3).map(column) == Some(title);
    let times = |severity: Severity| -> usize {
        let findings = urdd.findings.iter();
        let alike = findings.filter(|f| f.severity == severity && of_family(&f.code));
        alike.map(|finding| finding.count.get()).sum()
    };
    let open = || {
        let rules = urdd.not_checked.iter().flat_map(|open| &open.codes);
        let links = urdd.geometry_not_verified.iter();
        let model = urdd.model_not_verified.iter();
        let codes = rules.chain(links.flat_map(|link| &link.codes));
        let mut codes = codes.chain(model.flat_map(|model| &model.codes));
        codes.any(|code| of_family(code))
    };
    let statuses = || {
        let checks = urdd.checks.iter().filter(|check| of_family(&check.code));
        checks.map(|check| check.status)
    };
    let [errors, warnings, infos] = [Severity::Error, Severity::Warning, Severity::Info].map(times);
    if errors > 0 {
        (Cell::Error, short(errors))
    } else if open() {
        (Cell::Unknown, "?".to_owned())
    } else if warnings > 0 {
        (Cell::Lesser, short(warnings) + "w")
    } else if infos > 0 {
        (Cell::Lesser, short(infos) + "i")
    } else if statuses().any(|status| status != Status::Skipped) {
        (Cell::Sound, "ok".to_owned())
    } else {
        (Cell::Absent, "-".to_owned())
    }
}

fn short(number: usize) -> String {
    match number {
        0..1_000 => number.to_string(),
        1_000..1_000_000 => format!("{}k", number / 1_000),
        _ => format!("{}M", number / 1_000_000),
    }
}

/// A cause of findings.
pub struct Cause<'a> {
    /// Its first finding.
    pub first: &'a Finding,
    /// Number of occurrences. A place that several URDDs name, such as a file of a part that they share, counts once.
    pub times: usize,
    /// Number of links, joints or pairs of links with an occurrence; 0 if unknown.
    pub subjects: usize,
    /// Paths of the URDDs with an occurrence.
    pub urdds: Vec<&'a str>,
    /// Number of these URDDs whose occurrences are all in files of other URDDs.
    pub borrowed: usize,
}

/// The causes of all findings: by severity, then by consequence, then by number of URDDs, each in descending order.
/// Findings of one rule and one severity have one cause, regardless of module, link and URDD.
pub fn causes<'a>(report: &'a Report) -> Vec<Cause<'a>> {
    let roots: BTreeSet<&str> = report.urdds.iter().map(|urdd| urdd.path.as_str()).collect();
    let mut all: BTreeMap<(&str, Severity), Vec<(usize, &Finding)>> = BTreeMap::new();
    for (number, urdd) in report.urdds.iter().enumerate() {
        for finding in &urdd.findings {
            let key = (finding.code.as_str(), finding.severity);
            all.entry(key).or_default().push((number, finding));
        }
    }
    let cause = |found: Vec<(usize, &'a Finding)>| {
        let (mut places, mut subjects, mut cut) = (BTreeSet::new(), BTreeSet::new(), 0);
        // The URDDs, and whether an occurrence is in a file of its own.
        let mut urdds: BTreeMap<usize, bool> = BTreeMap::new();
        for (number, finding) in &found {
            let root = &report.urdds[*number].path;
            cut += finding.places_cut.get();
            let mut own = finding.places_cut.get() > 0;
            for place in &finding.places {
                let file = file_in(root, place.file.as_deref());
                own |= place.file.is_none() || within(&file, root) || !inside(&file, &roots);
                places.insert((file, place.pointer.as_deref()));
                subjects.insert((*number, subject(place)));
            }
            *urdds.entry(*number).or_default() |= own;
        }
        let are_known = subjects.iter().all(|(_, subject)| subject.is_some());
        Cause {
            first: found[0].1,
            times: places.len() + cut,
            subjects: if are_known { subjects.len() } else { 0 },
            borrowed: urdds.values().filter(|own| !**own).count(),
            urdds: urdds.keys().map(|number| report.urdds[*number].path.as_str()).collect(),
        }
    };
    let mut causes: Vec<Cause> = all.into_values().map(cause).collect();
    causes.sort_by_key(|cause| {
        let Finding { severity, consequence, .. } = cause.first;
        Reverse((*severity, *consequence, cause.urdds.len(), cause.times))
    });
    causes
}

/// The links or joints of a place, without piece numbers, in alphabetical order, so that the order within a pair does
/// not matter.
pub fn subject(place: &Place) -> Option<String> {
    let subject = place.subject.as_deref()?;
    let part = |part: &str| match part.find("` piece ") {
        Some(end) => part[..=end].to_owned(),
        None => part.to_owned(),
    };
    let mut parts: Vec<String> = subject.split(", ").map(part).collect();
    parts.sort();
    Some(parts.join(", "))
}

fn within(file: &str, root: &str) -> bool {
    file.strip_prefix(root).is_some_and(|rest| rest.starts_with('/'))
}

fn inside(file: &str, roots: &BTreeSet<&str>) -> bool {
    let parents = file.match_indices('/').map(|(end, _)| &file[..end]);
    parents.into_iter().any(|folder| roots.contains(folder))
}
