use super::faults::report_json;
use crate::rules::prelude::*;
use urdd_directory::text_fault::TextFaultKind::*;

declare_rule! {
    /// A file is not JSON.
    ///
    /// No program can read it, and nothing else that it says was checked. Most often the file was cut off
    /// while it was written, or holds a comment or a comma too many.
    ///
    /// Mend the text at the place that is given, or write the file again: into a file beside it that is
    /// then renamed, so that a program that stops half-way leaves the old file.
    JSN001 "not-json", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_json(context, Syntax, findings),

    /// A JSON object holds a key twice.
    ///
    /// Some readers keep the first value, some the last, and some refuse the file: each may see another
    /// robot.
    ///
    /// Remove one of the two.
    JSN002 "repeated-key", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_json(context, DuplicateKey, findings),

    /// A JSON file is not UTF-8.
    ///
    /// JSON between programs is UTF-8 and nothing else (RFC 8259). Most often the file was saved in an old
    /// or in a two-byte encoding.
    ///
    /// Save it as UTF-8.
    JSN003 "json-not-utf8", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_json(context, NotUtf8, findings),

    /// A JSON file begins with a byte order mark.
    ///
    /// Many readers, Python's `json` among them, refuse such a file.
    ///
    /// Save it as UTF-8 without a byte order mark (in Python: `utf-8`, not `utf-8-sig`).
    JSN004 "json-byte-order-mark", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_json(context, ByteOrderMark, findings),

    /// A number is not finite: `NaN`, `Infinity`, or too large for a 64-bit float.
    ///
    /// JSON has no such numbers. Some programs write them anyway (Python's `json` does), others refuse
    /// the whole file. The usual cause is a division by zero.
    ///
    /// Write null where the schema allows it, else the number that is meant.
    JSN005 "number-not-finite", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_json(context, NonFiniteNumber, findings),

    /// A JSON file is nested more than 100 deep.
    ///
    /// No document of this format comes near that, and readers that follow the nesting run out of stack: a
    /// file like this is broken, or meant to break its readers.
    ///
    /// Write the document again.
    JSN006 "json-too-deep", Error, clause "3.1.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_json(context, TooDeep, findings),
}
