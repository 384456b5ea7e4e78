use crate::rules::prelude::*;

declare_rule! {
    /// A JSON object holds a key twice.
    ///
    /// Some readers keep the first value, some the last, and some refuse the file: each may see another
    /// robot.
    ///
    /// Remove one of the two.
    JSN002 "repeated-key", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_json(context, &[TextFaultKind::DuplicateKey], findings)
}
