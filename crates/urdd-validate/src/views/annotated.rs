//! `x-index` and `x-length` as keywords that assert something (SPEC 11.5): the schema library decides where they apply.

use std::sync::Arc;

use jsonschema::{Keyword, ValidationError, ValidationOptions};
use serde_json::{Map, Value};

use super::counts::Counts;
use urdd_format::annotations::{self, INDEX, LENGTH, Thing};

/// One of the two keywords that are judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judged {
    /// `x-index`.
    Index,
    /// `x-length`.
    Length,
}

impl Judged {
    /// The keyword.
    pub fn keyword(self) -> &'static str {
        match self {
            Judged::Index => INDEX,
            Judged::Length => LENGTH,
        }
    }
}

/// Options with which the keyword is judged by the counts. A value of the keyword that is not defined says nothing:
/// EXT001 reports it.
pub fn judging<'i>(
    options: ValidationOptions<'i>,
    judged: Judged,
    counts: Arc<Counts>,
) -> ValidationOptions<'i> {
    options.with_keyword(judged.keyword(), move |schema, value, _| {
        let counts = Arc::clone(&counts);
        let text = value.as_str().unwrap_or_default();
        Ok(match judged {
            Judged::Index => Box::new(IndexOf {
                things: annotations::of_index(text).unwrap_or_else(|| vec![Thing::Other]),
                counts,
            }) as Box<dyn for<'n> Keyword<'n>>,
            Judged::Length => {
                let things = annotations::of_length(text).unwrap_or_default();
                Box::new(LengthOf {
                    pieces_inside: things == [Thing::Link] && has_pieces_inside(schema),
                    things,
                    counts,
                })
            }
        })
    })
}

/// Whether the elements of a list are lists over the pieces of one link each.
fn has_pieces_inside(schema: &Map<String, Value>) -> bool {
    let inside = schema.get("items").and_then(|items| items.get(LENGTH));
    let things = inside.and_then(Value::as_str).and_then(annotations::of_length);
    things.is_some_and(|things| things == [Thing::Piece])
}

struct IndexOf {
    things: Vec<Thing>,
    counts: Arc<Counts>,
}

impl IndexOf {
    /// Whether it is an integer in a range, or is not a number.
    fn fits(&self, value: &Value) -> bool {
        let Value::Number(number) = value else {
            return true;
        };
        let whole = |number: &f64| number.fract() == 0.0 && *number >= 0.0;
        // As an integer: a large one is the largest.
        let fraction = || number.as_f64().filter(whole);
        let Some(index) = number.as_u64().or_else(|| Some(fraction()? as u64)) else {
            return false;
        };
        (self.things.iter()).any(|thing| self.counts.below(*thing).is_none_or(|end| index < end))
    }

    fn fault(&self) -> String {
        let of_thing = |thing: &Thing| {
            let word = thing.index();
            match self.counts.below(*thing) {
                Some(0) => format!("{word} (there is none)"),
                Some(1) => format!("{word} (only 0)"),
                Some(end) => format!("{word} (0 to {})", end - 1),
                None => word.to_owned(),
            }
        };
        let all: Vec<String> = self.things.iter().map(of_thing).collect();
        format!("`{INDEX}` of schema.json asks for the index of a {}", all.join(" or "))
    }
}

impl<'i> Keyword<'i> for IndexOf {
    fn validate(&self, instance: &'i Value) -> Result<(), ValidationError<'i>> {
        if self.fits(instance) { Ok(()) } else { Err(ValidationError::custom(self.fault())) }
    }

    fn is_valid(&self, instance: &'i Value) -> bool {
        self.fits(instance)
    }
}

struct LengthOf {
    things: Vec<Thing>,
    /// Whether element i is a list over the pieces of link i.
    pieces_inside: bool,
    counts: Arc<Counts>,
}

impl LengthOf {
    fn fits(&self, length: usize) -> bool {
        self.things.is_empty()
            || self.things.iter().any(|thing| match thing {
                Thing::Piece => (self.counts.pieces.as_ref())
                    .is_none_or(|pieces| pieces.numbers.contains(&length)),
                thing => (self.counts.count(*thing)).is_none_or(|count| count == length),
            })
    }

    fn fault(&self, list: &[Value]) -> Option<String> {
        let length = list.len();
        if !self.fits(length) {
            let of_thing = |thing: &Thing| match self.counts.count(*thing) {
                Some(count) => format!("{count} ({})", thing.length().unwrap_or_default()),
                None => "as many as a link has pieces".to_owned(),
            };
            let all: Vec<String> = self.things.iter().map(of_thing).collect();
            let all = all.join(" or ");
            return Some(format!(
                "`{LENGTH}` of schema.json asks for a list of {all}, and this has {length}"
            ));
        }
        let pieces = self.counts.pieces.as_ref().filter(|_| self.pieces_inside)?;
        let lists = list.iter().map(Value::as_array).zip(&pieces.of_link).enumerate();
        let mut wrong = lists.filter_map(|(link, (inside, pieces))| {
            let length = inside?.len();
            (length != *pieces).then_some((link, length, pieces))
        });
        let (link, length, pieces) = wrong.next()?;
        Some(format!(
            "`{LENGTH}` of schema.json asks for a list of {pieces} (pieces of link {link}) as element {link}, and this has {length}"
        ))
    }
}

impl<'i> Keyword<'i> for LengthOf {
    fn validate(&self, instance: &'i Value) -> Result<(), ValidationError<'i>> {
        let fault = instance.as_array().and_then(|list| self.fault(list));
        fault.map_or(Ok(()), |fault| Err(ValidationError::custom(fault)))
    }

    fn is_valid(&self, instance: &'i Value) -> bool {
        let list = instance.as_array();
        list.is_none_or(|list| self.fault(list).is_none())
    }
}
