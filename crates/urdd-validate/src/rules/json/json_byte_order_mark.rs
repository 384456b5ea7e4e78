use crate::rules::prelude::*;

declare_rule! {
    /// A JSON file begins with a byte order mark.
    ///
    /// Many readers, Python's `json` among them, refuse such a file.
    ///
    /// Save it as UTF-8 without a byte order mark (in Python: `utf-8`, not `utf-8-sig`).
    JSN004 "json-byte-order-mark", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_json(context, &[TextFaultKind::ByteOrderMark], findings)
}
