use crate::context::Context;
use crate::finding::Findings;
use crate::rule::declare_rule;

declare_rule! {
    /// Crashes, always.
    ///
    /// Shows how a rule that runs into a fault of its own is reported: as crashed, with the verdict
    /// `incomplete` and exit status 101, and never as a URDD without faults.
    TST001 "crashes", Error, clause "13.1", since "0.1.0",
    phase Files, needs [],
    check check,
}

#[expect(clippy::panic, reason = "it is what the rule is for")]
fn check(context: &Context, _: &mut Findings) {
    panic!("crashed on purpose at {} modules", context.modules().len());
}
