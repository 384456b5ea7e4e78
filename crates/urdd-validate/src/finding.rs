//! Findings, and how many of the same are folded into one.

use std::collections::{HashMap, HashSet};

use super::part::{Part, Why};
use super::scope::{Faulted, Scope};
use super::skip::SkipReason;
use urdd_directory::position::Position;
use urdd_format::index::Count;
use urdd_format::report::Magnitude;

pub use urdd_format::report::Place;

/// How many places of a folded finding are kept; the rest is counted.
pub const KEPT_PLACES: usize = 10_000;
/// How many findings a rule keeps in one URDD, and how many bytes of further places of all of them;
/// the rest is counted.
const KEPT_FINDINGS: usize = 10_000;
const KEPT_BYTES: usize = 2 << 20;

/// Something that a rule found.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Where, and what is expected and found there.
    pub place: Place,
    /// What is wrong, and what to do, for a person.
    pub message: String,
    /// Where numbers were compared: the tolerance, in the unit of the numbers.
    pub tolerance: Option<f64>,
    /// The meshes that are at fault, where it is about meshes of single links. Those of findings that
    /// were folded into this one are not among them.
    pub parts: Vec<Part>,
    /// How many findings this one stands for.
    pub count: usize,
    /// The next few of these, after this one.
    pub more: Vec<Place>,
}

impl Finding {
    /// A finding about a value of a document.
    pub fn at(
        file: impl Into<String>,
        pointer: impl Into<String>,
        message: impl Into<String>,
    ) -> Self {
        let mut finding = Finding::in_file(file, message);
        finding.place.pointer = Some(pointer.into());
        finding
    }

    /// A finding about a file.
    pub fn in_file(file: impl Into<String>, message: impl Into<String>) -> Self {
        let mut finding = Finding::in_directory(message);
        finding.place.file = Some(file.into());
        finding
    }

    /// A finding about the directory as a whole.
    pub fn in_directory(message: impl Into<String>) -> Self {
        Finding {
            place: Place::default(),
            message: message.into(),
            tolerance: None,
            parts: Vec::new(),
            count: 1,
            more: Vec::new(),
        }
    }

    /// With the line and column of the place.
    pub fn position(mut self, position: Option<Position>) -> Self {
        self.place.line = position.map(|position| Count(position.line));
        self.place.column = position.map(|position| Count(position.column));
        self
    }

    /// With what should be there.
    pub fn expected(mut self, expected: impl ToString) -> Self {
        self.place.expected = Some(expected.to_string());
        self
    }

    /// With what is there.
    pub fn actual(mut self, actual: impl ToString) -> Self {
        self.place.actual = Some(actual.to_string());
        self
    }

    /// With the tolerance of the comparison.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    /// With how much the numbers differ, and their unit: of findings alike, the worst comes first.
    pub fn off_by(mut self, value: f64, unit: &'static str) -> Self {
        self.place.magnitude = Some(Magnitude {
            value: Some(value.abs()).filter(|value| value.is_finite()),
            unit: unit.to_owned(),
        });
        self
    }

    /// About a mesh of a link.
    pub fn part(mut self, part: impl Into<Option<Part>>) -> Self {
        self.parts.extend(part.into());
        self
    }

    /// Standing for several that were counted elsewhere.
    pub fn count(mut self, count: usize) -> Self {
        self.count = count;
        self
    }
}

/// A point for people, metres.
pub fn point([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4}, {y:.4}, {z:.4})")
}

/// What one rule found in one URDD. Findings at the same kind of place (the same file, and the
/// same pointer but for list indices) are folded into one with a count, so that a million of them
/// cost no more memory than a few.
#[derive(Debug, Default)]
pub struct Findings {
    findings: Vec<Finding>,
    by_place: HashMap<(Option<String>, String), usize>,
    reported: usize,
    kept: usize,
    skipped: Option<SkipReason>,
    spots: Option<HashSet<Spot>>,
    only: Option<HashSet<Spot>>,
    faulted: Faulted,
    scope: Scope,
}

/// What tells one finding of a rule from another: the file, and the pointer or else the message.
pub type Spot = (Option<String>, String);

impl Findings {
    /// Remembers the spot of every finding, folded or not.
    pub fn remembering_spots() -> Self {
        Findings {
            spots: Some(HashSet::new()),
            ..Findings::default()
        }
    }

    /// Judging the parts of a scope.
    pub fn within(mut self, scope: Scope) -> Self {
        self.scope = scope;
        self
    }

    /// Whether to judge a part, by itself or by others: not where a rule that this one needs found a
    /// fault in one of them ([`super::rule::Need::Each`]). What is not judged is noted as not
    /// verified.
    pub fn judges(&mut self, part: Part, by: &[Part]) -> bool {
        self.scope.judges(part, by)
    }

    /// Notes that a part was not verified.
    pub fn not_verified(&mut self, part: Part, why: Why) {
        self.scope.leave_out(part, why);
    }

    /// The parts that were and were not judged.
    pub fn scope(&self) -> &Scope {
        &self.scope
    }

    /// The parts that were found at fault.
    pub fn faulted(&self) -> &Faulted {
        &self.faulted
    }

    /// Takes findings at these spots, and drops others.
    pub fn only_at(spots: HashSet<Spot>) -> Self {
        Findings {
            only: Some(spots),
            ..Findings::default()
        }
    }

    /// Whether each finding counts by itself, so that none may be left unbuilt.
    pub fn wants_each(&self) -> bool {
        self.spots.is_some() || self.only.is_some()
    }

    /// The spots that were remembered.
    pub fn into_spots(self) -> HashSet<Spot> {
        self.spots.unwrap_or_default()
    }

    /// Takes a finding.
    pub fn report(&mut self, finding: Finding) {
        self.reported += 1;
        if self.wants_each() {
            let which = finding.place.pointer.as_ref().unwrap_or(&finding.message);
            let spot = (finding.place.file.clone(), which.clone());
            if self.only.as_ref().is_some_and(|only| !only.contains(&spot)) {
                return;
            }
            if let Some(spots) = &mut self.spots {
                spots.insert(spot);
            }
        }
        self.faulted.add(&finding.parts);
        let kind = match &finding.place.pointer {
            Some(pointer) => without_indices(pointer),
            None => finding.message.clone(),
        };
        let key = (finding.place.file.clone(), kind);
        let full = self.findings.len() >= KEPT_FINDINGS;
        match (self.by_place.get(&key), self.findings.last_mut()) {
            (None, Some(last)) if full => last.count += finding.count,
            (None, _) => {
                self.by_place.insert(key, self.findings.len());
                self.findings.push(finding);
            }
            (Some(&first), _) => {
                let first = &mut self.findings[first];
                first.count += finding.count;
                if first.more.len() + 1 < KEPT_PLACES && self.kept < KEPT_BYTES {
                    let mut other = finding.place;
                    if finding.message != first.message {
                        other.message = Some(finding.message);
                    }
                    self.kept += bytes(&other);
                    first.more.push(other);
                }
            }
        }
    }

    /// Says that the rule cannot be checked after all, and why.
    pub fn skip(&mut self, reason: SkipReason) {
        self.skipped = Some(reason);
    }

    /// Why the rule could not be checked, where it said so.
    pub fn skipped(&self) -> Option<&SkipReason> {
        self.skipped.as_ref()
    }

    /// Whether nothing was reported.
    pub fn is_empty(&self) -> bool {
        self.reported == 0
    }

    /// The findings, in the order in which the first of each was reported; none are left.
    pub fn take(&mut self) -> Vec<Finding> {
        self.by_place.clear();
        self.kept = 0;
        std::mem::take(&mut self.findings)
    }
}

/// A JSON Pointer with every list index replaced by `*`.
fn without_indices(pointer: &str) -> String {
    let parts: Vec<&str> = pointer
        .split('/')
        .map(|part| {
            if !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit()) {
                "*"
            } else {
                part
            }
        })
        .collect();
    parts.join("/")
}

/// Approximate memory of a place without its texts, in bytes. A constant, so that a report is the same on every machine.
const PLACE: usize = 184;

/// Approximate memory of a place, in bytes.
pub(super) fn bytes(place: &Place) -> usize {
    let texts = [
        &place.file,
        &place.pointer,
        &place.subject,
        &place.message,
        &place.expected,
        &place.actual,
    ];
    let texts = texts.into_iter().flatten().map(String::len);
    PLACE + texts.sum::<usize>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_is_folded_by_kind_of_place() {
        let mut findings = Findings::default();
        const MANY: usize = 2 * KEPT_PLACES;
        for i in 0..MANY {
            findings.report(Finding::at("a.json", format!("/m/{i}/0"), "wrong").actual(i));
            findings.report(Finding::at("b.json", format!("/m/{i}/0"), "wrong"));
        }
        findings.report(Finding::at("a.json", "/n/7", "wrong"));
        let findings = findings.take();
        assert_eq!(
            findings.iter().map(|f| f.count).collect::<Vec<_>>(),
            [MANY, MANY, 1]
        );
        assert_eq!(findings[0].more[1].actual.as_deref(), Some("2"));
    }

    #[test]
    fn what_is_kept_is_bounded_and_all_is_counted() {
        let mut findings = Findings::default();
        for i in 0..2 * KEPT_FINDINGS {
            findings.report(Finding::at("a.json", format!("/k{i}"), "wrong"));
        }
        for _ in 0..5 {
            for k in 0..5 {
                for i in 0..KEPT_PLACES {
                    findings.report(Finding::at("a.json", format!("/k{k}"), "wrong").actual(i));
                }
            }
        }
        let findings = findings.take();
        assert_eq!(findings.len(), KEPT_FINDINGS);
        let counts: usize = findings.iter().map(|finding| finding.count).sum();
        assert_eq!(counts, 2 * KEPT_FINDINGS + 25 * KEPT_PLACES);
        let more = findings.iter().flat_map(|finding| &finding.more);
        let bytes: usize = more.map(bytes).sum();
        assert!((KEPT_BYTES..KEPT_BYTES + 1000).contains(&bytes), "{bytes}");
    }

    #[test]
    fn spots_outlive_folding() {
        let mut all = Findings::remembering_spots();
        for i in 0..10 {
            all.report(Finding::at("a.json", format!("/m/{i}"), "wrong"));
        }
        let mut both = Findings::only_at(all.into_spots());
        for i in 8..20 {
            both.report(Finding::at("a.json", format!("/m/{i}"), "wrong").actual(i));
        }
        both.report(Finding::at("b.json", "/m/8", "wrong"));
        assert!(!both.is_empty());
        let both = both.take();
        assert_eq!(both.iter().map(|f| f.count).collect::<Vec<_>>(), [2]);
        assert_eq!(both[0].place.actual.as_deref(), Some("8"));
    }

    #[test]
    fn keys_are_not_taken_for_indices() {
        assert_eq!(without_indices("/links/12/name"), "/links/*/name");
        assert_eq!(without_indices("/12a/0"), "/12a/*");
        assert_eq!(without_indices(""), "");
    }
}
