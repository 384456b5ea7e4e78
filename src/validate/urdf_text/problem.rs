//! What can be wrong with a URDF's text.

use thiserror::Error;

use crate::directory::position::LineIndex;
use crate::xml::XmlError;

/// A place that cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Byte offset in the text.
    pub offset: usize,
    /// What is wrong there.
    pub fault: Fault,
    /// What stands there.
    pub actual: Option<String>,
}

/// What is wrong. The words say what kind of fault it is, and what stands there is said apart, so
/// that many of one kind can be told as one.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Error)]
pub enum Fault {
    /// Not well-formed XML.
    #[error("this is not well-formed XML: {0}")]
    NotXml(String),
    /// The outermost element is another.
    #[error("the outermost element of a URDF is `robot`")]
    NotRobot,
    /// An attribute that a reader cannot do without.
    #[error("`<{element}>` needs the attribute `{attribute}`")]
    MissingAttribute {
        /// The element.
        element: &'static str,
        /// The attribute.
        attribute: &'static str,
    },
    /// An element that a reader cannot do without.
    #[error("a `<{parent}>` needs a `<{element}>`")]
    MissingElement {
        /// The element that is not there.
        element: &'static str,
        /// Where it should be.
        parent: &'static str,
    },
    /// Not as many numbers as are needed, or something that is no number.
    #[error(
        "`{attribute}` of `<{element}>` must be {} with nothing but white space between them",
        numbers_wanted(*.count)
    )]
    NotNumbers {
        /// The element.
        element: &'static str,
        /// The attribute.
        attribute: &'static str,
        /// How many numbers are needed.
        count: usize,
    },
    /// A size that is not finite.
    #[error("`{attribute}` of `<{element}>` must be finite")]
    NotFinite {
        /// The element.
        element: &'static str,
        /// The attribute.
        attribute: &'static str,
    },
    /// A rotation that is given in two ways.
    #[error("`rpy` and `quat_xyzw` both say the rotation of an `<origin>`; keep one of them")]
    TwoRotations,
    /// A joint type that URDF does not define.
    #[error(
        "the type of a joint is one of revolute, continuous, prismatic, fixed, floating, planar, spherical"
    )]
    UnknownJointType,
}

fn numbers_wanted(count: usize) -> String {
    match count {
        1 => "one number,".to_owned(),
        _ => format!("{count} numbers,"),
    }
}

/// An element that is there again: the first counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Repeated {
    /// Byte offset of the element that does not count.
    pub offset: usize,
    /// Byte offset of the one that counts.
    pub first: usize,
    /// Its name.
    pub element: String,
    /// The element that it is in.
    pub parent: &'static str,
}

pub(super) fn not_xml(error: &XmlError, text: &str) -> Problem {
    let place = error.pos();
    let start = LineIndex::new(text)
        .line_start(place.row as usize)
        .unwrap_or(text.len());
    let rest = text.get(start..).unwrap_or_default();
    let column = rest
        .char_indices()
        .nth((place.col as usize).saturating_sub(1))
        .map_or(rest.len(), |(offset, _)| offset);
    let words = match error {
        XmlError::Parser(roxmltree::Error::UnexpectedDeclaration(_)) => {
            "the XML declaration `<?xml …?>` must stand at the very start of the file, once"
                .to_owned()
        }
        XmlError::Parser(roxmltree::Error::NodesLimitReached) => {
            "it has too many elements".to_owned()
        }
        // The place stands beside the message already.
        other => other.words(),
    };
    Problem {
        offset: start + column,
        fault: Fault::NotXml(words),
        actual: None,
    }
}
