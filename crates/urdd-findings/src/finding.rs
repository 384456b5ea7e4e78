//! Findings, and folding of similar ones.

use std::collections::{HashMap, HashSet};

use super::part::{Faulted, Part, Scope, SkipReason, Why};
use urdd_directory::position::Position;
use urdd_format::index::Count;
use urdd_format::report::{Consequence, Fix, Magnitude, Severity};

pub use urdd_format::report::Place;

/// Maximum number of places kept of a folded finding; the rest are counted.
pub const KEPT_PLACES: usize = 10_000;
/// Maximum number of findings of a rule in a URDD; the rest are counted.
pub const KEPT_FINDINGS: usize = 10_000;
/// Maximum memory of the further places of a rule's findings, bytes, approximately; the rest are counted.
pub const KEPT_BYTES: usize = 4 << 20;
/// And of the findings themselves, with their messages.
const KEPT_FIRSTS: usize = 16 << 20;

/// A fault found by a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Where, and what is expected and found there.
    pub place: Place,
    /// What is wrong and what to do, for people.
    pub message: String,
    /// Its severity, if it is not that of its rule. Settings that name the rule come first.
    pub severity: Option<Severity>,
    /// What it leads to, if that is not what its rule says.
    pub consequence: Option<Consequence>,
    /// Where numbers were compared: the tolerance, in the unit of the numbers.
    pub tolerance: Option<f64>,
    /// The faulty meshes, if the finding is about meshes of single links. Does not include those of findings that were
    /// folded into this one.
    pub parts: Vec<Part>,
    /// Number of findings that it represents.
    pub count: usize,
    /// The next few of these, after this one.
    pub more: Vec<Place>,
}

impl Finding {
    /// A finding about a value of a document in a file.
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
            severity: None,
            consequence: None,
            tolerance: None,
            parts: Vec::new(),
            count: 1,
            more: Vec::new(),
        }
    }

    /// Sets the line and column.
    pub fn position(mut self, position: Option<Position>) -> Self {
        self.place.line = position.map(|position| Count(position.line));
        self.place.column = position.map(|position| Count(position.column));
        self
    }

    /// Sets the expected value.
    pub fn expected(mut self, expected: impl ToString) -> Self {
        self.place.expected = Some(expected.to_string());
        self
    }

    /// Sets the actual value.
    pub fn actual(mut self, actual: impl ToString) -> Self {
        self.place.actual = Some(actual.to_string());
        self
    }

    /// Sets a number and the copy of it that differs by more than this tolerance.
    pub fn numbers(self, expected: f64, actual: f64, tolerance: f64) -> Self {
        self.expected(format!("{expected:?}"))
            .actual(format!("{actual:?}"))
            .tolerance(tolerance)
            .off_by(expected - actual, "")
    }

    /// Sets the tolerance of the comparison, if it is finite.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = Some(tolerance).filter(|tolerance| tolerance.is_finite());
        self
    }

    /// Sets the difference of the numbers and its unit. Among folded findings, the worst comes first.
    pub fn off_by(mut self, value: f64, unit: &'static str) -> Self {
        self.place.magnitude = Some(Magnitude {
            value: Some(value.abs()).filter(|value| value.is_finite()),
            unit: unit.to_owned(),
        });
        self
    }

    /// Adds a faulty mesh.
    pub fn part(mut self, part: impl Into<Option<Part>>) -> Self {
        self.parts.extend(part.into());
        self
    }

    /// Adds another place to look at: that of a finding, whose message says what is there.
    pub fn related(mut self, other: Finding) -> Self {
        self.place.related.push(Place { message: Some(other.message), ..other.place });
        self
    }

    /// Adds a change that mends it, if there is one.
    pub fn fix(mut self, fix: impl Into<Option<Fix>>) -> Self {
        self.place.fixes.extend(fix.into());
        self
    }

    /// Sets the number of findings that it represents.
    pub fn count(mut self, count: usize) -> Self {
        self.count = count;
        self
    }

    /// All its places, the first one first.
    pub fn places(&self) -> impl Iterator<Item = &Place> {
        std::iter::once(&self.place).chain(&self.more)
    }

    /// All its places, each with what it says.
    pub fn said(&self) -> impl Iterator<Item = (&Place, &str)> {
        self.places().map(|place| (place, place.message.as_deref().unwrap_or(&self.message)))
    }

    /// As [`Finding::places`], to change them.
    pub fn places_mut(&mut self) -> impl Iterator<Item = &mut Place> {
        std::iter::once(&mut self.place).chain(&mut self.more)
    }

    /// Adds it to a rule's findings.
    pub fn report(self, findings: &mut Findings) {
        findings.report(self);
    }
}

/// A point in messages, metres.
pub fn point([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4}, {y:.4}, {z:.4})")
}

/// The findings of a rule in a URDD. Findings at the same kind of place (same file, and same pointer apart from list
/// indices) are folded into one with a count, so that a million of them take no more memory than a few.
#[derive(Debug, Default)]
pub struct Findings {
    findings: Vec<Finding>,
    by_place: HashMap<(Option<String>, String, Option<Severity>), usize>,
    reported: usize,
    kept: usize,
    kept_firsts: usize,
    pub(super) skipped: Option<SkipReason>,
    spots: Option<HashSet<Spot>>,
    only: Option<HashSet<Spot>>,
    pub(super) faulted: Faulted,
    pub(super) scope: Scope,
}

/// Identifies a finding of a rule: the file, and the pointer or, without one, the message.
pub type Spot = (Option<String>, String);

impl Findings {
    /// Findings that record the spot of every finding, folded or not.
    pub fn remembering_spots() -> Self {
        Findings { spots: Some(HashSet::new()), ..Findings::default() }
    }

    /// Sets the parts to judge.
    pub fn within(mut self, scope: Scope) -> Self {
        self.scope = scope;
        self
    }

    /// Whether to judge a part against other parts: not if one of them failed a needed rule.
    /// Records a part that is not judged as not verified.
    pub fn judges(&mut self, part: Part, by: &[Part]) -> bool {
        self.scope.judges(part, by)
    }

    /// Records that a part was not verified.
    pub fn not_verified(&mut self, part: Part, why: Why) {
        self.scope.leave_out(part, why);
    }

    /// Findings that keep only those at the given spots.
    pub fn only_at(spots: HashSet<Spot>) -> Self {
        Findings { only: Some(spots), ..Findings::default() }
    }

    /// Whether every finding must be reported on its own.
    pub fn wants_each(&self) -> bool {
        self.spots.is_some() || self.only.is_some()
    }

    /// The recorded spots.
    pub fn into_spots(self) -> HashSet<Spot> {
        self.spots.unwrap_or_default()
    }

    /// Adds a finding.
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
        let key = (finding.place.file.clone(), kind, finding.severity);
        let full = self.findings.len() >= KEPT_FINDINGS || self.kept_firsts >= KEPT_FIRSTS;
        match (self.by_place.get(&key), self.findings.last_mut()) {
            (None, Some(last)) if full => last.count += finding.count,
            (None, _) => {
                self.kept_firsts += bytes(&finding.place) + finding.message.len() + key.1.len();
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

    /// Records why the rule cannot be checked. Returns `None`, with which the check ends.
    pub fn skip(&mut self, reason: SkipReason) -> Option<()> {
        self.skipped = Some(reason);
        None
    }

    /// The value; otherwise skips the rule for the reason given.
    pub fn or_skip<T>(&mut self, result: Result<T, SkipReason>) -> Option<T> {
        result.map_err(|reason| self.skip(reason)).ok()
    }

    /// Whether nothing was reported.
    pub fn is_empty(&self) -> bool {
        self.reported == 0
    }

    /// Removes the findings, in the order in which the first of each was reported.
    pub fn take(&mut self) -> Vec<Finding> {
        self.by_place.clear();
        (self.kept, self.kept_firsts) = (0, 0);
        std::mem::take(&mut self.findings)
    }
}

/// A JSON Pointer with each list index replaced by `*`.
pub fn without_indices(pointer: &str) -> String {
    let is_index = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    let parts = pointer.split('/').map(|part| if is_index(part) { "*" } else { part });
    parts.collect::<Vec<_>>().join("/")
}

/// Approximate memory of a place, a fix and an edit without their texts, in bytes. Constants, so that a report is the
/// same on every machine.
const PLACE: usize = 320;
const FIX: usize = 56;
const EDIT: usize = 64;
/// And of a program that does something because of it.
const PROGRAM: usize = 40;

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
    let fixes = place.fixes.iter().map(|fix| {
        let edits = fix.edits.iter();
        let edits = edits.map(|edit| EDIT + edit.file.len() + edit.text.len());
        FIX + fix.message.len() + edits.sum::<usize>()
    });
    let related = place.related.iter().map(bytes);
    let programs = PROGRAM * place.programs.len();
    PLACE + programs + texts.sum::<usize>() + fixes.sum::<usize>() + related.sum::<usize>()
}

/// Reports findings at one kind of place: builds the first few and counts the rest. For tables in which every element
/// may be wrong. When dropped, it reports the count of those that were not built.
pub struct Fold<'a> {
    findings: &'a mut Findings,
    seen: usize,
    last: Option<Finding>,
}

impl<'a> Fold<'a> {
    /// Reports into `findings`.
    pub fn new(findings: &'a mut Findings) -> Self {
        Fold { findings, seen: 0, last: None }
    }

    /// Adds a finding.
    pub fn add(&mut self, make: impl FnOnce() -> Finding) {
        self.seen += 1;
        if self.seen <= KEPT_PLACES || self.findings.wants_each() {
            self.findings.report(make());
        } else if self.last.is_none() {
            self.last = Some(make());
        }
    }
}

impl Drop for Fold<'_> {
    fn drop(&mut self) {
        if let Some(last) = self.last.take() {
            self.findings.report(last.count(self.seen - KEPT_PLACES));
        }
    }
}
