//! A file that the URDF names, by the text of its name.

use std::path::Path;

use urdd_xml::Node;

/// A file that the URDF names.
#[derive(Debug, Clone, Copy)]
pub struct NamedFile<'a, 'n> {
    /// The element with the attribute `filename`.
    pub node: Node<'a, 'a>,
    pub name: &'n str,
}

impl<'n> NamedFile<'_, 'n> {
    /// Whether it is an absolute path.
    pub fn is_absolute(&self) -> bool {
        let path = self.without_scheme();
        let mut first = path.chars();
        let is_drive = first.next().is_some_and(|letter| letter.is_ascii_alphabetic())
            && first.next() == Some(':')
            && matches!(first.next(), Some('/' | '\\'));
        path.starts_with('/') || is_drive
    }

    /// Whether a word that is no path follows `file://`.
    pub fn is_on_a_host(&self) -> bool {
        let rest = self.name.strip_prefix("file://");
        rest.is_some_and(|rest| !rest.starts_with('/') && !self.is_absolute())
    }

    /// Whether some programs fetch it over the network.
    pub fn is_fetched(&self) -> bool {
        let schemes = ["http://", "https://", "ftp://"];
        schemes.iter().any(|scheme| self.name.starts_with(scheme))
    }

    /// The path, if it is absolute.
    pub fn path(&self) -> Option<&'n Path> {
        self.is_absolute().then(|| Path::new(self.without_scheme()))
    }

    fn without_scheme(&self) -> &'n str {
        let uri = |scheme| self.name.strip_prefix(scheme);
        uri("file://").or_else(|| uri("file:")).unwrap_or(self.name)
    }
}
