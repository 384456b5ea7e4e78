//! EXT: extension modules.

use std::sync::Arc;

use serde_json::Value;

use crate::rules::prelude::*;
use crate::views::annotated::{Counts, Judged};
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
    /// can take time without end. Patterns are those of JavaScript in Unicode mode, which has no
    /// backslash before what needs none, and nothing repeated twice.
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

    /// A number in the document of an extension is not an index of what its schema says.
    ///
    /// The schema annotates the number with `x-index`: it is the index of a link, a joint, a DOF and so
    /// on. There is none of this index, so a program that looks it up fails. Most often the extension is
    /// stale: it was written before a link or joint was added or removed.
    ///
    /// Write the extension again for the robot as it is now, or correct `x-index` in `schema.json`.
    EXT003 "extension-index-out-of-range", Error, clause "11.5", since "1.0.0",
    phase References, needs [MESHES_LISTED, NotFailed(DOF001)],
    check |context, findings| report(context, Judged::Index, findings),

    /// A list in the document of an extension has not as many elements as its schema says.
    ///
    /// The schema annotates the list with `x-length`: it has an element for each link, joint, DOF and so
    /// on, and the place in the list is the index. Where an element is missing or too many, every later
    /// one belongs to another link. Most often the extension is stale.
    ///
    /// Write the extension again for the robot as it is now, or correct `x-length` in `schema.json`.
    EXT004 "extension-length-differs", Error, clause "11.5", since "1.0.0",
    phase References, needs [MESHES_LISTED, NotFailed(DOF001)],
    check |context, findings| report(context, Judged::Length, findings),
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
const MAX_PLACES: usize = 1000;

/// The folders of extensions.
fn extensions(context: &Context) -> impl Iterator<Item = &Module> {
    let modules = context.modules();
    modules.filter(|module| module.kind.is_none() && is_extension(&module.folder))
}

/// The extensions with a document and a schema that can be used (EXT001 reports others), and those two. Only schemas that
/// are `wanted` are tried: this takes time.
fn described<'a>(
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

/// Reports what breaks one of the annotations. EXT002 reports documents that break the rest of the schema.
fn report(context: &Context, judged: Judged, findings: &mut Findings) -> Option<()> {
    let mut counts = None;
    let mentions = move |schema: &Value| extension_schema::mentions(schema, judged.keyword());
    for (module, schema, document) in described(context, mentions) {
        let others = extension_schema::violations(&schema, document, None, 1);
        if !others.found.is_empty() {
            continue;
        }
        let counts = counts.get_or_insert_with(|| Arc::new(Counts::of(context)));
        let asserted = Some((judged, &*counts));
        let violations = extension_schema::violations(&schema, document, asserted, MAX_PLACES);
        let more = violations.more();
        for (pointer, message) in violations.found {
            let actual = document.pointer(&pointer).map(|value| match value {
                Value::Array(list) if list.len() == 1 => "1 element".to_owned(),
                Value::Array(list) => format!("{} elements", list.len()),
                value => schema_check::excerpt(value),
            });
            let mut finding = finding_in(module, pointer, format!("{message}{more}"));
            finding.place.actual = actual;
            findings.report(finding);
        }
    }
    Some(())
}
