//! Values for which the conditions of a xacro file ask: `xacro:if`, `xacro:unless`.

use std::collections::HashMap;

use urdd_directory::position::LineIndex;
use urdd_xml::element::{attribute, name};

use crate::error::XacroArgument;
use crate::settings::Settings;

/// Maximum number of values that are suggested.
pub(crate) const MAX_VALUES: usize = 100;

/// Whether an argument is given as `name:=value`.
pub(crate) fn is_given(name: &str, settings: &Settings) -> bool {
    let mut given = settings.xacro.arguments.iter().filter_map(|one| one.split_once(":="));
    given.any(|(given, _)| given == name)
}

/// The argument that a text is, and nothing else: `$(arg kind)`.
pub(crate) fn whole_argument(text: &str) -> Option<&str> {
    let inside = text.trim().strip_prefix("$(arg ")?.strip_suffix(')')?.trim();
    Some(inside).filter(|name| !name.is_empty() && !name.contains(['$', ')']))
}

/// The arguments for whose values alone the text of a file defines a property, each with these values. Those with such a
/// default, and those that are given, are left out.
pub(crate) fn deciding(text: &str, property: &str, settings: &Settings) -> Vec<XacroArgument> {
    let Ok(document) = urdd_xml::parse(text, urdd_xml::Kind::Robot) else { return Vec::new() };
    let lines = LineIndex::new(text);
    let mut all: Vec<XacroArgument> = Vec::new();
    let mut places: HashMap<&str, usize> = HashMap::new();
    let (mut aliases, mut conditions) = (HashMap::new(), Vec::new());
    for node in document.descendants().filter(|node| node.is_element()) {
        let value = |key| attribute(node, key).map(|one| one.value());
        match (name(node), value("name")) {
            // The first of a name counts, as in xacro.
            ("xacro:arg", Some(own)) if !places.contains_key(own) => {
                places.insert(own, all.len());
                all.push(XacroArgument {
                    name: own.to_owned(),
                    default: value("default").map(str::to_owned),
                    values: Vec::new(),
                    is_condition: true,
                    is_needed: true,
                    at: Some(lines.position(node.range().start)),
                });
            }
            ("xacro:property", Some(own)) => {
                if let Some(argument) = value("value").and_then(whole_argument) {
                    aliases.insert(own, argument);
                }
                let above = node.parent_element().filter(|above| name(*above) == "xacro:if");
                let condition = above.and_then(|above| attribute(above, "value"));
                conditions.extend(condition.filter(|_| own == property).map(|one| one.value()));
            }
            _ => {}
        }
    }
    for (side, literal) in conditions.into_iter().flat_map(compared) {
        let argument = match side {
            Side::Argument(argument) => Some(argument),
            Side::Property(name) => aliases.get(name).copied(),
        };
        let place = argument.and_then(|name| places.get(name));
        let Some(argument) = place.and_then(|place| all.get_mut(*place)) else { continue };
        let is_new = !argument.values.iter().any(|value| value == literal);
        if is_new && argument.values.len() < MAX_VALUES {
            argument.values.push(literal.to_owned());
        }
    }
    let defines = |value: &String, values: &[String]| values.contains(value) || value.contains('$');
    all.retain(|one| {
        let has_one = one.default.as_ref().is_some_and(|default| defines(default, &one.values));
        !one.values.is_empty() && !has_one && !is_given(&one.name, settings)
    });
    all
}

/// What a condition compares.
#[derive(Debug, PartialEq)]
pub(crate) enum Side<'t> {
    /// The argument of this name.
    Argument(&'t str),
    /// A property, or a parameter of a macro.
    Property(&'t str),
}

/// What a condition asks for, each with a value that decides it: texts that it compares with, or `true` and `false`.
pub(crate) fn asked(condition: &str) -> Vec<(Side<'_>, &str)> {
    let compared = compared(condition);
    if !compared.is_empty() {
        return compared;
    }
    let condition = condition.trim();
    let inside = condition.strip_prefix("${").and_then(|inside| inside.strip_suffix('}'));
    let inside = inside.unwrap_or(condition).trim();
    let inside = inside.strip_prefix("not ").unwrap_or(inside).trim();
    let argument = || whole_argument(inside).map(Side::Argument);
    let is_name =
        !inside.is_empty() && inside.chars().all(is_of_name) && condition.starts_with('$');
    let side = || match argument() {
        None if is_name => Some(Side::Property(inside)),
        found => found,
    };
    ["true", "false"].into_iter().filter_map(|value| Some((side()?, value))).collect()
}

pub(crate) fn is_of_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The comparisons of a condition with texts: `side == 'left'`.
fn compared(condition: &str) -> Vec<(Side<'_>, &str)> {
    let sides: Vec<&str> = condition.split("==").collect();
    let pairs = sides.windows(2).filter_map(|pair| match pair {
        [before, after] => Some((side(before)?, literal(after)?)),
        _ => None,
    });
    pairs.collect()
}

/// What stands at the end of a text: a name, or an argument in quotes.
fn side(text: &str) -> Option<Side<'_>> {
    const QUOTES: [char; 2] = ['\'', '"'];
    let text = text.trim_end();
    if let Some(quoted) = text.strip_suffix(QUOTES) {
        let (_, inside) = quoted.rsplit_once(QUOTES)?;
        return whole_argument(inside).map(Side::Argument);
    }
    let name = text.rsplit(|c: char| !is_of_name(c)).next()?;
    Some(Side::Property(name)).filter(|_| !name.is_empty())
}

/// The text in quotes that a text begins with.
fn literal(text: &str) -> Option<&str> {
    let text = text.trim_start();
    let rest = text.strip_prefix('\'').map(|rest| (rest, '\''));
    let (rest, quote) = rest.or_else(|| text.strip_prefix('"').map(|rest| (rest, '"')))?;
    let (literal, _) = rest.split_once(quote)?;
    Some(literal).filter(|literal| !literal.is_empty())
}

#[cfg(test)]
mod tests {
    use super::{Side, compared};

    #[test]
    fn comparisons_are_those_with_texts() {
        let found = compared("${side == 'left' or '$(arg side)' == \"right\" and n == 3}");
        assert_eq!(found, [(Side::Property("side"), "left"), (Side::Argument("side"), "right")]);
        for text in ["", "==", "${a == b}", "${'x' == 'y'}", "${a == 'x", "${a != 'x'}", "a=='"] {
            assert_eq!(compared(text), [], "{text}");
        }
    }
}
