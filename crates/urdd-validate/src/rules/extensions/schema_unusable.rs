use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::views::extension_schema::{self, SchemaFile};
use urdd_document::module::is_extension;

declare_rule! {
    /// An extension has no `schema.json` that can be used.
    ///
    /// The schema says what the extension's fields are, and its documents are checked by it. It
    /// must be a JSON Schema (draft 2020-12) that is complete by itself: nothing outside of it is
    /// opened, so every `$ref` begins with `#`, and only the schema itself may have an `$id`. A
    /// schema is refused where it takes too much work to evaluate, and where a pattern has
    /// lookaround (`(?=`, `(?!`, `(?<=`, `(?<!`) or refers back to a group (`\1`): such patterns
    /// can take time without end.
    ///
    /// Put a `schema.json` beside the extension's `module.json`. A schema that allows everything is
    /// `true`.
    EXT001 "extension-schema-unusable", Error, clause "11.1", since "0.1.0",
    phase Schema, needs [],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    for module in context.modules() {
        if module.kind.is_some() || !is_extension(&module.folder) {
            continue;
        }
        let file = module.file("schema.json");
        let schema = match extension_schema::read(context, module) {
            SchemaFile::Read(schema) => schema,
            SchemaFile::Missing => {
                findings.report(Finding::in_file(
                    file,
                    "the extension has no schema.json: put its JSON Schema there",
                ));
                continue;
            }
            SchemaFile::Unreadable(error) => {
                findings.report(Finding::in_file(file, error.to_string()));
                continue;
            }
            SchemaFile::NotJson(message) => {
                findings.report(Finding::in_file(file, format!("not JSON: {message}")));
                continue;
            }
        };
        let document = module.json.document().map(|document| &document.value);
        for fault in extension_schema::faults(&schema, document) {
            findings.report(Finding::at(&file, fault.pointer, fault.message));
        }
    }
}
