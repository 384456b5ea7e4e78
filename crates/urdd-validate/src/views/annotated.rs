//! `x-index` and `x-length` as keywords that assert something (SPEC 11.5): the schema library decides where they apply,
//! and the counts of links, joints, DOFs and so on by which they are judged.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use jsonschema::{Keyword, ValidationError, ValidationOptions};
use serde_json::{Map, Value};

use crate::context::Context;
use urdd_document::robot::Link;
use urdd_format::annotations::{self, INDEX, LENGTH, Thing};
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// One of the two keywords that are judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judged {
    Index,
    Length,
}

impl Judged {
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
            Judged::Index => {
                let things = annotations::of_index(text).unwrap_or_else(|| vec![Thing::Other]);
                let fault = move |value: &Value| index_fault(&things, &counts, value);
                Box::new(Asserted(fault)) as Box<dyn for<'n> Keyword<'n>>
            }
            Judged::Length => {
                let things = annotations::of_length(text).unwrap_or_default();
                let pieces_from = pieces_inside(schema).filter(|_| things == [Thing::Link]);
                Box::new(Asserted(move |value: &Value| {
                    length_fault(&things, pieces_from, &counts, value.as_array()?)
                }))
            }
        })
    })
}

/// A keyword whose function describes what is wrong with a value.
struct Asserted<F>(F);

impl<'i, F: Fn(&Value) -> Option<String> + Send + Sync> Keyword<'i> for Asserted<F> {
    fn validate(&self, instance: &'i Value) -> Result<(), ValidationError<'i>> {
        self.0(instance).map_or(Ok(()), |fault| Err(ValidationError::custom(fault)))
    }

    fn is_valid(&self, instance: &'i Value) -> bool {
        self.0(instance).is_none()
    }
}

/// From which element on the elements of a list are lists over the pieces of one link each: `items` does not describe
/// those that `prefixItems` does.
fn pieces_inside(schema: &Map<String, Value>) -> Option<usize> {
    let inside = schema.get("items").and_then(|items| items.get(LENGTH));
    let things = inside.and_then(Value::as_str).and_then(annotations::of_length)?;
    let first = schema.get("prefixItems").and_then(Value::as_array).map_or(0, Vec::len);
    (things == [Thing::Piece]).then_some(first)
}

/// What is wrong with an index of one of the things; `None` if it is below their number, or is not a number.
fn index_fault(things: &[Thing], counts: &Counts, value: &Value) -> Option<String> {
    let Value::Number(number) = value else { return None };
    let whole = |number: &f64| number.fract() == 0.0 && *number >= 0.0;
    // As an integer: a large one is the largest.
    let index = number.as_u64().or_else(|| Some(number.as_f64().filter(whole)? as u64));
    let below = |thing: &Thing| {
        index.is_some_and(|index| counts.below(*thing).is_none_or(|end| index < end))
    };
    if things.iter().any(below) {
        return None;
    }
    let of_thing = |thing: &Thing| {
        let word = thing.index();
        match counts.below(*thing) {
            Some(0) => format!("{word} (there is none)"),
            Some(1) => format!("{word} (only 0)"),
            Some(end) => format!("{word} (0 to {})", end - 1),
            None => word.to_owned(),
        }
    };
    let all: Vec<String> = things.iter().map(of_thing).collect();
    Some(format!("`{INDEX}` of schema.json asks for the index of a {}", all.join(" or ")))
}

/// What is wrong with the length of a list, or of its element i, from `pieces_from` on a list over the pieces
/// of link i.
fn length_fault(
    things: &[Thing],
    pieces_from: Option<usize>,
    counts: &Counts,
    list: &[Value],
) -> Option<String> {
    let length = list.len();
    let fits = |thing: &Thing| match thing {
        Thing::Piece => {
            counts.pieces.as_ref().is_none_or(|pieces| pieces.numbers.contains(&length))
        }
        thing => counts.count(*thing).is_none_or(|count| count == length),
    };
    if !things.is_empty() && !things.iter().any(fits) {
        let of_thing = |thing: &Thing| match counts.count(*thing) {
            Some(count) => format!("{count} ({})", thing.length().unwrap_or_default()),
            None => "as many as a link has pieces".to_owned(),
        };
        let all: Vec<String> = things.iter().map(of_thing).collect();
        let all = all.join(" or ");
        return Some(format!(
            "`{LENGTH}` of schema.json asks for a list of {all}, and this has {length}"
        ));
    }
    let (first, pieces) = (pieces_from?, counts.pieces.as_ref()?);
    let lists = list.iter().map(Value::as_array).zip(&pieces.of_link).enumerate().skip(first);
    let mut wrong = lists.filter_map(|(link, (inside, pieces))| {
        let length = inside?.len();
        (length != *pieces).then_some((link, length, pieces))
    });
    let (link, length, pieces) = wrong.next()?;
    Some(format!(
        "`{LENGTH}` of schema.json asks for a list of {pieces} (pieces of link {link}) as element {link}, and this has {length}"
    ))
}

/// The number of each thing that the URDD says.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Counts {
    /// Of visual and collision elements: the largest number of a link.
    of: BTreeMap<Thing, usize>,
    /// The convex pieces, if the URDD has them.
    pub pieces: Option<Pieces>,
}

/// The convex pieces. What a hostile document asks for often is computed once.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Pieces {
    /// The number of pieces of each link.
    pub of_link: Vec<usize>,
    /// The same numbers, each once.
    pub numbers: BTreeSet<usize>,
}

impl Counts {
    pub fn of(context: &Context) -> Counts {
        let robot = context.robot();
        let most = |count: fn(&Link) -> usize| {
            robot.map(|robot| robot.links.iter().map(count).max().unwrap_or(0))
        };
        let meshes = |kind| {
            let meshes = context.meshes(kind)?;
            Some((0..meshes.num_links()).map(|link| meshes.count(link)).collect::<Vec<_>>())
        };
        let hulls = meshes(ModuleKind::ConvexHullMeshes);
        let pieces = meshes(ModuleKind::ConvexDecompositionMeshes);
        let parts = match context.document(ModuleKind::Composition) {
            Some(ModuleDocument::Composition(module)) => Some(module.parts.len()),
            _ => None,
        };
        let pairs = match context.document(ModuleKind::SelfCollisionModel) {
            Some(ModuleDocument::SelfCollisionModel(module)) => Some(module.pairs.len()),
            _ => None,
        };
        let all = [
            (Thing::Link, robot.map(|robot| robot.links.len())),
            (Thing::Joint, robot.map(|robot| robot.joints.len())),
            (Thing::Dof, context.dofs().map(|dofs| dofs.num_dofs.get())),
            (Thing::Visual, most(|link| link.visual.len())),
            (Thing::Collision, most(|link| link.collision.len())),
            (Thing::FullShape, hulls.map(|of| of.iter().filter(|count| **count > 0).count())),
            (Thing::DecompositionShape, pieces.as_ref().map(|of_link| of_link.iter().sum())),
            (Thing::Part, parts),
            (Thing::Pair, pairs),
        ];
        Counts {
            of: all.into_iter().filter_map(|(thing, count)| Some((thing, count?))).collect(),
            pieces: pieces
                .map(|of_link| Pieces { numbers: of_link.iter().copied().collect(), of_link }),
        }
    }

    /// What an index of a thing must be below; `None` where nothing limits it.
    pub fn below(&self, thing: Thing) -> Option<u64> {
        let count = match thing {
            Thing::Piece => self.pieces.as_ref()?.numbers.last().copied().unwrap_or(0),
            Thing::Sample => return Some(1 << 32),
            thing => *self.of.get(&thing)?,
        };
        Some(count as u64)
    }

    /// The length of a list with an element for each of a thing; `None` where nothing decides it, or (pieces) the link.
    pub fn count(&self, thing: Thing) -> Option<usize> {
        let is_counted = !matches!(thing, Thing::Visual | Thing::Collision);
        self.of.get(&thing).copied().filter(|_| is_counted)
    }
}
