//! Checks the keys of a recipe.

use toml::de::{DeTable, DeValue};

use super::recipe_fault::RecipeFault;
use urdd_format::nearest::nearest;

const RECIPE: &[&str] = &["name", "base", "part"];
const PART: &[&str] = &["id", "source", "prefix", "drop", "freeze", "attach", "skip", "names"];
const BASE: &[&str] = &["link", "name", "joint", "xyz", "rpy", "axis", "limit"];
const ATTACH: &[&str] = &["to", "name", "joint", "xyz", "rpy", "axis", "limit"];
const LIMIT: &[&str] = &["lower", "upper", "effort", "velocity"];

type Checked = Result<(), (Option<usize>, RecipeFault)>;

/// Finds the first unknown key.
///
/// # Errors
/// The key and its byte offset, or a TOML syntax error.
pub(super) fn check(text: &str) -> Checked {
    let table = DeTable::parse(text).map_err(|error| {
        let fault = RecipeFault::Toml(error.message().to_owned());
        (error.span().map(|span| span.start), fault)
    })?;
    let table = table.get_ref();
    known(table, RECIPE)?;
    if let Some(base) = of(table, "base") {
        joint(base, BASE)?;
    }
    let parts = table.iter().find(|(key, _)| key.get_ref() == "part");
    let parts = parts.and_then(|(_, parts)| parts.get_ref().as_array());
    for part in parts.into_iter().flat_map(|parts| parts.iter()) {
        let Some(part) = part.get_ref().as_table() else {
            continue;
        };
        known(part, PART)?;
        if let Some(attach) = of(part, "attach") {
            joint(attach, ATTACH)?;
        }
    }
    Ok(())
}

fn of<'a, 'i>(table: &'a DeTable<'i>, key: &str) -> Option<&'a DeTable<'i>> {
    let (_, value) = table.iter().find(|(name, _)| name.get_ref() == key)?;
    let value: &DeValue = value.get_ref();
    value.as_table()
}

fn joint(table: &DeTable, keys: &[&str]) -> Checked {
    known(table, keys)?;
    of(table, "limit").map_or(Ok(()), |limit| known(limit, LIMIT))
}

fn known(table: &DeTable, keys: &[&str]) -> Checked {
    let is_known = |name: &str| keys.contains(&name);
    let Some((name, _)) = table.iter().find(|(name, _)| !is_known(name.get_ref())) else {
        return Ok(());
    };
    let fault = RecipeFault::UnknownKey {
        key: name.get_ref().to_string(),
        nearest: nearest(keys.iter().copied(), name.get_ref()),
        known: keys.join(", "),
    };
    Err((Some(name.span().start), fault))
}
