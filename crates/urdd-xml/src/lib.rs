//! Internal to urdd; no stability promise.
//!
//! Parses untrusted XML, and writes numbers as it has them. This crate does not know the URDD format.
//!
//! Before parsing, this crate limits what a small file can use to exhaust time or memory: nesting depth, elements,
//! attributes, prefixes, namespaces and entity declarations. `roxmltree` compares each attribute of an element with the
//! others, with the namespaces of both, and copies an element's namespaces to each descendant that declares one. Its time
//! and memory are quadratic or cubic.
//!
//! No other crate depends on `roxmltree` (`tests/program/parsers.rs`). Readers with parsers of their own take a
//! [`Counted`].

mod check;
mod document;
pub mod element;
mod error;
pub mod foreign;
mod mended;
pub mod number;
pub mod other_parts;
mod prolog;
#[doc(hidden)]
pub mod tally;
pub mod tinyxml2;
pub mod writer;

pub use check::{root_name, wrong_version};
pub use document::{Counted, Document, Xml, parse};
pub use error::{
    Kind, MAX_ATTRIBUTES, MAX_LEVELS, MAX_NODES, MAX_PREFIXES, MAX_ROBOT_ELEMENTS, XmlError,
};
pub use mended::{Mended, parse_leniently};
pub use prolog::is_character;
pub use quick_xml::escape::escape;
pub use roxmltree::{Attribute, Error as ParserError, Node, NodeId, StringStorage, TextPos};
