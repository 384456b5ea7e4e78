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

mod characters;
mod count;
mod doctype;
mod document;
pub mod element;
mod error;
mod limits;
mod markup;
mod mended;
pub mod number;
pub mod other_parts;
mod strict;
#[doc(hidden)]
pub mod tally;
pub mod tinyxml2;
pub mod vocabulary;
pub mod writer;
mod xml;

pub use characters::is_character;
pub use document::{Counted, Document, parse};
pub use error::XmlError;
pub use limits::{Kind, MAX_ATTRIBUTES, MAX_LEVELS, MAX_NODES, MAX_PREFIXES, MAX_ROBOT_ELEMENTS};
pub use markup::root_name;
pub use mended::{Mended, parse_leniently};
pub use quick_xml::escape::escape;
pub use roxmltree::{Attribute, Error as ParserError, Node, NodeId, StringStorage, TextPos};
pub use strict::wrong_version;
pub use xml::Xml;
