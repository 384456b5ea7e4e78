//! The door: whoever has a document has one that was counted.

use roxmltree::{Descendants, Node, ParsingOptions, TextPos};

use crate::error::{Kind, MAX_NODES, XmlError};
use crate::{check, tally};

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
    check::limits(text, kind)?;
    let not_default = if kind == Kind::Robot { check::strict(text)? } else { Vec::new() };
    tally::count("roxmltree");
    if !not_default.is_empty() {
        // Is the prefix declared, and the attribute there once?
        let mut renamed = text.to_owned();
        not_default.iter().for_each(|at| renamed.replace_range(*at..at + 5, "xml_s"));
        parsed(&renamed, kind)?;
    }
    parsed(text, kind).map(Document)
}

fn parsed(text: &str, kind: Kind) -> Result<roxmltree::Document<'_>, XmlError> {
    let options = ParsingOptions {
        allow_dtd: kind != Kind::Other,
        nodes_limit: u32::try_from(MAX_NODES).unwrap_or(u32::MAX),
        ..ParsingOptions::default()
    };
    roxmltree::Document::parse_with_options(text, options).map_err(XmlError::Parser)
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
    bytes: &'t [u8],
    document: Option<&'t Document<'t>>,
}

impl<'t> Counted<'t> {
    /// Counts a file, whatever its encoding.
    ///
    /// # Errors
    /// [`XmlError`] if it declares entities, or exceeds a limit.
    pub fn new(bytes: &'t [u8], kind: Kind) -> Result<Self, XmlError> {
        check::limits(&String::from_utf8_lossy(bytes), kind)?;
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

/// The text of a robot and its document, which all that read it borrow.
#[derive(Debug)]
pub struct Xml<'t> {
    text: &'t str,
    document: Result<Document<'t>, XmlError>,
}

impl<'t> Xml<'t> {
    /// Parses a text.
    pub fn new(text: &'t str) -> Self {
        Xml { text, document: parse(text, Kind::Robot) }
    }

    /// The text.
    pub fn text(&self) -> &'t str {
        self.text
    }

    /// The document, as [`parse`] gives it for [`Kind::Robot`].
    ///
    /// # Errors
    /// Those of [`parse`].
    pub fn document(&self) -> Result<&Document<'t>, &XmlError> {
        self.document.as_ref()
    }

    /// The bytes of the file that has this text, perhaps in another encoding.
    ///
    /// # Errors
    /// Those of [`Counted::new`].
    pub fn counted<'f>(&'f self, bytes: &'f [u8]) -> Result<Counted<'f>, XmlError> {
        match &self.document {
            Ok(document) if bytes == self.text.as_bytes() => {
                Ok(Counted { bytes, document: Some(document) })
            }
            _ => Counted::new(bytes, Kind::Robot),
        }
    }
}
