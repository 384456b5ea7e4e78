use crate::rules::prelude::*;

declare_rule! {
    /// A number is not finite: `NaN`, `Infinity`, or too large for a 64-bit float.
    ///
    /// JSON has no such numbers. Some programs write them anyway (Python's `json` does), others refuse
    /// the whole file. The usual cause is a division by zero.
    ///
    /// Write null where the schema allows it, else the number that is meant.
    JSN005 "number-not-finite", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_json(context, &[TextFaultKind::NonFiniteNumber], findings)
}
