use crate::rules::prelude::*;

declare_rule! {
    /// A JSON file is not UTF-8.
    ///
    /// JSON between programs is UTF-8 and nothing else (RFC 8259). Most often the file was saved in an old
    /// or in a two-byte encoding.
    ///
    /// Save it as UTF-8.
    JSN003 "json-not-utf8", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_json(context, &[TextFaultKind::NotUtf8], findings)
}
