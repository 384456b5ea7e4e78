//! A text that is parsed once, whoever reads it.

use crate::document::{Counted, Document, parse};
use crate::error::XmlError;
use crate::limits::Kind;

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
