//! Queries of a published schema for a field: its words, and an example value.

use serde_json::{Map, Value, json};

/// The subschemas that may apply to a field (a choice has several).
pub(crate) fn of_field<'a>(schema: &'a Value, field: &str) -> Vec<&'a Value> {
    let mut here = branches(schema, schema);
    for part in field.split('/').skip(1) {
        let key = super::pointer::unescape(part);
        here = here
            .into_iter()
            .filter_map(|part| match key.as_str() {
                "*" => part.get("items"),
                key => part.get("properties")?.get(key),
            })
            .flat_map(|part| branches(schema, part))
            .collect();
    }
    here
}

/// Resolves references and splits choices into their alternatives.
fn branches<'a>(schema: &'a Value, part: &'a Value) -> Vec<&'a Value> {
    if let Some(name) = part.get("$ref").and_then(Value::as_str) {
        let target = name.strip_prefix('#').and_then(|pointer| schema.pointer(pointer));
        return target.map_or_else(Vec::new, |target| branches(schema, target));
    }
    let choices = ["anyOf", "oneOf"].iter().filter_map(|key| part.get(*key)?.as_array());
    let choices: Vec<&Value> = choices.flatten().collect();
    if choices.is_empty() {
        return vec![part];
    }
    choices.into_iter().flat_map(|choice| branches(schema, choice)).collect()
}

/// The allowed words of an enumeration field.
pub(crate) fn words<'a>(parts: &[&'a Value]) -> Vec<&'a str> {
    let lists = parts.iter().filter_map(|part| part.get("enum")?.as_array());
    let singles = parts.iter().filter_map(|part| part.get("const"));
    lists.flatten().chain(singles).filter_map(Value::as_str).collect()
}

/// The allowed keys of a one-key object.
pub(crate) fn tags<'a>(parts: &[&'a Value]) -> Vec<&'a str> {
    if parts.len() < 2 {
        return Vec::new();
    }
    let one_key = |part: &&'a Value| -> Option<&'a str> {
        let keys = part.get("properties")?.as_object()?;
        (keys.len() == 1).then(|| keys.keys().next().map(String::as_str))?
    };
    parts.iter().filter_map(one_key).collect()
}

/// Whether a field contains integers.
pub(crate) fn is_integer(parts: &[&Value]) -> bool {
    parts.iter().any(|part| types(part).any(|kind| kind == "integer"))
}

fn types(part: &Value) -> impl Iterator<Item = &str> {
    let one = part.get("type").and_then(Value::as_str);
    let several = part.get("type").and_then(Value::as_array);
    one.into_iter().chain(several.into_iter().flatten().filter_map(Value::as_str))
}

/// A valid value of a field other than null.
pub(crate) fn example(schema: &Value, parts: &[&Value]) -> Option<Value> {
    if let Some(word) = words(parts).first() {
        return Some(json!(word));
    }
    parts.iter().find_map(|part| {
        let inner = |part: &Value| example(schema, &branches(schema, part));
        match types(part).find(|kind| *kind != "null")? {
            "integer" => Some(json!(0)),
            "number" => Some(json!(0.5)),
            "string" => Some(json!("x")),
            "boolean" => Some(json!(true)),
            "array" => {
                let length = part.get("minItems").and_then(Value::as_u64).unwrap_or(0);
                let item = part.get("items")?;
                (0..length).map(|_| inner(item)).collect()
            }
            "object" => {
                let members = part.get("properties")?.as_object()?;
                let mut object = Map::new();
                for (key, member) in members.iter().filter(|(key, _)| super::pointer::is_field(key))
                {
                    let member = branches(schema, member);
                    let null = member.iter().any(|part| types(part).any(|kind| kind == "null"));
                    let value = match null {
                        true => Value::Null,
                        false => example(schema, &member)?,
                    };
                    object.insert(key.clone(), value);
                }
                Some(Value::Object(object))
            }
            _ => None,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use urdd_format::registry::{ModuleKind, find};

    #[test]
    fn reads_the_schema_of_a_robot() {
        let schema = find(ModuleKind::Urdf, "1.0.0").unwrap().schema().to_value();
        let of = |field: &str| of_field(&schema, field);
        assert_eq!(words(&of("/joints/*/joint_type")).len(), 7);
        assert!(words(&of("/joints/*/name")).is_empty());
        let tags = tags(&of("/links/*/visual/*/geometry"));
        assert_eq!(tags, ["Mesh", "Box", "Cylinder", "Capsule", "Sphere"]);
        let origin = of("/joints/*/origin/quat_xyzw");
        assert_eq!(example(&schema, &origin), Some(json!([0.5, 0.5, 0.5, 0.5])));
        let limit = example(&schema, &of("/joints/*/limit")).unwrap();
        assert_eq!(limit["lower"], Value::Null);
        let schema = find(ModuleKind::Dof, "1.0.0").unwrap().schema().to_value();
        assert!(is_integer(&of_field(&schema, "/joint_idx_to_mimic_mapping/*/dof_idx")));
        assert!(!is_integer(&of_field(&schema, "/joint_idx_to_mimic_mapping/*/offset")));
    }
}
