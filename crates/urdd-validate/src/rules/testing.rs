//! TST: rules for trying out the validator itself. None of them is ever run unasked.

use crate::rules::prelude::*;

declare_rule! {
    /// Crashes, always.
    ///
    /// Shows how a rule that runs into a fault of its own is reported: as crashed, with the verdict
    /// `incomplete` and exit status 101, and never as a URDD without faults.
    TST001 "crashes", Error, clause "13.1", since "0.1.0",
    phase Files, needs [], check crashes,
}

#[expect(clippy::panic, reason = "the purpose of the rule")]
fn crashes(context: &Context, _: &mut Findings) -> Option<()> {
    panic!("crashed on purpose at {} modules", context.modules().len())
}

/// A rule that crashes: TST001.
pub const CRASHING: &crate::rule::Rule = RULES[0];
