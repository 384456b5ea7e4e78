//! What may not be in the schema of an extension, wherever it is.

use serde_json::Value;

use super::schema_work::schemas_in;
use urdd_format::annotations;

pub struct SchemaFault {
    /// JSON Pointer into the schema.
    pub pointer: String,
    pub message: String,
}

/// References that leave the schema's own file, constructs that would make references ambiguous, and annotations that
/// are not defined.
pub fn faults_of_parts(schema: &Value) -> Vec<SchemaFault> {
    let mut faults = Vec::new();
    let mut open = vec![(String::new(), schema)];
    while let Some((pointer, schema)) = open.pop() {
        for key in ["$ref", "$dynamicRef"] {
            if let Some(target) = schema.get(key).and_then(Value::as_str)
                && !target.starts_with('#')
            {
                let shown: String = target.chars().take(80).collect();
                faults.push(SchemaFault {
                    pointer: format!("{pointer}/{key}"),
                    message: format!(
                        "`{shown}` leads out of this file, and nothing else is opened: put what it names into `$defs`, and refer to it by `#/$defs/...`"
                    ),
                });
            }
        }
        for fault in schema.as_object().map(annotations::faults).unwrap_or_default() {
            faults.push(SchemaFault {
                pointer: format!("{pointer}/{}", fault.keyword),
                message: fault.to_string(),
            });
        }
        if !pointer.is_empty() && schema.get("$id").is_some() {
            faults.push(SchemaFault {
                pointer: format!("{pointer}/$id"),
                message: "only the schema itself may have an `$id`: take this one out, and refer to the part by `#/$defs/...`".to_owned(),
            });
        }
        open.extend(
            schemas_in(schema).map(|(inner, schema, _)| (pointer.clone() + &inner, schema)),
        );
        let definitions = schema.get("$defs").and_then(Value::as_object);
        for (name, schema) in definitions.into_iter().flatten() {
            let name = name.replace('~', "~0").replace('/', "~1");
            open.push((format!("{pointer}/$defs/{name}"), schema));
        }
    }
    faults.sort_by(|a, b| a.pointer.cmp(&b.pointer));
    faults
}
