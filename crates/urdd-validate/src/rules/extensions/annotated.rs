//! Documents of extensions against the annotations of their schemas.

use std::sync::Arc;

use super::{MAX_PLACES, extensions};
use crate::rules::prelude::*;
use crate::views::annotated::Judged;
use crate::views::counts::Counts;
use crate::views::extension_schema::{self, SchemaFile};
use serde_json::Value;
use urdd_document::schema_check;

/// Reports what breaks one of the annotations. EXT001 reports schemas that cannot be used, and EXT002 documents that
/// break the rest of the schema.
pub(super) fn report(context: &Context, judged: Judged, findings: &mut Findings) {
    let mut counts = None;
    for module in extensions(context) {
        let schema = extension_schema::read(context, module);
        let (SchemaFile::Read(schema), Some(document)) = (schema, module.json.document()) else {
            continue;
        };
        let document = &document.value;
        if !extension_schema::mentions(&schema, judged.keyword())
            || !extension_schema::faults(&schema, Some(document)).is_empty()
            || !extension_schema::violations(&schema, document, 1)
                .found
                .is_empty()
        {
            continue;
        }
        let counts = counts.get_or_insert_with(|| Arc::new(Counts::of(context)));
        let violations =
            extension_schema::annotation_violations(&schema, document, judged, counts, MAX_PLACES);
        let more = violations.more();
        for (pointer, message) in violations.found {
            let actual = document.pointer(&pointer).map(|value| match value {
                Value::Array(list) if list.len() == 1 => "1 element".to_owned(),
                Value::Array(list) => format!("{} elements", list.len()),
                value => schema_check::excerpt(value),
            });
            let message = format!("{message}{more}");
            let mut finding = Finding::of(module, pointer, message);
            finding.place.actual = actual;
            findings.report(finding);
        }
    }
}
