//! SRDFs that are read, and what is wrong with one.

use std::collections::HashMap;
use std::fmt::Display;

use thiserror::Error;
use urdd_xml::{Document, Kind, Node};

use urdd_directory::position::LineIndex;

/// Errors of reading an SRDF.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// Not well-formed XML, or beyond a limit of the XML parser.
    #[error("line {line}, column {column}: {reason}")]
    Xml {
        /// The line, from 1.
        line: u32,
        /// The column, from 1.
        column: u32,
        /// What is wrong.
        reason: String,
    },
    /// Not an SRDF.
    #[error("this is not an SRDF: its outermost element is `{}`, not `robot`", .0.escape_debug())]
    NotSrdf(String),
    /// The SRDF of another robot.
    #[error("this is the SRDF of robot `{}`, not of `{}`", .found.escape_debug(), .expected.escape_debug())]
    OtherRobot {
        /// The robot name in the SRDF.
        found: String,
        /// The expected robot name.
        expected: String,
    },
    /// An element lacks something, names what the robot does not have, or contradicts another.
    #[error("line {line}: {reason}")]
    Element {
        /// The line, from 1.
        line: u32,
        /// What is wrong.
        reason: String,
    },
}

/// An SRDF.
pub struct Srdf<'t>(Document<'t>);

impl<'t> Srdf<'t> {
    /// An SRDF of any robot.
    pub fn new(text: &'t str) -> Result<Self, ReadError> {
        let document = urdd_xml::parse(text, Kind::Other).map_err(|error| ReadError::Xml {
            line: error.pos().row,
            column: error.pos().col,
            reason: error.sentence(text),
        })?;
        match document.root_element().tag_name().name() {
            "robot" => Ok(Srdf(document)),
            other => Err(ReadError::NotSrdf(other.to_owned())),
        }
    }

    /// An SRDF of this robot.
    pub fn of(text: &'t str, robot: &str) -> Result<Self, ReadError> {
        let srdf = Srdf::new(text)?;
        match srdf.robot().attribute("name").unwrap_or_default() {
            found if found == robot => Ok(srdf),
            found => {
                Err(ReadError::OtherRobot { found: found.to_owned(), expected: robot.to_owned() })
            }
        }
    }

    /// The outermost element.
    pub fn robot(&self) -> Node<'_, 't> {
        self.0.root_element()
    }

    /// The elements of a name directly in the outermost one.
    pub fn elements<'a>(&'a self, name: &'a str) -> impl Iterator<Item = Node<'a, 't>> {
        elements(self.robot(), name)
    }

    /// An error in an element. Each call counts lines from the beginning of the text.
    pub fn wrong(&self, node: Node, reason: impl Display) -> ReadError {
        let line = self.0.text_pos_at(node.range().start).row;
        ReadError::Element { line, reason: reason.to_string() }
    }
}

/// The elements of an SRDF that an import leaves out, as MoveIt does.
pub struct LeftOut<'a> {
    lines: LineIndex<'a>,
    /// What is wrong, the first line of it, and the number of elements.
    found: Vec<(String, u32, usize)>,
    places: HashMap<(&'static str, String), usize>,
}

impl<'a> LeftOut<'a> {
    /// None yet, of this SRDF.
    pub fn new(srdf: &'a Srdf<'a>) -> Self {
        let lines = LineIndex::new(srdf.0.input_text());
        LeftOut { lines, found: Vec::new(), places: HashMap::new() }
    }

    /// Leaves out an element. What is wrong is said once for each `kind` and `name`.
    pub fn add<R: Display>(
        &mut self,
        node: Node,
        (kind, name): (&'static str, &str),
        reason: impl FnOnce() -> R,
    ) {
        match self.places.get(&(kind, name.to_owned())) {
            Some(place) => self.found[*place].2 += 1,
            None => {
                let line = self.lines.position(node.range().start).line;
                self.places.insert((kind, name.to_owned()), self.found.len());
                self.found.push((reason().to_string(), line, 1));
            }
        }
    }

    /// An attribute of an element; without it, the element is left out.
    pub fn attribute<'n>(&mut self, node: Node<'n, '_>, key: &'static str) -> Option<&'n str> {
        let value = node.attribute(key).map(str::trim).filter(|value| !value.is_empty());
        if value.is_none() {
            let element = node.tag_name().name();
            self.add(node, (key, element), || format!("`<{element}>` has no `{key}`"));
        }
        value
    }

    /// What was left out, in the order of the file, each with its line.
    pub fn in_words(self) -> Vec<String> {
        let words = self.found.into_iter().map(|(reason, line, count)| match count {
            1 => format!("line {line}: {reason}"),
            _ => format!("line {line} and {} more: {reason}", count - 1),
        });
        words.collect()
    }
}

/// The elements of a name directly in another one.
pub fn elements<'a, 't: 'a>(
    node: Node<'a, 't>,
    name: &'a str,
) -> impl Iterator<Item = Node<'a, 't>> {
    node.children().filter(move |child| child.is_element() && child.tag_name().name() == name)
}
