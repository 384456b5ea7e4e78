//! JSN, YML and SCH: documents as text, in JSON and in the YAML beside it, and against their schemas.

use crate::rules::directory::versions::other_major;
use crate::rules::prelude::*;
use urdd_directory::position::TextFaultKind::{self, *};
use urdd_directory::position::{TextFault, TextFaults};
use urdd_document::module::Mirror;
use urdd_document::schema_check::SchemaViolation;
use urdd_findings::finding::{KEPT_PLACES, Place};
use urdd_format::index::Count;

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

    /// A `module.yaml` is not plain YAML: not well-formed, not UTF-8, with a byte order mark, a
    /// directive, more than one document, or keys that are not strings.
    ///
    /// Readers of YAML differ most in what is unusual. A file in this plain form is the same to all of them.
    ///
    /// Mend it at the place that is given, or write it again from `module.json`.
    YML001 "not-yaml", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, KINDS, &[], findings),

    /// A `module.yaml` holds a tag, such as `!Mesh`.
    ///
    /// Safe readers (PyYAML's `safe_load`, most readers in other languages) refuse a file with a tag that
    /// they do not know, and a tagged value is not what `module.json` says.
    ///
    /// Write the choice as `module.json` has it, as a mapping of one key: `geometry: {Mesh: {...}}`.
    YML002 "yaml-tag", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlTag], &[], findings),

    /// A `module.yaml` holds an anchor (`&a`) or an alias (`*a`).
    ///
    /// JSON has nothing like it, not every reader knows it, and a few lines of aliases can stand for
    /// gigabytes. (Aliases are not followed here.)
    ///
    /// Write the value out at each place. Programs that make anchors by themselves have an option against
    /// it (PyYAML: a dumper whose `ignore_aliases` is true).
    YML003 "yaml-anchor", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlAnchorOrAlias], &[], findings),

    /// A `module.yaml` holds a merge key (`<<`).
    ///
    /// It is a habit of YAML 1.1 and was never part of YAML 1.2: to some readers it is a key named `<<`.
    ///
    /// Write the keys out at each place.
    YML004 "yaml-merge-key", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlMergeKey], &[], findings),

    /// A `module.yaml` has a key twice in one mapping.
    ///
    /// Some readers keep the first value, some the last, and some refuse the file.
    ///
    /// Remove one of the two.
    YML005 "yaml-repeated-key", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlDuplicateKey], &[], findings),

    /// A `module.yaml` holds a word that YAML 1.1 and YAML 1.2 read differently.
    ///
    /// To PyYAML and to every other reader of YAML 1.1 `1e-7` is a string and `no` is false; to readers of
    /// YAML 1.2 `1e-7` is a number and `no` is a string. A program gets text where it wants a bound, or a
    /// link named false.
    ///
    /// Write numbers with a point and a signed exponent (`1.0e-7`), and put quotes around strings that
    /// look like something else (`"no"`, `"1:30"`, `"0x1"`).
    YML006 "yaml-ambiguous", Error, clause "3.2.3", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlAmbiguousScalar], &[], findings),

    /// A `module.yaml` does not say what `module.json` says.
    ///
    /// Readers of the one and of the other see two robots. Most often one of the two was edited, or
    /// written again, and the other was not.
    ///
    /// Write both from one source; where a person edits, edit `module.json`, which is the one that counts,
    /// and write `module.yaml` from it.
    YML007 "yaml-differs", Error, clause "3.2.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlDiffers], UNREAD, findings),

    /// A `module.yaml` is nested more than 100 deep.
    ///
    /// No document of this format comes near that, and readers that follow the nesting run out of stack.
    ///
    /// Write it again from `module.json`.
    YML008 "yaml-too-deep", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlTooDeep], &[], findings),

    /// A document breaks the schema of its version: a key is missing, unknown or misspelt, or a value
    /// is of the wrong type.
    ///
    /// Typed readers refuse such a document, and others go on with what is not there. Whatever needs
    /// the module is not checked until this is right.
    ///
    /// Every key is required: write null for what is absent. Keys of your own begin with `x_`. The
    /// schema is `urdd schema show <module>@<version>`; editors show these faults as you type where
    /// the document names it as `$schema`.
    SCH001 "breaks-schema", Error, clause "3.1.2", since "0.1.0",
    phase Schema, needs [], check breaks_schema,
}

const KINDS: &[TextFaultKind] = &[
    YamlSyntax,
    YamlNotUtf8,
    YamlByteOrderMark,
    YamlDirective,
    YamlSeveralDocuments,
    YamlNonStringKey,
];

/// Faults that end the reading: what the YAML then lacks follows from them.
const UNREAD: &[TextFaultKind] = &[YamlSyntax, YamlNotUtf8, YamlTooDeep];

/// Reports the faults of this kind in `urdd.json` and every `module.json`: one finding per file, with their
/// number.
fn report_json(context: &Context, kind: TextFaultKind, findings: &mut Findings) -> Option<()> {
    if let Some(faults) = context.metadata_file().json.faults() {
        report(ROOT_METADATA, faults, &[kind], findings);
    }
    for module in entries::known_modules(context) {
        if let Some(faults) = module.json.faults() {
            report(&module.file("module.json"), faults, &[kind], findings);
        }
    }
    Some(())
}

/// Like [`report_json`] of several kinds, for every `module.yaml` without a fault of the kinds in `unless`.
fn report_yaml(
    context: &Context,
    kinds: &[TextFaultKind],
    unless: &[TextFaultKind],
    findings: &mut Findings,
) -> Option<()> {
    for module in entries::known_modules(context) {
        if let Mirror::Compared(faults) = &module.mirror
            && unless.iter().all(|kind| faults.total(*kind) == 0)
        {
            report(&module.file("module.yaml"), faults, kinds, findings);
        }
    }
    Some(())
}

fn report(file: &str, faults: &TextFaults, kinds: &[TextFaultKind], findings: &mut Findings) {
    for kind in kinds {
        let mut kept = faults.iter().filter(|fault| fault.kind == *kind);
        let Some(first) = kept.next() else { continue };
        let mut finding = Finding::in_file(file, first.message.clone());
        finding.place = place(file, first);
        finding.count = faults.total(*kind);
        finding.more = kept.take(KEPT_PLACES - 1).map(|fault| place(file, fault)).collect();
        findings.report(finding);
    }
}

fn place(file: &str, fault: &TextFault) -> Place {
    Place {
        file: Some(file.to_owned()),
        pointer: fault.pointer.clone(),
        line: fault.position.map(|position| Count(position.line)),
        column: fault.position.map(|position| Count(position.column)),
        expected: fault.expected.clone(),
        actual: fault.found.clone(),
        ..Place::default()
    }
}

fn breaks_schema(context: &Context, findings: &mut Findings) -> Option<()> {
    // The schema is that of version 1: DIR025 reports another one.
    if other_major(context).is_none() {
        report_violations(ROOT_METADATA, &context.metadata_file().violations, findings);
    }
    for module in entries::known_modules(context) {
        report_violations(&module.file("module.json"), &module.violations, findings);
    }
    Some(())
}

fn report_violations(file: &str, violations: &[SchemaViolation], findings: &mut Findings) {
    for violation in violations {
        let mut finding = Finding::at(file, violation.place(), violation.message.clone());
        finding.place.expected.clone_from(&violation.expected);
        finding.place.actual.clone_from(&violation.actual);
        findings.report(finding);
    }
}
