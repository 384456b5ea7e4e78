use crate::rules::directory::edition::other_major;
use crate::rules::prelude::*;
use urdd_document::schema_check::SchemaViolation;

declare_rule! {
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
    phase Schema, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    // The schema is that of version 1: DIR025 reports another one.
    if other_major(context).is_none() {
        report(ROOT_METADATA, &context.metadata_file().violations, findings);
    }
    for module in entries::known_modules(context) {
        report(&module.file("module.json"), &module.violations, findings);
    }
    Some(())
}

fn report(file: &str, violations: &[SchemaViolation], findings: &mut Findings) {
    for violation in violations {
        let mut finding = Finding::at(file, violation.place(), violation.message.clone());
        finding.place.expected.clone_from(&violation.expected);
        finding.place.actual.clone_from(&violation.actual);
        findings.report(finding);
    }
}
