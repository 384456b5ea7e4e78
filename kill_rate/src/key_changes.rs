//! Mutations of an object's keys.

use serde_json::{Map, Value};

use super::dice::Dice;
use super::edit::Edit;
use super::field::{Field, ValueChange};
use super::free::{self, Ground};
use super::pointer::{escape, is_field};
use super::schema;
use super::text_changes;

/// Mutations of an object, each of one randomly drawn key.
pub(crate) fn keys(
    field: &Field,
    place: &str,
    object: &Map<String, Value>,
    dice: &mut Dice,
) -> Vec<ValueChange> {
    let below = |key: &str| format!("{}/{}", field.field, escape(key));
    let keys: Vec<&String> = object
        .keys()
        .filter(|key| is_field(key) && !free::is_free(&field.document.name, &below(key)))
        .collect();
    let mut out = Vec::new();
    let mut add = |kind: &'static str, edits: Vec<Edit>| out.push(ValueChange { kind, edits });
    add("a key added", vec![Edit::Add(place.to_owned(), "added".to_owned())]);
    if keys.is_empty() {
        return out;
    }
    let pointer = |key: &str| format!("{place}/{}", escape(key));
    let key = keys[dice.below(keys.len())];
    add("a key left out", vec![Edit::Remove(pointer(key))]);
    let key = keys[dice.below(keys.len())];
    add("a key twice", vec![Edit::Double(pointer(key))]);
    let key = keys[dice.below(keys.len())];
    for (kind, spelled) in text_changes::spellings(key, dice) {
        let kind = match kind {
            "a letter changed" => "a key's letter changed",
            "a letter's case changed" => "a key's case changed",
            _ => continue,
        };
        if !object.contains_key(&spelled) {
            add(kind, vec![Edit::Rename(pointer(key), spelled)]);
        }
    }
    if let [only] = keys[..] {
        for tag in schema::tags(&field.schema) {
            if tag != only {
                add("another tag", vec![Edit::Rename(pointer(only), tag.to_owned())]);
            }
        }
    }
    let (a, b) = (keys[dice.below(keys.len())], keys[dice.below(keys.len())]);
    let within = below(a);
    let ground = Ground { field: &within, ..field.ground() };
    if ground.differs(&object[a], &object[b]) {
        let edits = vec![
            Edit::Set(pointer(a), object[b].clone()),
            Edit::Set(pointer(b), object[a].clone()),
        ];
        add("two keys' values exchanged", edits);
    }
    out
}
