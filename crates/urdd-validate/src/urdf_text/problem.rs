//! What can be wrong with a URDF's text.

use thiserror::Error;

use urdd_directory::position::LineIndex;
use urdd_xml::XmlError;

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
    #[error("not well-formed XML: {0}")]
    NotXml(String),
    /// The outermost element is another.
    #[error(
        "the outermost element is not `<robot>`; a URDF is one `<robot>` with everything inside it"
    )]
    NotRobot,
    /// An attribute that a reader cannot do without.
    #[error("`<{element}>` does not have the attribute `{attribute}`; add it")]
    MissingAttribute {
        /// The element.
        element: &'static str,
        /// The attribute.
        attribute: &'static str,
    },
    /// An element that a reader cannot do without.
    #[error("`<{parent}>` does not have a `<{element}>`; add it")]
    MissingElement {
        /// The element that is not there.
        element: &'static str,
        /// Where it should be.
        parent: &'static str,
    },
    /// Not as many numbers as are needed, or something that is no number.
    #[error(
        "`{attribute}` of `<{element}>` is not {}",
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
    #[error("`{attribute}` of `<{element}>` is not finite; write a number of at most 1.7e308")]
    NotFinite {
        /// The element.
        element: &'static str,
        /// The attribute.
        attribute: &'static str,
    },
    /// A rotation that is given in two ways.
    #[error("`<origin>` has both `rpy` and `quat_xyzw`; keep one of them")]
    TwoRotations,
    /// A joint type that URDF does not define.
    #[error(
        "`<joint>` has a type that URDF does not define; write revolute, continuous, prismatic, fixed, floating, planar or spherical"
    )]
    UnknownJointType,
}

fn numbers_wanted(count: usize) -> String {
    match count {
        1 => "a number; write one number, without a unit".to_owned(),
        _ => format!(
            "{count} numbers; write {count} numbers with spaces between them, without commas"
        ),
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
    Problem {
        offset: start + column,
        // The place stands beside the message already.
        fault: Fault::NotXml(error.words(text)),
        actual: None,
    }
}
