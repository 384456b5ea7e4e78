//! Groups the findings of many URDDs by cause: findings of one rule and one severity have one cause, regardless of
//! module, link and URDD.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use super::place::file_in;
use urdd_format::report::{Finding, Place, Report, Severity};

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

struct Gathered<'a> {
    first: &'a Finding,
    places: BTreeSet<(String, Option<&'a str>)>,
    without_place: usize,
    subjects: BTreeSet<(usize, Option<String>)>,
    /// The URDDs, and whether an occurrence is in a file of its own.
    urdds: BTreeMap<usize, bool>,
}

/// The causes of all findings: by severity, then by consequence, then by number of URDDs, each in descending order.
pub fn causes<'a>(report: &'a Report) -> Vec<Cause<'a>> {
    let roots: BTreeSet<&str> = report.urdds.iter().map(|urdd| urdd.path.as_str()).collect();
    let mut all: BTreeMap<(&str, Severity), Gathered> = BTreeMap::new();
    for (number, urdd) in report.urdds.iter().enumerate() {
        for finding in &urdd.findings {
            let key = (finding.code.as_str(), finding.severity);
            let cause = all.entry(key).or_insert_with(|| Gathered {
                first: finding,
                places: BTreeSet::new(),
                without_place: 0,
                subjects: BTreeSet::new(),
                urdds: BTreeMap::new(),
            });
            cause.without_place += finding.places_cut.get();
            let mut own = finding.places_cut.get() > 0;
            for place in &finding.places {
                let file = file_in(&urdd.path, place.file.as_deref());
                own |= place.file.is_none() || within(&file, &urdd.path) || !inside(&file, &roots);
                cause.places.insert((file, place.pointer.as_deref()));
                cause.subjects.insert((number, subject(place)));
            }
            *cause.urdds.entry(number).or_default() |= own;
        }
    }
    let cause = |cause: Gathered<'a>| {
        let are_known = cause.subjects.iter().all(|(_, subject)| subject.is_some());
        Cause {
            first: cause.first,
            times: cause.places.len() + cause.without_place,
            subjects: if are_known { cause.subjects.len() } else { 0 },
            borrowed: cause.urdds.values().filter(|own| !**own).count(),
            urdds: cause.urdds.keys().map(|number| report.urdds[*number].path.as_str()).collect(),
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
