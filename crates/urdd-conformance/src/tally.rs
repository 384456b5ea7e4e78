//! Counts how cases were judged.

use urdd_format::conformance::{CaseFault, CaseScore};
use urdd_format::index::Count;

/// Running counts of case results.
#[derive(Debug, Default, Clone, Copy)]
pub struct Tally {
    of: u32,
    right: u32,
    missed: u32,
    false_alarms: u32,
    undecided: u32,
}

impl Tally {
    /// Adds a case; `None` if it was judged right.
    pub fn add(&mut self, fault: Option<CaseFault>) {
        self.of += 1;
        let place = match fault {
            None => &mut self.right,
            Some(CaseFault::Missed) => &mut self.missed,
            Some(CaseFault::FalseAlarm) => &mut self.false_alarms,
            Some(CaseFault::Undecided) => &mut self.undecided,
        };
        *place += 1;
    }

    /// The counts, as the result has them.
    pub fn score(self) -> CaseScore {
        CaseScore {
            of: Count(self.of),
            right: Count(self.right),
            missed: Count(self.missed),
            false_alarms: Count(self.false_alarms),
            undecided: Count(self.undecided),
        }
    }
}
