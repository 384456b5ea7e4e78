use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::views::extension_schema::{self, SchemaFile};
use urdd_document::module::is_extension;
use urdd_document::schema_check;

declare_rule! {
    /// The document of an extension is not valid under the extension's own schema.
    ///
    /// Programs that know the extension by its schema will refuse the document, or read what is not
    /// there.
    ///
    /// Correct `module.json`, or `schema.json` where that is out of date.
    EXT002 "extension-breaks-schema", Error, clause "11.1", since "0.1.0",
    phase Schema, needs [],
    check check,
}

/// Most places of one document that are reported.
const MOST: usize = 1000;

fn check(context: &Context, findings: &mut Findings) {
    for module in context.modules() {
        let (true, Some(document)) = (
            module.kind.is_none() && is_extension(&module.folder),
            module.json.document(),
        ) else {
            continue;
        };
        let SchemaFile::Read(schema) = extension_schema::read(context, module) else {
            continue;
        };
        // EXT001 reports a schema that cannot be used.
        if !extension_schema::faults(&schema, Some(&document.value)).is_empty() {
            continue;
        }
        let violations = extension_schema::violations(&schema, &document.value, MOST);
        let more = match violations.is_first_only {
            true => " (the document is large: there may be more)",
            false => "",
        };
        for (pointer, message) in violations.found {
            let actual = document.value.pointer(&pointer).map(schema_check::excerpt);
            let message = format!("the value does not fit schema.json: {message}{more}");
            let mut finding = Finding::at(module.file("module.json"), pointer, message);
            finding.place.actual = actual;
            findings.report(finding);
        }
    }
}
