//! Groups the findings of many URDDs by cause: findings of one rule with the same meaning have one cause, regardless of
//! module, link and URDD.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use super::place::file_in;
use urdd_format::report::{Finding, Place, Report, Severity};

/// A cause of findings.
pub(super) struct Cause<'a> {
    /// Its first finding.
    pub first: &'a Finding,
    /// Severity of its worst finding.
    pub severity: Severity,
    /// Number of occurrences. A place that several URDDs name, such as a file of a part that they share, counts once.
    pub times: usize,
    /// Number of links, joints or pairs of links with an occurrence; 0 if unknown.
    pub subjects: usize,
    /// Paths of the URDDs with an occurrence.
    pub urdds: Vec<&'a str>,
    /// Number of these URDDs whose occurrences are all in files of other URDDs.
    pub borrowed: usize,
}

#[derive(Default)]
struct Gathered<'a> {
    first: Option<&'a Finding>,
    severity: Option<Severity>,
    places: BTreeSet<(String, Option<&'a str>)>,
    without_place: usize,
    subjects: BTreeSet<(usize, String)>,
    subjects_known: bool,
    urdds: BTreeMap<usize, bool>,
}

/// The causes of all findings: by severity, then by consequence, then by number of URDDs, each in descending order.
pub(super) fn causes(report: &Report) -> Vec<Cause<'_>> {
    let roots: BTreeSet<&str> = report.urdds.iter().map(|urdd| urdd.path.as_str()).collect();
    let mut all: BTreeMap<(&str, String), Gathered> = BTreeMap::new();
    for (number, urdd) in report.urdds.iter().enumerate() {
        for finding in &urdd.findings {
            let key = (finding.code.as_str(), meaning(&finding.message));
            let cause = all
                .entry(key)
                .or_insert_with(|| Gathered { subjects_known: true, ..Gathered::default() });
            cause.first.get_or_insert(finding);
            cause.severity = cause.severity.max(Some(finding.severity));
            cause.without_place += finding.places_cut.get();
            let mut own = finding.places_cut.get() > 0;
            for place in &finding.places {
                let file = file_in(&urdd.path, place.file.as_deref());
                own |= place.file.is_none() || within(&file, &urdd.path) || !inside(&file, &roots);
                cause.places.insert((file, place.pointer.as_deref()));
                match subject(place) {
                    Some(subject) => {
                        cause.subjects.insert((number, subject));
                    }
                    None => cause.subjects_known = false,
                }
            }
            *cause.urdds.entry(number).or_default() |= own;
        }
    }
    let mut causes: Vec<Cause> = all
        .into_values()
        .filter_map(|cause| {
            let named = |number: &usize| report.urdds[*number].path.as_str();
            Some(Cause {
                first: cause.first?,
                severity: cause.severity?,
                times: cause.places.len() + cause.without_place,
                subjects: match cause.subjects_known {
                    true => cause.subjects.len(),
                    false => 0,
                },
                borrowed: cause.urdds.values().filter(|own| !**own).count(),
                urdds: cause.urdds.keys().map(named).collect(),
            })
        })
        .collect();
    causes.sort_by_key(|cause| {
        (
            Reverse(cause.severity),
            Reverse(cause.first.consequence),
            Reverse(cause.urdds.len()),
            Reverse(cause.times),
        )
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

/// The meaning of a message: the message without names, numbers, pointers and parentheses, with pieces and hulls of a
/// link replaced by the link.
pub fn meaning(message: &str) -> String {
    let mut depth = 0_usize;
    let outside = |c: &char| {
        match c {
            '(' => depth += 1,
            ')' if depth > 0 => {
                depth -= 1;
                return false;
            }
            _ => {}
        }
        depth == 0
    };
    let text: String = without_particulars(message).chars().filter(outside).collect();
    let words = text.split_whitespace();
    let words: Vec<&str> = words.filter(|word| !word.starts_with('/')).collect();
    let text = words.join(" ");
    text.replace("piece # of link", "link").replace("the hull of link", "link")
}

/// Removes names (in backticks or quotes) and numbers from a message.
pub fn without_particulars(message: &str) -> String {
    let mut out = String::new();
    let mut chars = message.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '`' | '"' => {
                out.push(c);
                chars.by_ref().find(|other| *other == c);
            }
            '-' if chars.peek().is_some_and(char::is_ascii_digit) => {}
            c if c.is_ascii_digit() => {
                out.push('#');
                let number = |c: &char| c.is_ascii_digit() || matches!(c, '.' | 'e' | '-' | '+');
                while chars.next_if(number).is_some() {}
            }
            c => out.push(c),
        }
    }
    out
}
