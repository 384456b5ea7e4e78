//! What reading a URDF gives: its data, and what is wrong with its text.

use std::collections::HashMap;
use std::ops::Range;

use thiserror::Error;

use urdd_directory::position::{LineIndex, Position};
use urdd_format::urdf::UrdfModule;
use urdd_xml::XmlError;

/// A URDF, as far as it could be read.
#[derive(Debug, Default)]
pub struct Reading {
    /// The content of a faithful `urdf_module`; `None` if the text is not well-formed XML, or not a URDF. Reliable only
    /// if there are no problems.
    pub robot: Option<UrdfModule>,
    /// What cannot be read, in the order of the file.
    pub problems: Vec<Problem>,
    /// Repeated elements, of which only one counts.
    pub repeated: Vec<Repeated>,
    /// The positions of the values of `robot` in the text, by JSON Pointer.
    pub(super) places: HashMap<String, usize>,
}

impl Reading {
    /// The byte offset of the value at a JSON Pointer of `robot`; where the URDF has no such
    /// value, of the nearest element around it.
    pub fn offset(&self, pointer: &str) -> Option<usize> {
        let mut pointer = pointer;
        loop {
            if let Some(offset) = self.places.get(pointer) {
                return Some(*offset);
            }
            pointer = &pointer[..pointer.rfind('/')?];
        }
    }

    /// The line and column of the value at a JSON Pointer of `robot`, as [`Reading::offset`].
    pub fn position(&self, lines: &LineIndex<'_>, pointer: &str) -> Option<Position> {
        self.offset(pointer).map(|offset| lines.position(offset))
    }
}

/// An unreadable place.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Byte offset in the text.
    pub offset: usize,
    pub fault: Fault,
    /// The text at the place.
    pub actual: Option<String>,
}

/// A fault. Its words name the kind of fault. The text at the place is separate, so that many faults of one kind can be
/// reported as one.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Error)]
pub enum Fault {
    /// Not well-formed XML.
    #[error("{0}")]
    NotXml(String),
    /// The root element has another name.
    #[error(
        "the outermost element is not `<robot>`; a URDF is one `<robot>` with everything inside it"
    )]
    NotRobot,
    /// A required attribute is missing.
    #[error("`<{element}>` does not have the attribute `{attribute}`; add it")]
    MissingAttribute { element: String, attribute: &'static str },
    /// A required element is missing.
    #[error("`<{parent}>` does not have a `<{element}>`; add it")]
    MissingElement {
        element: &'static str,
        /// The element that should contain it.
        parent: &'static str,
    },
    /// The wrong number of numbers, or something that is not a number.
    #[error(
        "`{attribute}` of `<{element}>` is not {}",
        numbers_wanted(*.count)
    )]
    NotNumbers {
        element: String,
        attribute: &'static str,
        /// The required number of numbers.
        count: usize,
    },
    /// A size that is not finite.
    #[error("`{attribute}` of `<{element}>` is not finite; write a number of at most 1.7e308")]
    NotFinite { element: String, attribute: &'static str },
    /// A rotation given in two ways.
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

/// A repeated element, of which only the first counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Repeated {
    /// Bytes of the element that is ignored.
    pub range: Range<usize>,
    /// Byte offset of the first one.
    pub first: usize,
    pub element: String,
    /// The element that contains it.
    pub parent: String,
}

pub(super) fn not_xml(error: &XmlError, text: &str) -> Problem {
    let place = error.pos();
    let start = LineIndex::new(text).line_start(place.row as usize).unwrap_or(text.len());
    let rest = text.get(start..).unwrap_or_default();
    let column = rest
        .char_indices()
        .nth((place.col as usize).saturating_sub(1))
        .map_or(rest.len(), |(offset, _)| offset);
    Problem {
        offset: start + column,
        // The message is shown with its place already.
        fault: Fault::NotXml(error.sentence(text)),
        actual: None,
    }
}

/// The numbers of an attribute: decimal, with or without fraction, exponent and sign (`+.01`, `1.`, `-5e-2`), separated
/// and surrounded by white space. `inf`, `nan` and numbers beyond binary64 are read as numbers that are not finite.
pub fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    let mut words = text.split_ascii_whitespace();
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    words.next().is_none().then_some(numbers)
}
