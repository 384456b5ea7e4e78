//! Recognises documents of the format drafts that program versions 0.1.0 and 0.2.0 wrote under the same module versions
//! (SPEC 4.4).

use serde_json::{Value, json};

use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::registry::{ModuleKind, ModuleSpec};
use urdd_format::self_collision_model::ModelEvaluation;

/// Modules that the draft derived `link_shapes_simple_skips_module` from.
pub const SIMPLE_SKIPS_DEPENDENCIES: [ModuleKind; 2] =
    [ModuleKind::Chain, ModuleKind::LinkShapesDistanceStatistics];

/// Whether a document that breaks its schema is otherwise a valid draft: `link_shapes_skips_module` without
/// `skipped_reasons`, or `self_collision_model_module` with `held_out` instead of `evaluation`.
pub(super) fn is_draft(spec: &ModuleSpec, document: &Value) -> bool {
    let Some(object) = document.as_object() else {
        return false;
    };
    let mut completed = object.clone();
    let (key, value) = match spec.kind {
        ModuleKind::LinkShapesSkips => ("skipped_reasons", json!(SkippedReason::USUAL)),
        ModuleKind::SelfCollisionModel if completed.shift_remove("held_out").is_some() => {
            ("evaluation", json!(ModelEvaluation::NOTHING))
        }
        _ => return false,
    };
    if object.contains_key(key) {
        return false;
    }
    completed.insert(key.to_owned(), value);
    spec.read(&Value::Object(completed)).is_ok()
}
