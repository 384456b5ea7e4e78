//! Raises legacy documents to version 1, so that programs see one format, and recognises documents of the format drafts
//! that program versions 0.1.0 and 0.2.0 wrote under the same module versions (SPEC 4.4).
//!
//! What a legacy module does not state becomes null or an empty list; [`crate::consumer`] fills in the joints of
//! `chain_module` from the robot. All other values keep their JSON Pointers. Mesh modules and matrices over shapes are
//! not raised: their keys differ.

use serde_json::{Value, json};

use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::registry::{ModuleDocument, ModuleKind, ModuleSpec, Profile, modules};
use urdd_format::self_collision_model::ModelEvaluation;

/// Reads a document of a module, and raises it.
///
/// # Errors
/// If it breaks its schema.
pub(super) fn read(
    spec: &ModuleSpec,
    document: &Value,
) -> Result<ModuleDocument, serde_json::Error> {
    let read = spec.read(document)?;
    let of_v1 = |v1: &&ModuleSpec| v1.kind == spec.kind && v1.profile == Profile::V1;
    match modules().iter().find(of_v1).filter(|_| spec.profile == Profile::Legacy) {
        Some(v1) => raise(spec.kind, document).map_or(Ok(read), |raised| v1.read(&raised)),
        None => Ok(read),
    }
}

/// A legacy document as a document of version 1. `None` for modules that are not raised.
fn raise(kind: ModuleKind, document: &Value) -> Option<Value> {
    let complete: fn(&mut Value) = match kind {
        ModuleKind::Urdf => urdf,
        ModuleKind::Dof => |module| {
            add(module, json!({ "joint_idx_to_mimic_mapping": [], "dofs": [] }));
        },
        ModuleKind::Chain => |module| {
            let origin = json!({ "position": [0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0] });
            for joint in list(module, "joints_in_chain") {
                add(joint, json!({ "joint_type": "Fixed", "origin": origin, "axis": null }));
            }
        },
        ModuleKind::Connections => |module| {
            let without = json!({ "root_paths": [], "lowest_common_ancestors": [], "link_to_link_paths": null });
            add(module, without);
        },
        ModuleKind::Bounds => |module| {
            let without =
                json!({ "dof_limited": [], "dof_velocity_limits": [], "dof_effort_limits": [] });
            add(module, without);
        },
        ModuleKind::LinkShapesApproximations => |module| {
            list(module, "full_bounding_spheres").for_each(sphere);
            let links = list(module, "decomposition_bounding_spheres");
            links.filter_map(Value::as_array_mut).flatten().for_each(sphere);
        },
        ModuleKind::LinkShapesMaxDistanceFromOrigin => |_| {},
        _ => return None,
    };
    let mut raised = document.clone();
    complete(&mut raised);
    Some(raised)
}

/// Adds members to an object, or replaces them.
fn add(object: &mut Value, members: Value) {
    if let (Value::Object(object), Value::Object(members)) = (object, members) {
        object.extend(members);
    }
}

/// The elements of a list.
fn list<'a>(object: &'a mut Value, key: &str) -> impl Iterator<Item = &'a mut Value> {
    object.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten()
}

/// Removes the rotation of a sphere, which has no meaning.
fn sphere(sphere: &mut Value) {
    if let Some(sphere) = sphere.as_object_mut() {
        sphere.shift_remove("offset_rpy");
    }
}

/// Legacy modules write zeros for missing masses and limits; these become null.
fn urdf(robot: &mut Value) {
    let are_zero = |object: &Value, keys: &[&str]| keys.iter().all(|key| object[*key] == 0.0);
    let origin = |element: &mut Value| {
        if let Some(origin) = element.get_mut("origin") {
            add(origin, json!({ "quat_xyzw": null }));
        }
    };
    add(robot, json!({ "version": null, "unknown_elements": [] }));
    for link in list(robot, "links") {
        add(link, json!({ "unknown_elements": [] }));
        list(link, "visual").for_each(origin);
        list(link, "collision").for_each(origin);
        let inertial = &link["inertial"];
        if are_zero(&inertial["mass"], &["value"])
            && are_zero(&inertial["inertia"], &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"])
        {
            add(link, json!({ "inertial": null }));
        } else if let Some(inertial) = link.get_mut("inertial") {
            origin(inertial);
        }
    }
    for joint in list(robot, "joints") {
        add(joint, json!({ "calibration": null, "unknown_elements": [] }));
        origin(joint);
        if are_zero(&joint["limit"], &["lower", "upper", "effort", "velocity"]) {
            add(joint, json!({ "limit": null }));
        } else if let Some(limit) = joint.get_mut("limit") {
            add(limit, json!({ "acceleration": null, "deceleration": null, "jerk": null }));
        }
    }
}

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
