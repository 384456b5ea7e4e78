//! The three answers: it passes, it fails, or it was not examined. The third is never the first.

use std::num::NonZeroUsize;

use urdd_directory::cancellation::Limit;
use urdd_format::index::Count;
use urdd_format::report::{Cause, NotExamined, Severity, Skipped, Status, Urdd, Verdict};

/// What came of the rules that ran.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Nothing was found at or above the severity at which a run fails.
    Passes(Looked),
    /// Something was found.
    Fails,
    /// A rule crashed.
    Crashed,
    /// No rule looked at anything.
    NotExamined,
}

/// How many rules looked at a URDD or URDF: at least one. A pass cannot be had without it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Looked(NonZeroUsize);

impl Looked {
    /// None if no rule looked at anything: each was skipped because something that it needs is wrong or missing, or there is
    /// none.
    fn at(urdd: &Urdd) -> Option<Looked> {
        let looked = urdd.checks.iter().filter(|check| match (check.status, check.skipped) {
            (Status::Passed | Status::Failed, _) => true,
            (Status::Skipped, Some(how)) => how != Skipped::NotVerified,
            (Status::Skipped, None) | (Status::Crashed, _) => false,
        });
        NonZeroUsize::new(looked.count()).map(Looked)
    }
}

impl Answer {
    /// The answer of the rules, by their results and findings in the report.
    pub fn of_rules(urdd: &Urdd, fail_on: Severity) -> Answer {
        if urdd.checks.iter().any(|check| check.status == Status::Crashed) {
            return Answer::Crashed;
        }
        if urdd.findings.iter().any(|finding| finding.severity >= fail_on) {
            return Answer::Fails;
        }
        Looked::at(urdd).map_or(Answer::NotExamined, Answer::Passes)
    }
}

/// No rule was asked about it, or each needs something that is not there.
pub(crate) fn no_rule_looked(urdd: &Urdd) -> NotExamined {
    let why = urdd.not_checked.first().map_or(
        "no rule that was selected is about it; correct --select, --ignore or the settings",
        |open| &open.reason,
    );
    not_examined(Cause::NoRule, why.to_owned())
}

/// That something was not examined for this reason: a person asked for it, and the place is not known.
pub fn not_examined(cause: Cause, reason: String) -> NotExamined {
    NotExamined { cause, reason, is_asked_for: true, file: None, line: None, column: None }
}

/// That a robot takes more than it may.
pub fn beyond(limit: Limit) -> NotExamined {
    not_examined(Cause::Limit, limit.to_string())
}

/// The same with its place in a file, if that is known. Of a binary file the line is 0.
pub fn placed(mut why: NotExamined, at: Option<(String, u32, u32)>) -> NotExamined {
    if let Some((file, line, column)) = at {
        why.file = Some(file);
        (why.line, why.column) = match line {
            0 => (None, None),
            _ => (Some(Count(line)), Some(Count(column))),
        };
    }
    why
}

/// The word of reports up to version 1.1 for something that was not examined.
pub(crate) fn verdict(why: &NotExamined) -> Verdict {
    match why.cause {
        Cause::Crash => Verdict::Incomplete,
        Cause::Unreadable | Cause::Arguments | Cause::Limit | Cause::NoRule => Verdict::Unreadable,
    }
}
