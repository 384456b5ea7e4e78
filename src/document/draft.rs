//! The draft of this format that version 0.1.0 of the program wrote, under the same module versions:
//! how its documents are recognised (SPEC 4.4).

use serde_json::{Value, json};

use crate::format::link_shapes_skips::SkippedReason;
use crate::format::registry::{ModuleKind, ModuleSpec};

/// What the draft derived `link_shapes_simple_skips_module` from.
pub const SIMPLE_SKIPS_DEPENDENCIES: [ModuleKind; 2] =
    [ModuleKind::Chain, ModuleKind::LinkShapesDistanceStatistics];

/// Whether a document that breaks its schema is one of the draft: that of
/// `link_shapes_skips_module` without `skipped_reasons`, all else being right.
pub(super) fn is_draft(spec: &ModuleSpec, document: &Value) -> bool {
    let Some(object) = document.as_object() else {
        return false;
    };
    if spec.kind != ModuleKind::LinkShapesSkips || object.contains_key("skipped_reasons") {
        return false;
    }
    let mut completed = object.clone();
    completed.insert("skipped_reasons".to_owned(), json!(SkippedReason::USUAL));
    spec.read(&Value::Object(completed)).is_ok()
}
