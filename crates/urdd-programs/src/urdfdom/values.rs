//! Attributes, elements and numbers as urdfdom needs them.

use crate::prelude::*;

/// A part that may be faulty: where, and why.
pub(super) type PartRead<T> = Result<T, (usize, Fault)>;

pub(super) fn needed<'t>(node: Node<'t>, name: &'static str) -> PartRead<&'t Attribute<'t>> {
    node.attribute(name).ok_or((node.start(), Fault::Missing(name)))
}

pub(super) fn needed_element<'t>(node: Node<'t>, name: &'static str) -> PartRead<Node<'t>> {
    node.child(name).ok_or((node.start(), Fault::MissingElement(name)))
}

/// A number without anything behind it.
pub(super) fn number(value: &Attribute<'_>) -> PartRead<f64> {
    let read = whole(istream(&value.value));
    read.ok_or_else(|| (value.at(), Fault::not_a_number(value)))
}

/// Numbers that may be left out.
pub(super) fn numbers(node: Node<'_>, names: &[&str]) -> PartRead<()> {
    names
        .iter()
        .filter_map(|name| node.attribute(name))
        .try_for_each(|value| number(value).map(|_| ()))
}

/// Numbers with spaces, and nothing else, between them.
pub(super) fn vector(value: &Attribute<'_>, count: usize) -> PartRead<Vec<f64>> {
    let numbers: Option<Vec<f64>> =
        pieces(&value.value).map(|piece| whole(istream(piece))).collect();
    match numbers {
        None => Err((value.at(), Fault::not_a_number(value))),
        Some(numbers) if numbers.len() != count => Err((value.at(), Fault::count(value, count))),
        Some(numbers) => Ok(numbers),
    }
}
