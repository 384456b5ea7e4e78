//! The carried URDF, read by a small reader of the validator's own.
//!
//! It reads the XML literally, so that missing values differ from zeros, and every value has its place in the file. It
//! does not fill in, drop or repair values, as a URDF library would.

pub mod compare;
mod joint;
mod legacy;
mod link;
mod reader;
mod reading;
pub mod xml;

use urdd_xml::Xml;

pub use legacy::as_legacy;
pub use reading::{Fault, Problem, Reading, Repeated};

pub fn read(text: &str) -> Reading {
    of(&Xml::new(text))
}

/// The same, of a text that others read too.
pub fn of(xml: &Xml<'_>) -> Reading {
    match xml.document() {
        Ok(document) => reader::read(document),
        Err(error) => {
            Reading { problems: vec![reading::not_xml(error, xml.text())], ..Reading::default() }
        }
    }
}
