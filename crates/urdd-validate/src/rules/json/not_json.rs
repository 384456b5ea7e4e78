use crate::rules::prelude::*;

declare_rule! {
    /// A file is not JSON.
    ///
    /// No program can read it, and nothing else that it says was checked. Most often the file was cut off
    /// while it was written, or holds a comment or a comma too many.
    ///
    /// Mend the text at the place that is given, or write the file again: into a file beside it that is
    /// then renamed, so that a program that stops half-way leaves the old file.
    JSN001 "not-json", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_json(context, &[TextFaultKind::Syntax], findings)
}
