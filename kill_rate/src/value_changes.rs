//! Mutations of one value of a document.

use serde_json::{Value, json};

use super::dice::Dice;
use super::edit::Edit;
use super::field::{Field, ValueChange};
use super::free;
use super::{key_changes, list_changes, number_changes, schema, text_changes};

/// Every mutation of the value at a place.
pub(crate) fn changes(field: &Field, place: &str, dice: &mut Dice) -> Vec<ValueChange> {
    let value = field.at(place);
    let mut to: Vec<(&'static str, Value)> = Vec::new();
    let mut out = Vec::new();
    match value {
        Value::Null => {
            if let Some((_, other)) = field.another(value, dice, |other| !other.is_null()) {
                to.push(("a value for null", other.clone()));
            } else if let Some(example) = schema::example(&field.document.schema, &field.schema) {
                to.push(("a value for null", example));
            }
        }
        Value::Bool(flag) => to.push(("the other boolean", json!(!flag))),
        Value::Number(_) if schema::is_integer(&field.schema) => {
            to = number_changes::integers(field, value, dice);
        }
        Value::Number(number) => {
            to = number_changes::numbers(&field.ground(), number.as_f64().unwrap_or(0.0), dice);
        }
        Value::String(text) => to = text_changes::texts(field, text, dice),
        Value::Array(list) => to = list_changes::lists(field, list),
        Value::Object(object) => out = key_changes::keys(field, place, object, dice),
    }
    if !value.is_null() && !place.is_empty() {
        to.push(("null for a value", Value::Null));
    }
    let ground = field.ground();
    let mirrored = list_changes::mirrored(&field.document.value, place);
    for (kind, new) in to {
        if !ground.differs(value, &new)
            || free::is_permitted(ground.module, ground.field, value, &new)
        {
            continue;
        }
        let set = Edit::Set(place.to_owned(), new.clone());
        // In a symmetric matrix, also change both elements together.
        if let Some(other) = &mirrored {
            let edits = vec![set.clone(), Edit::Set(other.clone(), new)];
            out.push(ValueChange { kind: both_halves(kind), edits });
        }
        out.push(ValueChange { kind, edits: vec![set] });
    }
    let is_permitted =
        |from: &Value, to: &Value| free::is_permitted(ground.module, ground.field, from, to);
    if let Some((other_place, other)) = field.another(value, dice, |other| {
        let is_one = |value: &Value| !value.is_array() && !value.is_object();
        let is_right_too = is_permitted(value, other) && is_permitted(other, value);
        is_one(value) && is_one(other) && !is_right_too
    }) {
        let edits = vec![
            Edit::Set(place.to_owned(), other.clone()),
            Edit::Set(other_place.to_owned(), value.clone()),
        ];
        out.push(ValueChange { kind: "two places exchanged", edits });
    }
    out
}

fn both_halves(kind: &'static str) -> &'static str {
    match kind {
        "null for a value" => "null for a value, in both halves",
        "the other boolean" => "the other boolean, in both halves",
        "another word" => "another word, in both halves",
        _ => "a number, in both halves",
    }
}
