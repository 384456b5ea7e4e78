//! What a xacro file has, as its text says it. Nothing is expanded.

use std::collections::{BTreeMap, HashSet};

use urdd_directory::position::LineIndex;
use urdd_srdf::vocabulary::is_of_robot;
use urdd_xml::element::{children, name};
use urdd_xml::{Document, Node, Xml, XmlError};

/// The prefix of elements that xacro reads.
const PREFIX: &str = "xacro:";

/// How often defaults of defaults are looked up, and the maximum length of what they make, bytes.
const MAX_ROUNDS: usize = 4;
const MAX_NAME: usize = 4096;

/// What a xacro file has.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MacroFile {
    /// The name of the outermost element.
    pub root: String,
    /// Whether something of xacro is in it, or its namespace.
    pub has_xacro: bool,
    /// What is made of it where it is expanded or included.
    pub content: Content,
    /// Whether it defines properties.
    pub has_properties: bool,
    /// What its arguments and properties are by default, by what is inside of `$(...)` and `${...}`: `arg hand`, `hand`.
    pub defaults: BTreeMap<String, String>,
    /// The macros that it defines.
    pub macros: Vec<Macro>,
}

/// What is expanded in place: in a file outside of its macros, or in a macro.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Content {
    /// Whether there is an element at all.
    pub is_some: bool,
    /// Whether there is a `<link>`.
    pub has_link: bool,
    /// Whether there is an element of an SRDF.
    pub has_srdf: bool,
    /// The macros that it calls.
    pub calls: Vec<Call>,
    /// The files that it includes, as they are written.
    pub includes: Vec<String>,
}

/// A call of a macro.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// The name without its namespaces; `None` if it is computed.
    pub name: Option<String>,
    /// Whether what it makes is beside the links, and not in one.
    pub is_beside_links: bool,
}

/// A macro.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Macro {
    /// Its name.
    pub name: String,
    /// The line that it begins on.
    pub line: u32,
    /// What a call makes.
    pub content: Content,
}

/// Reads a text.
///
/// # Errors
/// If it is not well-formed, or beyond the limits.
pub fn read(text: &str) -> Result<MacroFile, XmlError> {
    urdd_xml::parse(text, urdd_xml::Kind::Robot).map(|document| of(&document))
}

fn of(document: &Document<'_>) -> MacroFile {
    let root = document.root_element();
    let is_of_xacro = |uri: &str| uri.contains("xacro");
    let mut file = MacroFile {
        root: name(root).to_owned(),
        has_xacro: root.namespaces().any(|one| is_of_xacro(one.uri())),
        ..MacroFile::default()
    };
    let lines = LineIndex::new(document.input_text());
    file.content = file.content_of(root, &lines);
    file
}

/// Whether the expansion of a file has no link; one that is not well-formed may have some.
pub fn has_no_link(expansion: &Xml<'_>) -> bool {
    expansion.document().is_ok_and(|document| !of(document).content.has_link)
}

/// Whether the expansion of a file has no name for the robot, as that of a part for robots.
pub fn has_no_name(expansion: &Xml<'_>) -> bool {
    expansion.document().is_ok_and(|document| !document.root_element().has_attribute("name"))
}

/// Whether the expansion of a file is no whole tree, as that of a part for robots: a joint is at a link that is not there, or
/// several links are the child of no joint.
pub fn has_open_ends(expansion: &Xml<'_>) -> bool {
    let Ok(document) = expansion.document() else { return false };
    let root = document.root_element();
    let of = |tag: &'static str| children(root).filter(move |(name, _)| *name == tag);
    let links: HashSet<&str> = of("link").filter_map(|(_, link)| link.attribute("name")).collect();
    let ends = |end: &'static str| {
        let ends = of("joint").flat_map(move |(_, joint)| children(joint));
        ends.filter_map(move |(name, node)| node.attribute("link").filter(|_| name == end))
    };
    let held: HashSet<&str> = ends("child").collect();
    let is_missing = |link: &str| !links.contains(link);
    ends("parent").any(is_missing)
        || held.iter().any(|link| is_missing(link))
        || links.difference(&held).count() > 1
}

/// The names behind each `<` of a text that is not parsed.
pub(crate) fn tags(text: &str) -> impl Iterator<Item = &str> {
    let names = text.split('<').filter(|rest| rest.starts_with(char::is_alphabetic));
    names.filter_map(|rest| rest.split(|c: char| c.is_whitespace() || "/>".contains(c)).next())
}

impl MacroFile {
    /// A text without anything of xacro, which need not be parsed.
    pub fn plain(text: &str) -> Self {
        let root = urdd_xml::root_name(text).unwrap_or("robot").to_owned();
        let content = Content {
            is_some: tags(text).nth(1).is_some(),
            has_link: tags(text).any(|tag| tag == "link"),
            has_srdf: tags(text).any(is_of_robot),
            ..Content::default()
        };
        MacroFile { root, content, ..MacroFile::default() }
    }

    fn add_default(&mut self, name: Option<String>, value: Option<String>) {
        if let (Some(name), Some(value)) = (name, value) {
            self.defaults.entry(name).or_insert(value);
        }
    }

    /// The name of an included file, with the defaults of what it is computed from: also of `$(optenv NAME DEFAULT)`.
    pub fn by_default(&self, name: &str) -> String {
        let mut name = name.to_owned();
        for _ in 0..MAX_ROUNDS {
            let more = self.substituted(&name);
            if more == name || more.len() > MAX_NAME {
                break;
            }
            name = more;
        }
        name
    }

    fn substituted(&self, text: &str) -> String {
        let mut parts = text.split('$');
        let mut whole = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let ends = [('(', ')'), ('{', '}')].into_iter();
            let inside = |(open, close)| part.strip_prefix(open)?.split_once(close);
            let Some((inside, rest)) = ends.filter_map(inside).next() else {
                whole += &format!("${part}");
                continue;
            };
            let known = match inside.trim().split_once(' ') {
                Some(("optenv", rest)) => {
                    Some(rest.trim().split_once(' ').map_or("", |(_, value)| value.trim()))
                }
                None if inside == "dirname" => Some("."),
                _ => self.defaults.get(inside.trim()).map(String::as_str),
            };
            match known {
                Some(known) => whole += &format!("{known}{rest}"),
                None => whole += &format!("${part}"),
            }
        }
        whole
    }

    /// The content of an element. What it declares goes into the lists, wherever that is.
    fn content_of(&mut self, parent: Node, lines: &LineIndex) -> Content {
        let mut content = Content::default();
        let mut waiting = vec![(parent, true)];
        while let Some((parent, is_beside_links)) = waiting.pop() {
            for (tag, child) in children(parent) {
                content.is_some = true;
                let Some(of_xacro) = tag.strip_prefix(PREFIX) else {
                    content.has_link |= is_beside_links && tag == "link";
                    content.has_srdf |= is_beside_links && is_of_robot(tag);
                    waiting.push((child, false));
                    continue;
                };
                self.has_xacro = true;
                let attribute = |key| child.attribute(key).map(str::to_owned);
                match of_xacro {
                    "macro" => {
                        let name = attribute("name").unwrap_or_default();
                        let name = name.strip_prefix(PREFIX).unwrap_or(&name).to_owned();
                        let line = lines.position(child.range().start).line;
                        // One level of the document is one of the calls of this function.
                        let made = self.content_of(child, lines);
                        self.macros.push(Macro { name, line, content: made });
                        continue;
                    }
                    "include" => content.includes.extend(attribute("filename")),
                    "property" => {
                        self.has_properties = true;
                        self.add_default(attribute("name"), attribute("value"));
                    }
                    "arg" => {
                        let name = attribute("name").map(|name| format!("arg {name}"));
                        self.add_default(name, attribute("default"));
                    }
                    "if" | "unless" | "insert_block" | "element" | "attribute" => {}
                    called => {
                        let named = attribute("macro").filter(|_| called == "call");
                        let name = Some(named.unwrap_or_else(|| called.to_owned()));
                        let name = name.filter(|name| !name.contains('$')).map(|name| last(&name));
                        content.calls.push(Call { name, is_beside_links });
                    }
                }
                // Also the blocks that a macro inserts.
                waiting.push((child, is_beside_links));
            }
        }
        content
    }
}

/// A name without its namespaces.
fn last(name: &str) -> String {
    name.rsplit('.').next().unwrap_or(name).to_owned()
}
