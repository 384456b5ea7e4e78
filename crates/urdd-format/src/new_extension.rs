//! A first extension, for its author to change: a schema with annotations (SPEC 11.3), and a document that fits it.

use serde_json::{Value, json};

/// The files of an extension, but `VERSION`.
#[derive(Debug, Clone, PartialEq)]
pub struct NewExtension {
    /// `schema.json`.
    pub schema: Value,
    /// `module.json`.
    pub document: Value,
}

/// Version of a new extension.
pub const VERSION: &str = "1.0.0";

/// The extension of a module folder such as `x_acme_gripper_module`. Its list over joints has a value for each of
/// `joints`, and is null where their number is not known.
pub fn new_extension(folder: &str, joints: Option<usize>) -> NewExtension {
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": folder,
        "description": "What the extension is about, and who needs it.",
        "type": "object",
        "properties": {
            "link_idx": {
                "description": "The link that the tool is mounted on.",
                "x-index": "link",
                "type": "integer",
                "minimum": 0,
            },
            "tool_point": {
                "description": "Where the tool works: x, y, z.",
                "x-unit": "m",
                "x-frame": "link",
                "type": "array",
                "items": { "type": "number" },
                "minItems": 3,
                "maxItems": 3,
            },
            "joint_stiffness": {
                "description": "For each joint, its stiffness; null where it is not known.",
                "x-unit": "N*m/rad or N/m",
                "x-length": "joints",
                "type": ["array", "null"],
                "items": { "type": ["number", "null"], "minimum": 0 },
            },
        },
        "required": ["link_idx", "tool_point", "joint_stiffness"],
        "additionalProperties": false,
    });
    let document = json!({
        "link_idx": 0,
        "tool_point": [0.0, 0.0, 0.1],
        "joint_stiffness": joints.map(|joints| vec![Value::Null; joints]),
    });
    NewExtension { schema, document }
}
