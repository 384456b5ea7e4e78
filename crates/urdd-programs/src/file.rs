//! What a reader is asked about, and what it says of its program; a file as parsers of XML have it that keep to the standard: expat of
//! Python, and those of browsers.

use std::borrow::Cow;
use std::cell::OnceCell;

use urdd_format::short;
use urdd_xml::{Counted, Document, Kind, Node, ParserError as Error, StringStorage, XmlError};

use crate::effect::{Effects, Reading};
use crate::mesh::Mesh;
use crate::tinyxml;
use crate::tree::{Attribute, BEYOND, Element, Malformed, Parsed, Tree};
use crate::unknown::{self, Found, Names};

/// What a reader says of its program.
pub struct About {
    /// As reports and the table of `tests/figures/programs` name it.
    pub id: &'static str,
    /// As people know it.
    pub name: &'static str,
    /// Its name whatever its version.
    pub family: &'static str,
    /// The version that the reader is held to.
    pub version: &'static str,
    /// Names of settings for it besides `id`, the best first.
    pub settings: &'static [&'static str],
    /// Whether it is asked if nobody says which programs matter.
    pub is_asked: bool,
    /// Which files it reads, if not every URDF. What such a program ignores of a URDF is no loss.
    pub is_for: Option<fn(&File) -> bool>,
    /// Which names it takes for those of elements.
    pub names: Names,
    /// Elements and attributes that it never reads, in words with spaces between them: nothing is lost with them.
    pub never: &'static [&'static str],
    pub read: fn(&File, &mut Effects) -> Reading<()>,
}

/// A URDF, and the mesh files that it names.
pub struct File<'a> {
    /// The file as it is on disk.
    pub(crate) bytes: &'a [u8],
    pub(crate) counted: Counted<'a>,
    /// What tinyxml2 makes of it, for all programs that read by it.
    pub(crate) document: tinyxml::Document<'a>,
    /// What parsers make of it that keep to the standard ([`trees`]), if it is UTF-8.
    pub(crate) strict: Option<Parsed<[Tree<'a>; 2]>>,
    meshes: &'a dyn Fn(&str) -> Mesh,
    unknown: [OnceCell<(Vec<Found>, usize)>; 3],
}

impl<'a> File<'a> {
    /// A file as it is on disk. `meshes` says what is there of a mesh, by the name that the URDF gives it.
    pub fn new(counted: Counted<'a>, meshes: &'a dyn Fn(&str) -> Mesh) -> Self {
        let (bytes, document) = (counted.bytes(), tinyxml::Document::of(counted));
        let text = std::str::from_utf8(bytes).ok();
        let strict = text.map(|text| trees(text, counted.document()));
        File { bytes, counted, document, strict, meshes, unknown: Default::default() }
    }

    /// What programs ignore that take such names for those of elements.
    pub(crate) fn unknown(&self, names: Names) -> &(Vec<Found>, usize) {
        let found = &self.unknown[names as usize];
        found.get_or_init(|| unknown::find(&self.document, names))
    }

    pub(crate) fn mesh(&self, name: &str) -> Mesh {
        (self.meshes)(name)
    }
}

/// How a parser names elements and attributes that have a prefix.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Naming {
    /// `{namespace}name`.
    Expanded,
    /// `prefix:name`.
    Written,
}

/// The text of a file that is not UTF-8.
pub struct Text {
    text: String,
    /// The place in the file of each byte of the text.
    places: Vec<usize>,
}

impl Text {
    /// UTF-8, whatever the file says; bytes that are none become U+FFFD.
    pub fn utf8(bytes: &[u8]) -> Text {
        let (mut text, mut places, mut at) = (String::new(), Vec::new(), 0);
        for chunk in bytes.utf8_chunks() {
            for (of, one) in chunk.valid().char_indices() {
                text.push(one);
                places.resize(text.len(), at + of);
            }
            at += chunk.valid().len();
            if !chunk.invalid().is_empty() {
                text.push(char::REPLACEMENT_CHARACTER);
                places.resize(text.len(), at);
            }
            at += chunk.invalid().len();
        }
        Text { text, places }
    }

    /// The place in the file of a place in the text.
    fn place(&self, at: usize) -> usize {
        self.places.get(at).or(self.places.last()).copied().unwrap_or(0)
    }

    /// A tree of the text with its places as they are in the file.
    fn placed<'t>(&self, mut tree: Tree<'t>) -> Tree<'t> {
        for element in &mut tree.elements {
            element.tag = self.place(element.tag.start)..self.place(element.tag.end);
            for attribute in &mut element.attributes {
                attribute.range =
                    self.place(attribute.range.start)..self.place(attribute.range.end);
            }
        }
        tree
    }

    /// As [`trees`] of the text.
    pub fn trees(&self) -> Parsed<[Tree<'_>; 2]> {
        match trees(&self.text, None) {
            Ok(trees) => Ok(trees.map(|tree| self.placed(tree))),
            Err(bad) => Err(Malformed { at: self.place(bad.at), why: bad.why }),
        }
    }
}

/// Parses text that is well-formed and has its prefixes declared: the trees of [`Naming::Expanded`] and [`Naming::Written`].
/// `known` is the document, if another reader has it.
pub fn trees<'a>(text: &'a str, known: Option<&Document<'a>>) -> Parsed<[Tree<'a>; 2]> {
    if let Some((at, why)) = oddity(text) {
        return Err(Malformed { at, why });
    }
    let of = |document: &Document<'a>| {
        [Naming::Expanded, Naming::Written].map(|names| tree(document, names))
    };
    match known {
        Some(document) => Ok(of(document)),
        None => urdd_xml::parse(text, Kind::Lenient)
            .map(|document| of(&document))
            .map_err(|error| Malformed { at: error.offset(text), why: why(&error) }),
    }
}

fn tree<'a>(document: &Document<'a>, names: Naming) -> Tree<'a> {
    let text = document.input_text();
    let mut tree = Tree::default();
    // The element of each node that has one.
    let mut indices: Vec<usize> = Vec::new();
    for node in document.descendants() {
        indices.resize(node.id().get_usize() + 1, usize::MAX);
        let Some(element) = element(node, names, text) else { continue };
        let above = node.parent().and_then(|parent| indices.get(parent.id().get_usize()));
        indices[node.id().get_usize()] = tree.push(element, above.copied());
    }
    // Instructions may be beside the root.
    tree.tops.retain(|&top| tree.elements[top].name != INSTRUCTION);
    tree
}

/// What is not well-formed, and `roxmltree` lets through.
fn oddity(text: &str) -> Option<(usize, &'static str)> {
    let is_bad = |&(at, _): &(usize, &str)| {
        let ends = |one: char| !one.is_ascii_alphanumeric();
        let number = text[at + 2..].split(ends).next().unwrap_or_default();
        let code = match number.strip_prefix('x') {
            Some(digits) => u32::from_str_radix(digits, 16),
            None => number.parse(),
        };
        code.is_ok_and(|code| char::from_u32(code).is_none())
    };
    if let Some((at, _)) = text.match_indices("&#").find(is_bad) {
        return Some((at, "a reference is of no character"));
    }
    let is_empty = |&(at, mark): &(usize, &str)| {
        let name = |one: char| one.is_alphanumeric() || "_-.".contains(one);
        let value = text[at + mark.len()..].trim_start_matches(name);
        value.starts_with("=\"\"") || value.starts_with("=''")
    };
    if let Some((at, _)) = text.match_indices("xmlns:").find(is_empty) {
        return Some((at, "a prefix is declared as nothing"));
    }
    if let Some((at, _)) = text.match_indices(" :").find(|(at, _)| is_attribute(&text[at + 2..])) {
        return Some((at + 1, "an attribute begins with `:`"));
    }
    let head = text.trim_start_matches('\u{feff}');
    if head.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("<?xml"))
        && head[5..].starts_with([' ', '\n', '\t', '\r', '?'])
        && !is_declaration(head)
    {
        return Some((text.len() - head.len(), "the XML declaration is not right"));
    }
    None
}

/// Whether a name, `=` and a quote are next.
fn is_attribute(text: &str) -> bool {
    let behind = text.trim_start_matches(|one: char| one.is_alphanumeric() || "._-".contains(one));
    behind.starts_with("=\"") || behind.starts_with("='")
}

/// Whether a text begins with a declaration that says its version, and perhaps more.
fn is_declaration(text: &str) -> bool {
    let inside = text.strip_prefix("<?xml").and_then(|text| text.split_once("?>"));
    let words = inside.map_or("", |(inside, _)| inside).split(['"', '\'']).map(str::trim);
    let words: Vec<&str> = words.collect();
    let mut pairs =
        words.chunks_exact(2).map(|pair| (pair[0].trim_end_matches('=').trim(), pair[1]));
    let is_version = |version: &str| {
        version.strip_prefix("1.").is_some_and(|minor| minor.parse::<u32>().is_ok())
    };
    pairs.next().is_some_and(|(name, value)| name == "version" && is_version(value))
        && pairs.all(|(name, value)| match name {
            "encoding" => value.starts_with(|first: char| first.is_ascii_alphabetic()),
            "standalone" => matches!(value, "yes" | "no"),
            _ => false,
        })
}

/// The name of an element that is a processing instruction.
pub const INSTRUCTION: &str = "?";

fn element<'a>(node: Node<'_, 'a>, names: Naming, text: &'a str) -> Option<Element<'a>> {
    let range = node.range();
    let written = |range: std::ops::Range<usize>| text.get(range).unwrap_or_default();
    let name = match names {
        _ if node.is_pi() => INSTRUCTION.into(),
        _ if !node.is_element() => return None,
        Naming::Expanded => expanded(node.tag_name().namespace(), node.tag_name().name()),
        Naming::Written => {
            let tag = written(range.start + 1..range.end);
            let ends =
                |character: char| character.is_ascii_whitespace() || "/>".contains(character);
            tag.split(ends).next().unwrap_or_default().into()
        }
    };
    let attributes = node.attributes().map(|attribute| Attribute {
        name: match names {
            Naming::Expanded => expanded(attribute.namespace(), attribute.name()),
            Naming::Written => written(attribute.range_qname()).into(),
        },
        value: match attribute.value_storage() {
            StringStorage::Borrowed(value) => Cow::Borrowed(*value),
            StringStorage::Owned(value) => Cow::Owned(value.to_string()),
        },
        range: attribute.range(),
    });
    Some(Element::new(name, attributes.collect(), range))
}

fn expanded<'a>(namespace: Option<&str>, name: &'a str) -> Cow<'a, str> {
    match namespace {
        Some(namespace) => format!("{{{}}}{name}", short::name(namespace)).into(),
        None => name.into(),
    }
}

fn why(error: &XmlError) -> &'static str {
    let XmlError::Parser(error) = error else { return BEYOND };
    match error {
        Error::UnknownNamespace(..) => "a prefix is not declared",
        Error::DuplicatedNamespace(..) | Error::DuplicatedAttribute(..) => {
            "an attribute is there twice in one element"
        }
        Error::UnexpectedCloseTag(..) => "an element is closed by another name",
        Error::UnknownEntityReference(..) => "an entity is not declared",
        Error::MalformedEntityReference(_) => "`&` does not begin an entity",
        Error::UnexpectedDeclaration(_) => {
            "the XML declaration is not at the beginning of the file"
        }
        Error::NoRootNode => "the file has no element",
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => "an element is not closed",
        Error::NonXmlChar(..) => "the file has a character that XML does not allow",
        Error::InvalidComment(_) => "a comment has `--` in it",
        _ => "the file is not well-formed XML",
    }
}
