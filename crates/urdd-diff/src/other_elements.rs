//! Elements that URDF does not define (transmission, gazebo, …): compared as XML, without white space between elements,
//! comments and the order of attributes.

use std::collections::HashMap;

use urdd_directory::account::{Account, Overdrawn};
use urdd_xml::Node;
use urdd_xml::element::{children, name, wrapped};
use urdd_xml::other_parts::{OtherParts, Owner};

use crate::fields::Fields;

/// The elements as parts: each with a name such as `transmission "t1"`, and with all its values. Equal names get a
/// number.
pub(super) fn parts(elements: &[String], account: &Account) -> Vec<(String, Fields)> {
    numbered(elements.iter().map(|text| part(text, account)))
}

/// Gives a number to each part whose name one before it has.
pub(super) fn numbered(parts: impl Iterator<Item = (String, Fields)>) -> Vec<(String, Fields)> {
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
pub(super) fn add(elements: &[String], account: &Account, fields: &mut Fields) {
    for (label, part) in parts(elements, account) {
        fields.keyed(label, part.key(), part.summary());
    }
}

/// Adds what the URDF says of a link, a joint or the robot where URDF defines nothing.
pub(super) fn add_parts(parts: Option<&OtherParts>, owner: &Owner, fields: &mut Fields) {
    add_parts_but(parts, owner, &[], fields);
}

/// As [`add_parts`], without attributes of its own that have these names.
pub(super) fn add_parts_but(
    parts: Option<&OtherParts>,
    owner: &Owner,
    said: &[&str],
    fields: &mut Fields,
) {
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
const WAY: Way = Way { between: '/', has_names: false, has_numbers: false };

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
    (label, WAY.values(root, &[], account).unwrap_or_else(|_| as_text(text)))
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
pub(super) struct Way {
    /// Between two steps of a path.
    pub between: char,
    /// Whether a step has the `name` of its element.
    pub has_names: bool,
    /// Whether texts that are numbers are compared as such.
    pub has_numbers: bool,
}

impl Way {
    /// All values of an element but its attributes that are in its label. Each path has the names above it, so it is
    /// charged.
    /// Fails if the account does not have the paths.
    pub fn values(
        &self,
        root: Node<'_, '_>,
        label: &[&str],
        account: &Account,
    ) -> Result<Fields, Overdrawn> {
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
