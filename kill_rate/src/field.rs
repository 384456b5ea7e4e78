//! A field of a document, and a mutation of one of its values.

use serde_json::Value;

use super::dice::Dice;
use super::edit::Edit;
use super::free::Ground;
use super::original::{Document, Original};

/// Limit of the search for a different value: if very many places exist, most have equal values.
const PLACES_LOOKED_AT: usize = 500;

/// A field of a document, with all its places.
pub(crate) struct Field<'a> {
    pub original: &'a Original,
    pub document: &'a Document,
    pub field: &'a str,
    pub places: &'a [String],
    /// The subschemas that apply to it.
    pub schema: Vec<&'a Value>,
}

/// A mutation of one value.
pub(crate) struct ValueChange {
    /// Kind of mutation.
    pub kind: &'static str,
    /// The edits to apply.
    pub edits: Vec<Edit>,
}

impl<'a> Field<'a> {
    /// The location that determines the tolerance of numbers.
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

    /// A different value of this field at another place, with that place.
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
