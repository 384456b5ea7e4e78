//! The carried URDF, read by the validator's own short path.
//!
//! The XML is read as it stands, so that what is absent can be told from what is zero, and every
//! value has its place in the file. What a URDF library would fill in, drop or repair is neither.

pub mod compare;
mod joint;
mod legacy;
mod link;
mod numbers;
mod problem;
mod reader;
mod reading;
mod xml;

pub use legacy::as_legacy;
pub use problem::{Fault, Problem, Repeated};
pub use reading::Reading;

/// Reads a URDF.
pub fn read(text: &str) -> Reading {
    match urdd_xml::parse(text, urdd_xml::Kind::Robot) {
        Ok(document) => reader::read(&document),
        Err(error) => Reading {
            problems: vec![problem::not_xml(&error, text)],
            ..Reading::default()
        },
    }
}

#[cfg(test)]
mod tests;
