use crate::rules::prelude::*;

declare_rule! {
    /// A JSON file is nested more than 100 deep.
    ///
    /// No document of this format comes near that, and readers that follow the nesting run out of stack: a
    /// file like this is broken, or meant to break its readers.
    ///
    /// Write the document again.
    JSN006 "json-too-deep", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_json(context, &[TextFaultKind::TooDeep], findings)
}
