//! Differences of what URDF does not define: elements in it (transmission, gazebo, …), compared as XML, without white space
//! between elements, comments and the order of attributes; and what stands beside it: its SRDF, what exports need, what an import
//! lost. Whatever these say is compared, whether a program knows the word or not.

use std::collections::HashMap;

use toml::{Table, Value};
use urdd_directory::account::{Account, AccountError};
use urdd_format::diff_report::PartDifference;
use urdd_format::report::Kind;
use urdd_source::beside::Companion;
use urdd_xml::Node;
use urdd_xml::element::{children, name, wrapped};
use urdd_xml::other_parts::{OtherParts, Owner};

use crate::fields::{self, Fields, Parts};
use crate::side::Side;

/// The elements as parts: each with a name such as `transmission "t1"`, and with all its values. Equal names get a
/// number.
pub fn parts(elements: &[String], account: &Account) -> Parts {
    numbered(elements.iter().map(|text| part(text, account)))
}

/// Gives a number to each part whose name one before it has.
fn numbered(parts: impl Iterator<Item = (String, Fields)>) -> Parts {
    let mut counts: HashMap<String, usize> = HashMap::new();
    let parts = parts.map(|(label, fields)| {
        let count = counts.entry(label.clone()).or_default();
        *count += 1;
        match count {
            1 => (label, fields),
            count => (format!("{label} ({count})"), fields),
        }
    });
    parts.collect()
}

/// Adds the elements to the values of a link or joint that contains them.
pub fn add(elements: &[String], account: &Account, fields: &mut Fields) {
    for (label, part) in parts(elements, account) {
        fields.keyed(label, part.key(), part.summary());
    }
}

/// Adds what the URDF says of a link, a joint or the robot where URDF defines nothing, without attributes of its own that
/// are `said` elsewhere.
pub fn add_parts(parts: Option<&OtherParts>, owner: &Owner, said: &[&str], fields: &mut Fields) {
    let all = parts.and_then(|parts| parts.get(owner)).into_iter().flatten();
    for part in all.filter(|part| !part.path.is_empty() || !said.contains(&&*part.name)) {
        let dot = if part.path.is_empty() { "" } else { "." };
        let at = format!("{}{dot}{}", part.path.replace('/', "."), part.name);
        let words: Vec<&str> = part.value.split_whitespace().collect();
        fields.text(at, Some(&words.join(" ")));
    }
}

/// The attribute that tells an element from others of its kind.
const NAMES: [&str; 3] = ["name", "reference", "joint"];

/// Elements are told apart by their tags, and numbers in them are texts.
const BY_TAGS: Way = Way { between: '/', has_names: false, has_numbers: false };

/// Its values one by one; its text, if it is not well-formed or the account does not have their paths.
fn part(text: &str, account: &Account) -> (String, Fields) {
    account.deposit(text.len());
    let wrapped = wrapped(text);
    let parsed = urdd_xml::parse(&wrapped, urdd_xml::Kind::Other).ok();
    let root = parsed.as_ref().and_then(|document| document.root_element().first_element_child());
    let Some(root) = root else { return ("element".to_owned(), as_text(text)) };
    let mut label = name(root).to_owned();
    if let Some(value) = NAMES.iter().find_map(|key| root.attribute(*key)) {
        label = format!("{label} \"{value}\"");
    }
    (label, BY_TAGS.values(root, &[], account).unwrap_or_else(|_| as_text(text)))
}

/// The words of an element, where its values are not read one by one.
fn as_text(text: &str) -> Fields {
    let mut fields = Fields::default();
    let words: Vec<&str> = text.split_whitespace().collect();
    fields.text("text", Some(&words.join(" ")));
    fields
}

/// How often a path is kept: to go on from it, to number its likes, and in what is compared and said.
const COPIES: usize = 5;

/// How values are found and compared.
struct Way {
    /// Between two steps of a path.
    between: char,
    /// Whether a step has the `name` of its element.
    has_names: bool,
    /// Whether texts that are numbers are compared as such.
    has_numbers: bool,
}

impl Way {
    /// All values of an element but its attributes that are in its label. Each path has the names above it, so it is
    /// charged.
    /// Fails if the account does not have the paths.
    fn values(
        &self,
        root: Node<'_, '_>,
        label: &[&str],
        account: &Account,
    ) -> Result<Fields, AccountError> {
        let mut fields = Fields::default();
        // Depth is bounded by the parser; a stack keeps it off the call stack.
        let mut open = vec![(root, String::new())];
        while let Some((element, path)) = open.pop() {
            let is_root = path.is_empty();
            let between = if is_root { String::new() } else { self.between.to_string() };
            for attribute in element.attributes() {
                let own = attribute.name();
                let is_said =
                    if is_root { label.contains(&own) } else { self.has_names && own == "name" };
                if is_said {
                    continue;
                }
                let space =
                    attribute.namespace().map_or(String::new(), |space| format!("{space}:"));
                account.charge(COPIES * (path.len() + space.len() + own.len()))?;
                let at = format!("{path}{between}{space}{own}");
                match self.has_numbers {
                    true => fields.value(at, attribute.value()),
                    false => fields.text(at, Some(attribute.value())),
                }
            }
            let texts = element.children().filter(|child| child.is_text());
            let words = texts.filter_map(|text| text.text()).flat_map(str::split_whitespace);
            let words = words.collect::<Vec<_>>().join(" ");
            if !is_root {
                fields.text(path.clone(), Some(&words));
            } else if !words.is_empty() {
                fields.text("text", Some(&words));
            }
            let mut counts: HashMap<String, usize> = HashMap::new();
            for (tag, child) in children(element) {
                let name = child.attribute("name").filter(|_| self.has_names);
                let name = name.map_or(String::new(), |name| format!(" {name}"));
                account.charge(COPIES * (path.len() + tag.len() + name.len()))?;
                let own = format!("{tag}{name}");
                let count = counts.entry(own.clone()).or_default();
                let number = if *count == 0 { String::new() } else { format!("[{count}]") };
                *count += 1;
                open.push((child, format!("{path}{between}{own}{number}")));
            }
        }
        Ok(fields.sorted())
    }
}

/// The parts of a side, or a note of why they are not compared.
type Read<'a> = dyn Fn(&str, &Side) -> Result<Option<Parts>, String> + 'a;

/// Differences of what stands beside two robots; `None` of what is not known of one.
pub struct Differences {
    pub srdf: Option<Vec<PartDifference>>,
    pub setup: Option<Vec<PartDifference>>,
    pub lost: Option<Vec<PartDifference>>,
}

/// Compares what stands beside two robots, and notes what is not compared.
pub fn differences(
    before: &Side,
    after: &Side,
    tolerance: f64,
    notes: &mut Vec<String>,
) -> Differences {
    let sides = [("A", before), ("B", after)];
    let mut compare = |name: &str, read: &Read<'_>| {
        let mut of = |(word, side): (&str, &Side)| match read(word, side) {
            Ok(parts) => parts,
            Err(note) => {
                notes.push(note);
                None
            }
        };
        let both = sides.map(&mut of);
        if let [Some(a), Some(b)] = &both {
            return Some(fields::differences(a, b, tolerance));
        }
        let some = sides
            .iter()
            .zip(&both)
            .find(|(_, parts)| parts.as_ref().is_some_and(|it| !it.is_empty()));
        notes.extend(some.map(|((word, _), _)| {
            format!("{word}: {name} is not compared: the other robot has none")
        }));
        None
    };
    let srdf = compare("its SRDF", &|word, side| {
        of(word, side, "SRDF", side.beside.srdf.as_ref(), of_srdf)
    });
    let setup = compare("its `export.toml`", &|word, side| {
        of(word, side, "`export.toml`", side.beside.setup.as_ref(), of_toml)
    });
    for (word, side) in sides {
        notes.extend(lost_note(word, side));
    }
    let parts = |side| lost(side).map(|parts| parts.collect::<Vec<_>>());
    let lost = parts(before).zip(parts(after));
    let lost = lost.map(|(a, b)| fields::differences(&a, &b, 0.0));
    Differences { srdf, setup, lost }
}

/// The parts of a file of a side, if it is there. A URDF without one has none; a URDD may have them in its modules.
fn of(
    word: &str,
    side: &Side,
    name: &str,
    file: Option<&Companion>,
    read: Reader,
) -> Result<Option<Parts>, String> {
    let read =
        file.map(|text| text.clone().and_then(|text| read(&text, &side.account))).transpose();
    let read =
        read.map_err(|why| format!("{word}: the {name} beside it is not compared: {why}"))?;
    Ok(read.or_else(|| (side.kind == Kind::Urdf).then(Vec::new)))
}

/// What an import lost, each with its number.
fn lost(side: &Side) -> Option<impl Iterator<Item = (String, Fields)>> {
    let lost = &side.beside.import.as_ref()?.lost;
    Some(lost.iter().map(|(what, count)| {
        let mut fields = Fields::default();
        fields.number("count", "", Some(*count as f64));
        (what.clone(), fields)
    }))
}

fn lost_note(word: &str, side: &Side) -> Option<String> {
    let lost = &side.beside.import.as_ref()?.lost;
    let all: Vec<String> = lost.iter().map(|(what, count)| format!("{what} ({count})")).collect();
    (!all.is_empty()).then(|| {
        format!("{word}: of what the import loses, only the number is compared: {}", all.join(", "))
    })
}

/// Reads a file beside a robot. Each path has the names above it, so the text is added to the account, and paths are charged.
type Reader = fn(&str, &Account) -> Result<Parts, String>;

/// The elements of an SRDF: `group_state "home" (arm)`, `disable_collisions a - b`.
fn of_srdf(text: &str, account: &Account) -> Result<Parts, String> {
    let document =
        urdd_xml::parse(text, urdd_xml::Kind::Robot).map_err(|error| error.words(text))?;
    account.deposit(text.len());
    let parts = children(document.root_element()).map(|(_, one)| srdf_element(one, account));
    let parts = parts.collect::<Result<Vec<_>, AccountError>>().map_err(|why| why.to_string())?;
    Ok(numbered(parts.into_iter()))
}

/// The attributes that tell an element from others of its tag: the first of these that it has.
const NAMES_IN_SRDF: [&[&str]; 4] = [PAIR, &["joint_name", "property_name"], &["name"], &["link"]];
const PAIR: &[&str] = &["link1", "link2"];

/// Elements are told apart by their names, where they have any.
const BY_NAMES: Way = Way { between: '.', has_names: true, has_numbers: true };

/// A named configuration is one of a group.
const OF_GROUP: (&str, &str) = ("group_state", "group");

fn srdf_element(root: Node<'_, '_>, account: &Account) -> Result<(String, Fields), AccountError> {
    let attributes =
        NAMES_IN_SRDF.iter().find(|names| names.iter().all(|name| root.has_attribute(*name)));
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
    let fields = BY_NAMES.values(root, attributes.copied().unwrap_or_default(), account)?;
    Ok((label.trim_end().to_owned(), fields))
}

/// The tables of an `export.toml` by their paths: `actuators.joint.elbow`, `group "arm"`. What is false or empty says as
/// much as what is absent.
fn of_toml(text: &str, account: &Account) -> Result<Parts, String> {
    let file: Table = toml::from_str(text).map_err(|error| error.message().to_owned())?;
    account.deposit(text.len());
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
