use super::extensions;
use crate::rules::prelude::*;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in extensions(context) {
        let file = module.file("schema.json");
        match extension_schema::read(context, module) {
            Err(message) => Finding::in_file(file, message).report(findings),
            Ok(schema) => {
                let document = module.json.document().map(|document| &document.value);
                for fault in extension_schema::faults(&schema, document) {
                    Finding::at(&file, fault.pointer, fault.message).report(findings);
                }
            }
        }
    }
    Some(())
}
