//! Elements and attributes, by the names that are written.

use roxmltree::{Error, Node};

use crate::directory::position::LineIndex;
use crate::generate::fault::{Fault, PlacedFault};
pub(super) use crate::xml::element::{attribute, children, name};
use crate::xml::{MOST_NODES, XmlError};

pub(super) type Element<'a> = Node<'a, 'a>;

/// An element's own characters.
pub(super) fn verbatim(element: Element<'_>) -> String {
    element.document().input_text()[element.range()].to_owned()
}

/// What the parser refused, in words and with its place.
pub(super) fn fault(error: &XmlError, text: &str) -> PlacedFault {
    let at = error.pos();
    let start = LineIndex::new(text)
        .line_start(at.row as usize)
        .unwrap_or_default();
    let is_after_end = text[..start].contains("</robot>") || text.starts_with("<robot/>");
    let fault = match error {
        XmlError::Parser(error) => Fault::NotXml(words(error, text, is_after_end)),
        XmlError::Entities(_) => Fault::Entities,
        _ => Fault::NotXml(error.words()),
    };
    PlacedFault {
        line: at.row,
        column: at.col,
        fault,
    }
}

fn words(error: &Error, text: &str, is_after_end: bool) -> String {
    match error {
        Error::UnexpectedDeclaration(_) => {
            "the declaration `<?xml …?>` may stand only at the very start of the file".to_owned()
        }
        Error::NodesLimitReached => format!("it has more than {MOST_NODES} nodes"),
        Error::NoRootNode | Error::UnclosedRootNode | Error::UnexpectedEndOfStream
            if text.trim().is_empty() =>
        {
            "the file is empty".to_owned()
        }
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            "the file ends before `</robot>`; it seems to be cut off".to_owned()
        }
        Error::UnexpectedCloseTag(expected, found, _) => {
            format!("`</{found}>` is found where `</{expected}>` is expected")
        }
        Error::MalformedEntityReference(_) => {
            "there is a `&` that begins nothing; write `&amp;` for the character".to_owned()
        }
        Error::UnknownEntityReference(name, _) => format!("there is no entity `&{name};`"),
        Error::DuplicatedAttribute(name, _) => format!("the attribute `{name}` is there twice"),
        Error::InvalidComment(_) => "there is `--` within a comment".to_owned(),
        Error::InvalidAttributeValue(_) => "there is a `<` within an attribute".to_owned(),
        Error::NonXmlChar(c, _) => format!("there is the character U+{:04X}", u32::from(*c)),
        Error::UnknownToken(_) if is_after_end => {
            "there is something after the robot's end, `</robot>`".to_owned()
        }
        Error::UnknownToken(_) => "it does not begin as XML does, with `<`".to_owned(),
        other => {
            // Its own words end with the place, which stands before them already.
            let words = other.to_string();
            match words.rsplit_once(" at ") {
                Some((words, place)) if place.contains(':') => words.to_owned(),
                _ => words,
            }
        }
    }
}
