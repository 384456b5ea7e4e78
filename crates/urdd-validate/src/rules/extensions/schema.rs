use serde_json::Value;

use crate::rules::prelude::*;
use urdd_document::module::is_extension;
use urdd_document::schema_check;

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
    phase Schema, needs [], check schema_unusable,

    /// The document of an extension is not valid under the extension's own schema.
    ///
    /// Programs that know the extension by its schema will refuse the document, or read what is not
    /// there.
    ///
    /// Correct `module.json`, or `schema.json` where that is out of date.
    EXT002 "extension-breaks-schema", Error, clause "11.1", since "0.1.0",
    phase Schema, needs [], check document_invalid,
}

fn schema_unusable(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn document_invalid(context: &Context, findings: &mut Findings) -> Option<()> {
    for (module, schema, document) in described(context, |_| true) {
        let violations = extension_schema::violations(&schema, document, None, MAX_PLACES);
        let more = violations.more();
        for (pointer, message) in violations.found {
            let actual = document.pointer(&pointer).map(schema_check::excerpt);
            let message = format!("the value does not match schema.json: {message}{more}");
            let mut finding = finding_in(module, pointer, message);
            finding.place.actual = actual;
            findings.report(finding);
        }
    }
    Some(())
}

/// Maximum number of reported places of a document.
pub(super) const MAX_PLACES: usize = 1000;

/// The folders of extensions.
fn extensions(context: &Context) -> impl Iterator<Item = &Module> {
    let modules = context.modules();
    modules.filter(|module| module.kind.is_none() && is_extension(&module.folder))
}

/// The extensions with a document and a schema that can be used (EXT001 reports others), and those two. Only schemas that
/// are `wanted` are tried: this takes time.
pub(super) fn described<'a>(
    context: &'a Context,
    wanted: impl Fn(&Value) -> bool + 'a,
) -> impl Iterator<Item = (&'a Module, Value, &'a Value)> {
    extensions(context).filter_map(move |module| {
        let document = &module.json.document()?.value;
        let schema =
            extension_schema::read(context, module).ok().filter(|schema| wanted(schema))?;
        let faults = extension_schema::faults(&schema, Some(document));
        faults.is_empty().then_some((module, schema, document))
    })
}
