//! Reads the document of a module: checks it against its schema, and raises a legacy one to version 1, so that programs see
//! one format. Recognises documents of the format drafts that program versions 0.1.0 and 0.2.0 wrote under the same module
//! versions (SPEC 4.4).
//!
//! serde accepts exactly what the schema accepts (a property test verifies this), so serde reads valid documents,
//! quickly. Only invalid ones go to the schema validator, which reports every violation with its position.
//!
//! What a legacy module does not state becomes null or an empty list; [`crate::consumer`] fills in the joints of
//! `chain_module` from the robot. All other values keep their JSON Pointers. Mesh modules and matrices over shapes are
//! not raised: their keys differ.

use std::error::Error;

use jsonschema::error::{TypeKind, ValidationErrorKind};
use jsonschema::paths::Location;
use jsonschema::{JsonType, ValidationError};
use schemars::Schema;
use serde_json::{Value, json};

use urdd_directory::json_scan;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::registry::{ModuleDocument, ModuleKind, ModuleSpec, Profile, modules};
use urdd_format::self_collision_model::ModelEvaluation;
use urdd_format::short::cut;

/// Maximum length of a value in a message, in characters.
const LONGEST: usize = 80;

/// A schema violation.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SchemaViolation {
    /// JSON Pointer of the value.
    pub pointer: String,
    /// What is wrong.
    pub message: String,
    /// The expected content.
    pub expected: Option<String>,
    /// The actual content.
    pub actual: Option<String>,
    /// The unknown keys, if that is the fault.
    unknown_keys: Vec<String>,
}

impl SchemaViolation {
    /// JSON Pointer to the fault itself: to the unknown key rather than its object.
    pub fn place(&self) -> String {
        let mut pointer = self.pointer.clone();
        if let Some(key) = self.unknown_keys.first() {
            json_scan::push_segment(&mut pointer, key);
        }
        pointer
    }
}

/// Reads a document of a module, or returns its schema violations. With `newer`, ignores unknown keys: the document is
/// of a later minor version.
pub fn read(
    spec: &ModuleSpec,
    document: &Value,
    newer: bool,
) -> (Option<ModuleDocument>, Vec<SchemaViolation>) {
    let error = match read_raised(spec, document) {
        Ok(document) => return (Some(document), Vec::new()),
        Err(error) => error,
    };
    read_newer(&spec.schema(), document, newer, &error, |known| spec.read(known).ok())
}

/// Handles a document that serde rejected with `refusal`. If it is of a later minor version (`newer`) and its only
/// violations are unknown keys, reads it without them. Otherwise returns the violations (with `newer`, except unknown
/// keys).
pub fn read_newer<T>(
    schema: &Schema,
    document: &Value,
    newer: bool,
    refusal: &dyn Error,
    read: impl FnOnce(&Value) -> Option<T>,
) -> (Option<T>, Vec<SchemaViolation>) {
    let found = violations(schema, document, refusal);
    if !newer {
        return (None, found);
    }
    let (unknown, others): (Vec<_>, Vec<_>) =
        found.into_iter().partition(|v| !v.unknown_keys.is_empty());
    if !others.is_empty() {
        return (None, others);
    }
    let mut known = document.clone();
    for violation in &unknown {
        let object = known.pointer_mut(&violation.pointer).and_then(Value::as_object_mut);
        if let Some(object) = object {
            object.retain(|key, _| !violation.unknown_keys.contains(key));
        }
    }
    (read(&known), Vec::new())
}

/// Every schema violation of a document. If the schema reports none, returns `refusal`, serde's error, so that an
/// unreadable document never passes.
pub fn violations(schema: &Schema, document: &Value, refusal: &dyn Error) -> Vec<SchemaViolation> {
    let whole = |message: String| SchemaViolation { message, ..SchemaViolation::default() };
    let mut found = Vec::new();
    match jsonschema::draft202012::new(schema.as_value()) {
        Ok(validator) => {
            for error in validator.iter_errors(document) {
                describe(&error, &mut found);
            }
        }
        Err(error) => found.push(whole(format!("the schema cannot be used: {error}"))),
    }
    if found.is_empty() {
        found.push(whole(format!("the document cannot be read: {refusal}")));
    }
    found
}

fn describe(error: &ValidationError<'_>, found: &mut Vec<SchemaViolation>) {
    use ValidationErrorKind as Kind;
    let instance = error.instance().as_ref();
    // A choice only reports that no alternative matches. Report why the nearest one does not.
    if let Kind::AnyOf { context } | Kind::OneOfNotValid { context } = error.kind()
        && let Some(nearest) = nearest_alternative(error.instance_path(), context)
    {
        for inner in nearest {
            describe(inner, found);
        }
        return;
    }
    let actual = || Some(excerpt(instance));
    let length = |expected| {
        let elements = instance.as_array().map(|list| format!("{} elements", list.len()));
        ("the list has the wrong length".to_owned(), Some(expected), elements)
    };
    let mut unknown_keys = Vec::new();
    let (message, expected, actual) = match error.kind() {
        Kind::Required { property } => {
            let key = property.as_str().unwrap_or_default();
            let message = format!(
                "the key `{key}` is missing; every key is required: where the schema allows null, that is an absent value"
            );
            (message, Some(format!("key {key}")), None)
        }
        Kind::AdditionalProperties { unexpected } => {
            unknown_keys.clone_from(unexpected);
            let message = format!(
                "unknown {}: {}; keys of your own begin with `x_`",
                if unexpected.len() == 1 { "key" } else { "keys" },
                unexpected.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", "),
            );
            (message, None, None)
        }
        Kind::Type { kind } => {
            let expected = match kind {
                TypeKind::Single(kind) => kind.to_string(),
                TypeKind::Multiple(kinds) => {
                    kinds.iter().map(|k| k.to_string()).collect::<Vec<_>>().join(" or ")
                }
            };
            let message = format!("the value has the wrong type: expected {expected}");
            (message, Some(expected), actual())
        }
        Kind::Enum { options } => (
            "the word is not one of the defined ones".to_owned(),
            Some(format!("one of {}", excerpt(options))),
            actual(),
        ),
        Kind::MinItems { limit } => length(format!("at least {limit} elements")),
        Kind::MaxItems { limit } => length(format!("at most {limit} elements")),
        Kind::Minimum { limit } => {
            ("the number is too small".to_owned(), Some(format!("at least {limit}")), actual())
        }
        Kind::Maximum { limit } => {
            ("the number is too large".to_owned(), Some(format!("at most {limit}")), actual())
        }
        Kind::Pattern { pattern } => (
            "the text does not have the required form".to_owned(),
            Some(format!("text matching {pattern}")),
            actual(),
        ),
        _ => {
            let masked = error.masked().to_string();
            let masked = cut(&masked, LONGEST);
            (format!("the value does not match the schema: {masked}"), None, actual())
        }
    };
    let pointer = error.instance_path().to_string();
    found.push(SchemaViolation { pointer, message, expected, actual, unknown_keys });
}

/// The alternative of a choice at `path` that the instance means: the other one of a nullable value, or the one-key
/// object whose key the instance has.
fn nearest_alternative<'a>(
    path: &Location,
    context: &'a [Vec<ValidationError<'static>>],
) -> Option<&'a Vec<ValidationError<'static>>> {
    let is_null = |errors: &&Vec<ValidationError<'static>>| {
        errors.iter().any(|error| {
            matches!(
                error.kind(),
                ValidationErrorKind::Type { kind: TypeKind::Single(JsonType::Null) }
            )
        })
    };
    let other_key = |errors: &&Vec<ValidationError<'static>>| {
        errors.iter().any(|error| {
            error.instance_path() == path
                && matches!(error.kind(), ValidationErrorKind::Required { .. })
        })
    };
    if context.len() == 2 && context.iter().any(|errors| is_null(&errors)) {
        return context.iter().find(|errors| !is_null(errors));
    }
    context.iter().find(|errors| !errors.is_empty() && !other_key(errors))
}

/// A value as text, shortened to fit a line.
pub fn excerpt(value: &Value) -> String {
    cut(&value.to_string(), LONGEST).into_owned()
}

/// Reads a document of a module, and raises it.
fn read_raised(spec: &ModuleSpec, document: &Value) -> Result<ModuleDocument, serde_json::Error> {
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
pub(crate) fn is_draft(spec: &ModuleSpec, document: &Value) -> bool {
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
