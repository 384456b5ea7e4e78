//! The parts of a robot that a rule judges, and those that it did not verify.

use std::collections::{BTreeSet, HashMap};

use super::code::Code;
use super::part::{NotVerified, Part, Why};

/// The parts in which a rule found a fault.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Faulted {
    parts: BTreeSet<Part>,
    elsewhere: bool,
}

impl Faulted {
    /// Adds the parts of a finding. Without parts, the fault does not belong to single parts.
    pub fn add(&mut self, parts: &[Part]) {
        self.parts.extend(parts);
        self.elsewhere |= parts.is_empty();
    }

    /// The parts.
    pub fn parts(&self) -> &BTreeSet<Part> {
        &self.parts
    }

    /// Whether there are faults besides those of single parts.
    pub fn elsewhere(&self) -> bool {
        self.elsewhere
    }

    /// Whether a convex piece, or something besides single parts, is faulty.
    pub fn has_pieces(&self) -> bool {
        self.elsewhere || self.parts.iter().any(|part| matches!(part, Part::Piece { .. }))
    }
}

/// The parts that a rule judges.
#[derive(Debug, Clone, Default)]
pub struct Scope {
    unsound: HashMap<Part, Code>,
    judged: usize,
    not_verified: BTreeSet<NotVerified>,
}

impl Scope {
    /// All parts except those in which other rules found a fault, given with the rule.
    pub fn without(unsound: HashMap<Part, Code>) -> Self {
        Scope { unsound, ..Scope::default() }
    }

    /// The same parts, none of them judged yet.
    pub fn afresh(&self) -> Self {
        Scope::without(self.unsound.clone())
    }

    /// Whether to judge a part against other parts: not if one of them is unsound. Records what is not judged.
    pub fn judges(&mut self, part: Part, by: &[Part]) -> bool {
        let mut needed = std::iter::once(&part).chain(by);
        match needed.find_map(|needed| self.unsound.get(needed)) {
            Some(code) => {
                self.leave_out(part, Why::Failed(*code));
                false
            }
            None => {
                self.judged += 1;
                true
            }
        }
    }

    /// Records that a part was not verified.
    pub fn leave_out(&mut self, part: Part, why: Why) {
        self.not_verified.insert(NotVerified { part, why });
    }

    /// The rule whose fault left nothing to judge, if so.
    pub fn nothing_left(&self) -> Option<Code> {
        if self.judged > 0 {
            return None;
        }
        self.not_verified.iter().find_map(|one| match one.why {
            Why::Failed(code) => Some(code),
            _ => None,
        })
    }

    /// The parts that were not verified.
    pub fn not_verified(&self) -> Vec<NotVerified> {
        self.not_verified.iter().copied().collect()
    }
}
