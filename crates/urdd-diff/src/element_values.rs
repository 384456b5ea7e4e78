//! The values of an element and of all that is in it, by their paths.

use std::collections::HashMap;

use urdd_directory::account::{Account, Overdrawn};
use urdd_xml::Node;
use urdd_xml::element::children;

use crate::fields::Fields;

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
    ///
    /// # Errors
    /// If the account does not have the paths.
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
