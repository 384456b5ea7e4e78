//! Mutations of a list: its order and its length.

use serde_json::Value;

use super::field::Field;
use super::schema;

/// Mutations of a list.
pub(crate) fn lists(field: &Field, list: &[Value]) -> Vec<(&'static str, Value)> {
    let mut to: Vec<(&'static str, Vec<Value>)> = Vec::new();
    let mut add = |kind: &'static str, change: &dyn Fn(&mut Vec<Value>)| {
        let mut changed = list.to_vec();
        change(&mut changed);
        to.push((kind, changed));
    };
    let length = list.len();
    match list {
        [] => {
            let inside = format!("{}/*", field.field);
            let document = field.document;
            let parts = schema::of_field(&document.schema, &inside);
            if let Some(example) = schema::example(&document.schema, &parts) {
                add("an element for none", &|list| list.push(example.clone()));
            }
        }
        [first, .., last] => {
            add("its ends exchanged", &|list| list.swap(0, length - 1));
            add("its last two exchanged", &|list| list.swap(length - 2, length - 1));
            add("its first repeated", &|list| list.insert(1, first.clone()));
            add("its last repeated", &|list| list.push(last.clone()));
            add("its first instead of its last", &|list| list[length - 1] = first.clone());
        }
        [only] => add("its last repeated", &|list| list.push(only.clone())),
    }
    if length > 0 {
        add("its first left out", &|list| drop(list.remove(0)));
        add("its last left out", &|list| list.truncate(length - 1));
        add("none left", &|list| list.clear());
    }
    to.into_iter().map(|(kind, list)| (kind, Value::Array(list))).collect()
}

/// The transposed place of an off-diagonal value, if it is in a symmetric matrix larger than 3×3.
pub(crate) fn mirrored(document: &Value, place: &str) -> Option<String> {
    let mut parts = place.rsplitn(3, '/');
    let (column, row, matrix) = (parts.next()?, parts.next()?, parts.next()?);
    let (i, j): (usize, usize) = (row.parse().ok()?, column.parse().ok()?);
    let rows = document.pointer(matrix)?.as_array()?;
    let at = |i: usize, j: usize| rows.get(i)?.as_array()?.get(j);
    let square = rows.iter().all(|row| row.as_array().is_some_and(|row| row.len() == rows.len()));
    let symmetric = || (0..rows.len()).all(|i| (0..i).all(|j| at(i, j) == at(j, i)));
    (i != j && rows.len() > 3 && square && symmetric()).then(|| format!("{matrix}/{j}/{i}"))
}
