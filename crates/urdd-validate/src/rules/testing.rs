//! TST: rules for trying out the validator itself. None of them is ever run unasked.

use std::time::Duration;

use crate::rules::prelude::*;

declare_rule! {
    /// Crashes, always.
    ///
    /// Shows how a rule that runs into a fault of its own is reported: as crashed, with the verdict
    /// `incomplete` and exit status 101, and never as a URDD without faults.
    TST001 "crashes", Error, clause "13.1", since "0.1.0",
    phase Files, needs [], check crashes,

    /// Takes ten minutes for a robot named `slow`, and does not look whether it was cancelled.
    ///
    /// Shows what becomes of a robot beyond its limits that does not stop, and of the others of a batch.
    TST002 "is slow", Error, clause "13.1", since "1.4.1",
    phase Files, needs [], check sleeps,
}

#[expect(clippy::panic, reason = "the purpose of the rule")]
fn crashes(context: &Context, _: &mut Findings) -> Option<()> {
    panic!("crashed on purpose at {} modules", context.modules().len())
}

fn sleeps(context: &Context, _: &mut Findings) -> Option<()> {
    if context.metadata()?.robot_name == "slow" {
        std::thread::sleep(Duration::from_secs(600));
    }
    Some(())
}

/// A rule that takes long: TST002.
pub const SLOW: &crate::rule::Rule = RULES[1];

/// A rule that crashes: TST001.
pub const CRASHING: &crate::rule::Rule = RULES[0];
