//! A field of a document, and a change of one of its values.

use serde_json::Value;

use super::dice::Dice;
use super::edit::Edit;
use super::free::Ground;
use super::original::{Document, Original};

/// How many places are looked at for another value: where very many are equal, most are.
const PLACES_LOOKED_AT: usize = 500;

/// A field of a document, with all of its places.
pub(crate) struct Field<'a> {
    pub original: &'a Original,
    pub document: &'a Document,
    pub field: &'a str,
    pub places: &'a [String],
    /// What the schema says of it.
    pub schema: Vec<&'a Value>,
}

/// A change of one value.
pub(crate) struct ValueChange {
    /// What kind of change it is.
    pub kind: &'static str,
    /// The edits that make it.
    pub edits: Vec<Edit>,
}

impl<'a> Field<'a> {
    /// What applies to numbers here.
    pub(crate) fn ground(&self) -> Ground<'a> {
        Ground {
            module: &self.document.name,
            field: self.field,
            reach: self.original.reach,
            shapes: self.original.shapes,
        }
    }

    /// The value at a place.
    pub(crate) fn at(&self, place: &str) -> &'a Value {
        self.document.value.pointer(place).unwrap_or(&Value::Null)
    }

    /// A value of this field at another place that differs from this one, and its place.
    pub(crate) fn another(
        &self,
        value: &Value,
        dice: &mut Dice,
        fits: impl Fn(&Value) -> bool,
    ) -> Option<(&'a str, &'a Value)> {
        let start = dice.below(self.places.len());
        let places: &'a [String] = self.places;
        let around = places[start..].iter().chain(&places[..start]);
        around
            .take(PLACES_LOOKED_AT)
            .map(|place| (place.as_str(), self.at(place)))
            .find(|(_, other)| fits(other) && self.ground().differs(value, other))
    }
}
