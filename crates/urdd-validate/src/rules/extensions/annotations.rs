use serde_json::Value;
use std::sync::Arc;

use super::schema::{MAX_PLACES, described};
use crate::rules::prelude::*;
use crate::views::annotated::Judged;
use crate::views::counts::Counts;
use urdd_document::schema_check;

declare_rule! {
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
