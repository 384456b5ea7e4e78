//! The carried URDF, read by a small reader of the validator's own.
//!
//! It reads the XML literally, so that missing values differ from zeros, and every value has its place in the file. It
//! does not fill in, drop or repair values, as a URDF library would.

pub mod compare;
mod joint;
mod legacy;
mod link;
pub mod numbers;
mod reader;
mod reading;
mod xml;

pub use legacy::as_legacy;
pub use reading::{Fault, Problem, Reading, Repeated};

pub fn read(text: &str) -> Reading {
    match urdd_xml::parse(text, urdd_xml::Kind::Robot) {
        Ok(document) => reader::read(&document),
        Err(error) => {
            Reading { problems: vec![reading::not_xml(&error, text)], ..Reading::default() }
        }
    }
}
