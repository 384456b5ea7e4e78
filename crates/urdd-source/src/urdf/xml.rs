//! Elements and attributes by qualified name.

use urdd_xml::Node;

use crate::fault::{Fault, PlacedFault};
use urdd_xml::XmlError;
pub(super) use urdd_xml::element::{attribute, children, name};

pub(super) type Element<'a> = Node<'a, 'a>;

/// The source text of an element.
pub(super) fn verbatim(element: Element<'_>) -> String {
    element.document().input_text()[element.range()].to_owned()
}

/// A parser error as a fault with its position.
pub(super) fn fault(error: &XmlError, text: &str) -> PlacedFault {
    let at = error.pos();
    let fault = match error {
        XmlError::Entities(_) => Fault::Entities,
        _ => Fault::NotXml(error.words(text)),
    };
    PlacedFault { file: None, line: at.row, column: at.col, fault }
}
