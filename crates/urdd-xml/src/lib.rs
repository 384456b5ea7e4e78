//! Internal to urdd; no stability promise.
//!
//! Parses untrusted XML, and writes numbers as it has them. This crate does not know the URDD format.
//!
//! Before parsing, this crate limits what a small file can use to exhaust time or memory: nesting depth, elements,
//! attributes, prefixes and entity declarations. `roxmltree` compares each attribute of an element with the others, and
//! copies an element's namespaces to each descendant that declares one. Its time and memory are quadratic or cubic.

mod count;
mod declaration;
pub mod element;
mod error;
mod limits;
mod markup;
pub mod number;
pub mod other_parts;
mod strict;
pub mod vocabulary;
mod words;
pub mod writer;

pub use count::check as check_limits;
pub use declaration::wrong_version;
pub use error::XmlError;
pub use limits::{Kind, MAX_ATTRIBUTES, MAX_LEVELS, MAX_NODES, MAX_PREFIXES, MAX_ROBOT_ELEMENTS};
pub use markup::root_name;
use roxmltree::{Document, ParsingOptions};
pub use strict::is_character;

/// Parses a document.
///
/// # Errors
/// [`XmlError`] if the document is not well-formed, declares entities, or exceeds a limit. For [`Kind::Robot`], also if
/// the XML declaration names a wrong version or encoding, or a name, prefix or reference is not one of XML 1.0 and its
/// namespaces.
pub fn parse(text: &str, kind: Kind) -> Result<Document<'_>, XmlError> {
    count::check(text, kind)?;
    if kind == Kind::Robot {
        declaration::check(text)?;
        strict::check(text)?;
    }
    let options = ParsingOptions {
        allow_dtd: kind == Kind::Robot,
        nodes_limit: u32::try_from(MAX_NODES).unwrap_or(u32::MAX),
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(XmlError::Parser)
}
