//! Findings of `urdd validate` that are new or gone.

use std::collections::{BTreeMap, HashSet};

use crate::side::Side;
use urdd_format::diff_report::{FindingDifference, Presence};
use urdd_format::index::Count;
use urdd_format::report::{Finding, Skipped, Urdd};

/// The findings that differ; `None` where they were not asked for.
pub(super) fn differences(before: &Side, after: &Side) -> Option<Vec<FindingDifference>> {
    let (a, b) = (before.validation.as_ref()?, after.validation.as_ref()?);
    let mut found = gone(a, b, Presence::Removed);
    found.extend(gone(b, a, Presence::Added));
    Some(found)
}

/// What a finding is about, and how often it is there.
type Subjects = BTreeMap<String, u32>;

/// The findings of one that the other does not have, of rules that were meant for both.
fn gone(of: &Urdd, other: &Urdd, presence: Presence) -> Vec<FindingDifference> {
    let meant: HashSet<&str> = other
        .checks
        .iter()
        .filter(|check| check.skipped != Some(Skipped::OtherFormat))
        .map(|check| check.code.as_str())
        .collect();
    let mut there: BTreeMap<&str, Subjects> = BTreeMap::new();
    let mut cut: HashSet<&str> = HashSet::new();
    for finding in &other.findings {
        let subjects = there.entry(finding.code.as_str()).or_default();
        for subject in subjects_of(finding) {
            *subjects.entry(subject).or_default() += 1;
        }
        if finding.places_cut.0 > 0 {
            cut.insert(&finding.code);
        }
    }
    let mut found = Vec::new();
    let findings = of.findings.iter().filter(|f| meant.contains(f.code.as_str()));
    for finding in findings {
        let mut nothing = Subjects::new();
        let there = there.get_mut(finding.code.as_str()).unwrap_or(&mut nothing);
        let mut first = None;
        let mut count = 0;
        for subject in subjects_of(finding) {
            match there.get_mut(&subject) {
                Some(left) if *left > 0 => *left -= 1,
                _ => {
                    count += 1;
                    first.get_or_insert(subject);
                }
            }
        }
        // Where places are left out, only their number can be compared.
        if finding.places_cut.0 > 0 || cut.contains(finding.code.as_str()) {
            let counted = |urdd: &Urdd| -> u32 {
                let same = urdd.findings.iter().filter(|f| f.code == finding.code);
                same.map(|finding| finding.count.0).sum()
            };
            count = counted(of).saturating_sub(counted(other));
        }
        if count == 0 {
            continue;
        }
        found.push(FindingDifference {
            presence,
            code: finding.code.clone(),
            name: finding.name.clone(),
            severity: finding.severity,
            subject: first.filter(|subject| !subject.is_empty()),
            message: finding.message.clone(),
            count: Count(count),
        });
    }
    found
}

/// What each place of a finding is about: names where it has any, else the file and the pointer. Lines move too easily.
fn subjects_of(finding: &Finding) -> Vec<String> {
    let one = |subject: &Option<String>, file: &Option<String>, pointer: &Option<String>| {
        let place = [file, pointer].map(|part| part.clone().unwrap_or_default());
        subject.clone().unwrap_or_else(|| place.concat())
    };
    if finding.places.is_empty() {
        return vec![one(&finding.subject, &finding.file, &finding.pointer)];
    }
    let places = finding.places.iter();
    let places = places.map(|place| one(&place.subject, &place.file, &place.pointer));
    places.collect()
}
