//! The door: whoever has a document has one that was counted.

use roxmltree::{Descendants, Node, ParsingOptions, TextPos};

use crate::error::XmlError;
use crate::limits::{Kind, MAX_NODES};
use crate::{count, strict, tally};

/// A document within the limits. Only [`parse`] makes one.
#[derive(Debug)]
pub struct Document<'t>(roxmltree::Document<'t>);

/// Parses a document.
///
/// # Errors
/// [`XmlError`] if the document is not well-formed, declares entities, or exceeds a limit. For [`Kind::Robot`], also if
/// the XML declaration names a wrong version or encoding, or a name, prefix or reference is not one of XML 1.0 and its
/// namespaces.
pub fn parse(text: &str, kind: Kind) -> Result<Document<'_>, XmlError> {
    count::check(text, kind)?;
    if kind == Kind::Robot {
        strict::check_declaration(text)?;
        strict::check(text)?;
    }
    tally::count("roxmltree");
    let options = ParsingOptions {
        allow_dtd: kind != Kind::Other,
        nodes_limit: u32::try_from(MAX_NODES).unwrap_or(u32::MAX),
        ..ParsingOptions::default()
    };
    let document = roxmltree::Document::parse_with_options(text, options);
    document.map(Document).map_err(XmlError::Parser)
}

impl<'t> Document<'t> {
    /// The outermost element.
    pub fn root_element(&self) -> Node<'_, 't> {
        self.0.root_element()
    }

    /// All nodes, in document order.
    pub fn descendants(&self) -> Descendants<'_, 't> {
        self.0.descendants()
    }

    /// The text that was parsed.
    pub fn input_text(&self) -> &'t str {
        self.0.input_text()
    }

    /// The node of an identifier.
    pub fn get_node(&self, id: roxmltree::NodeId) -> Option<Node<'_, 't>> {
        self.0.get_node(id)
    }

    /// The line and column of a byte. Each call counts from the beginning of the text.
    pub fn text_pos_at(&self, at: usize) -> TextPos {
        self.0.text_pos_at(at)
    }
}

/// The bytes of a file within the limits: what a reader takes that parses XML by its own code.
#[derive(Debug, Clone, Copy)]
pub struct Counted<'t> {
    pub(crate) bytes: &'t [u8],
    pub(crate) document: Option<&'t Document<'t>>,
}

impl<'t> Counted<'t> {
    /// Counts a file, whatever its encoding.
    ///
    /// # Errors
    /// [`XmlError`] if it declares entities, or exceeds a limit.
    pub fn new(bytes: &'t [u8], kind: Kind) -> Result<Self, XmlError> {
        count::check(&String::from_utf8_lossy(bytes), kind)?;
        Ok(Counted { bytes, document: None })
    }

    /// The bytes.
    pub fn bytes(self) -> &'t [u8] {
        self.bytes
    }

    /// Its document, where that is known.
    pub fn document(self) -> Option<&'t Document<'t>> {
        self.document
    }
}
