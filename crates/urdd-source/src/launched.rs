//! Values that the launch files of a package have for arguments: in Python and in XML. Nothing is run.

use std::collections::BTreeMap;
use std::path::Path;

use urdd_directory::limits::MAX_MANIFEST_BYTES;
use urdd_xml::element::name;

use crate::gate::Gate;
use crate::python_tokens::{Token, tokens};
use crate::suggested::{MAX_VALUES, is_of_name};

/// Maximum number of launch files that are read.
const MAX_LAUNCHES: usize = 100;
const ENDINGS: [&str; 3] = [".py", ".launch", ".xml"];

/// The values in the launch files of a file's package: the choices of an argument, or else what it is given or is by default.
pub(crate) fn values(
    file: &Path,
    gate: &Gate,
    is_known: impl Fn(&str) -> bool,
) -> BTreeMap<String, Vec<String>> {
    let files = gate.files();
    let mut above = file.ancestors().skip(1);
    let Some(package) = above.find(|above| files.is_file(&above.join("package.xml"))) else {
        return BTreeMap::new();
    };
    let folder = package.join("launch");
    let mut names = files.names(&folder);
    names.retain(|name| ENDINGS.iter().any(|end| name.to_string_lossy().ends_with(end)));
    names.sort();
    let (mut choices, mut values) = (BTreeMap::new(), BTreeMap::<String, Vec<String>>::new());
    for name in names.into_iter().take(MAX_LAUNCHES) {
        let Ok(found) = gate.at(&folder.join(&name)) else { continue };
        let text = gate.bytes(&found, MAX_MANIFEST_BYTES).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        let found = match name.to_string_lossy().ends_with(".py") {
            true => by_python(&text).collect(),
            false => by_xml(&text),
        };
        for one in found.into_iter().filter(|one| is_known(&one.name)) {
            let known = values.entry(one.name.clone()).or_default();
            let value = one.value.filter(|value| !value.is_empty() && !known.contains(value));
            known.extend(value.filter(|_| known.len() < MAX_VALUES));
            if (1..=MAX_VALUES).contains(&one.choices.len()) {
                choices.entry(one.name).or_insert(one.choices);
            }
        }
    }
    values.retain(|_, values| !values.is_empty());
    values.append(&mut choices);
    values
}

/// The call that declares an argument.
const DECLARES: &str = "DeclareLaunchArgument(";

/// An argument of a launch file.
#[derive(Debug, PartialEq)]
pub(crate) struct Launched {
    pub(crate) name: String,
    /// `choices=[...]` of literals; none in XML.
    pub(crate) choices: Vec<String>,
    /// Its default, or the value that it is given: a literal.
    pub(crate) value: Option<String>,
}

/// The arguments of a launch file in Python.
pub(crate) fn by_python(text: &str) -> impl Iterator<Item = Launched> {
    // A call ends where the next begins.
    text.split(DECLARES).skip(1).filter_map(of_call)
}

/// The argument of a call that begins here.
fn of_call(text: &str) -> Option<Launched> {
    let tokens = tokens(text);
    let name = match (tokens.first()?, tokens.get(1), tokens.get(2)) {
        (Token::Text(name), ..) => name,
        (Token::Word(word), Some(Token::Mark('=')), Some(Token::Text(name))) if word == "name" => {
            name
        }
        _ => return None,
    };
    let behind = |key: &str| {
        let begin = [Token::Word(key.to_owned()), Token::Mark('=')];
        let at = tokens.windows(2).position(|window| *window == begin)?;
        tokens.get(at + 2..)
    };
    let value = match behind("default_value") {
        Some([Token::Text(value), Token::Mark(','), ..] | [Token::Text(value)]) => {
            Some(value.clone())
        }
        _ => None,
    };
    let mut choices = Vec::new();
    if let Some([Token::Mark('['), listed @ ..]) = behind("choices") {
        for pair in listed.chunks(2) {
            match pair {
                [Token::Mark(']'), ..] => break,
                [Token::Text(value), Token::Mark(end @ (',' | ']'))] => {
                    choices.push(value.clone());
                    if *end == ']' {
                        break;
                    }
                }
                _ => {
                    choices.clear();
                    break;
                }
            }
        }
    }
    Some(Launched { name: name.clone(), choices, value })
}

/// The arguments of a launch file in XML: those of `<arg>`, and the words `name:=value` of commands.
pub(crate) fn by_xml(text: &str) -> Vec<Launched> {
    let Ok(document) = urdd_xml::parse(text, urdd_xml::Kind::Other) else { return Vec::new() };
    let mut found = Vec::new();
    let mut add = |name: &str, value: &str| {
        let is_literal = !name.is_empty() && !value.contains(['$', '\'', '"']);
        if is_literal && name.chars().all(is_of_name) {
            let value = Some(value.to_owned());
            found.push(Launched { name: name.to_owned(), choices: Vec::new(), value });
        }
    };
    for node in document.descendants().filter(|node| node.is_element()) {
        let given = node.attribute("default").or(node.attribute("value"));
        if let ("arg", Some(name), Some(value)) = (name(node), node.attribute("name"), given) {
            add(name, value);
        }
        let words = node.attributes().flat_map(|one| one.value().split_whitespace());
        words.filter_map(|word| word.split_once(":=")).for_each(|(name, value)| add(name, value));
    }
    found
}
