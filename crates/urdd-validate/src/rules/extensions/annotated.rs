//! Documents of extensions against the annotations of their schemas.

use std::sync::Arc;

use super::{MAX_PLACES, described};
use crate::rules::prelude::*;
use crate::views::annotated::Judged;
use crate::views::counts::Counts;
use serde_json::Value;
use urdd_document::schema_check;

/// Reports what breaks one of the annotations. EXT002 reports documents that break the rest of the schema.
pub(super) fn report(context: &Context, judged: Judged, findings: &mut Findings) -> Option<()> {
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
