//! The words of an SRDF and of an `export.toml`, as parts with values: all of them, known or not.

use toml::{Table, Value};
use urdd_directory::account::{Account, Overdrawn};
use urdd_xml::element::{children, name};
use urdd_xml::{Kind, Node};

use crate::element_values::Way;
use crate::fields::Fields;
use crate::other_elements::numbered;

/// The elements of an SRDF: `group_state "home" (arm)`, `disable_collisions a - b`.
pub(super) fn of_srdf(text: &str) -> Result<Vec<(String, Fields)>, String> {
    let document = urdd_xml::parse(text, Kind::Robot).map_err(|error| error.words(text))?;
    let account = account(text);
    let parts = children(document.root_element()).map(|(_, one)| srdf_element(one, &account));
    let parts = parts.collect::<Result<Vec<_>, Overdrawn>>().map_err(|why| why.to_string())?;
    Ok(numbered(parts.into_iter()))
}

/// Each path has the names above it: what a text is made into is charged to what it has.
fn account(text: &str) -> Account {
    let account = Account::default();
    account.deposit(text.len());
    account
}

/// The attributes that tell an element from others of its tag: the first of these that it has.
const NAMES: [&[&str]; 4] = [PAIR, &["joint_name", "property_name"], &["name"], &["link"]];
const PAIR: &[&str] = &["link1", "link2"];

/// Elements are told apart by their names, where they have any.
const WAY: Way = Way { between: '.', has_names: true, has_numbers: true };

/// A named configuration is one of a group.
const OF_GROUP: (&str, &str) = ("group_state", "group");

fn srdf_element(root: Node<'_, '_>, account: &Account) -> Result<(String, Fields), Overdrawn> {
    let attributes = NAMES.iter().find(|names| names.iter().all(|name| root.has_attribute(*name)));
    let mut names: Vec<&str> = attributes
        .into_iter()
        .copied()
        .flatten()
        .filter_map(|name| root.attribute(*name))
        .collect();
    let tag = name(root);
    if attributes == Some(&PAIR) {
        // It has no order.
        names.sort_unstable();
    }
    let mut label = format!("{tag} {}", names.join(" - "));
    let group = root.attribute(OF_GROUP.1).filter(|_| tag == OF_GROUP.0);
    if let Some(group) = group {
        label += &format!(" ({group})");
    }
    let fields = WAY.values(root, attributes.copied().unwrap_or_default(), account)?;
    Ok((label.trim_end().to_owned(), fields))
}

/// The tables of an `export.toml` by their paths: `actuators.joint.elbow`, `group "arm"`. What is false or empty says as
/// much as what is absent.
pub(super) fn of_toml(text: &str) -> Result<Vec<(String, Fields)>, String> {
    let file: Table = toml::from_str(text).map_err(|error| error.message().to_owned())?;
    let account = account(text);
    let mut parts = Vec::new();
    // A stack keeps the depth of tables off the call stack.
    let mut open = vec![(String::new(), &file)];
    while let Some((path, table)) = open.pop() {
        let below =
            |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        let mut fields = Fields::default();
        for (key, value) in table {
            let tables = value.as_array().map_or(1, |all| all.len().max(1));
            let paths = 2 * tables * (path.len() + key.len());
            account.charge(paths).map_err(|why| why.to_string())?;
            match value {
                Value::Table(table) => open.push((below(key), table)),
                Value::Array(all) if all.iter().any(Value::is_table) => {
                    open.extend(all.iter().filter_map(Value::as_table).map(|table| {
                        let name = table.get("name").and_then(Value::as_str).unwrap_or_default();
                        (format!("{} {name}", below(key)), table)
                    }));
                }
                Value::Boolean(false) => {}
                Value::Array(all) if all.is_empty() => {}
                Value::String(text) => fields.text(key, Some(text)),
                value => fields.value(key.clone(), &value.to_string()),
            }
        }
        if !fields.is_empty() {
            let name = if path.is_empty() { "robot".to_owned() } else { path };
            parts.push((name, fields));
        }
    }
    parts.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(numbered(parts.into_iter()))
}
