use super::{MAX_PLACES, described};
use crate::rules::prelude::*;
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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
