//! The tests of this crate.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod bound;
mod code;
mod crash;
mod finding;
mod fold;
mod report_causes;
mod report_place;
mod report_summary;
mod robots;
mod scope;
mod worst;

use crate::code::Code;
use crate::description::{Consequence, Description, Phase, Severity};

/// That of a rule, whichever.
static DESCRIPTION: Description = Description {
    code: Code::DOF001,
    name: "a-fault",
    severity: Severity::Error,
    clause: None,
    since: "1.0.0",
    consequence: Consequence::Format,
    phase: Phase::References,
    doc: &[" Something is wrong."],
};
