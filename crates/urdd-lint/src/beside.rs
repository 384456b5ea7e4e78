//! What a URDF says of files, and what stands beside it: SRDFs, loops.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use urdd_source::loops::{File, Said, beside};
use urdd_source::{Settings, SourceMeshes, Trail};
use urdd_xml::{Document, Node, Xml, XmlError};

#[derive(Debug, Clone, Copy)]
pub struct NamedFile<'a, 'n> {
    /// The element with the attribute `filename`.
    pub node: Node<'a, 'a>,
    pub name: &'n str,
}

impl<'n> NamedFile<'_, 'n> {
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

    pub fn path(&self) -> Option<&'n Path> {
        self.is_absolute().then(|| Path::new(self.without_scheme()))
    }

    fn without_scheme(&self) -> &'n str {
        let uri = |scheme| self.name.strip_prefix(scheme);
        uri("file://").or_else(|| uri("file:")).unwrap_or(self.name)
    }
}

/// What is said of a robot's loops. What stands beside the URDF is read where a rule asks for it.
pub struct Closing<'a> {
    own: Option<&'a Said>,
    urdf: PathBuf,
    settings: &'a Settings,
    beside: OnceLock<Result<Option<Said>, String>>,
}

impl<'a> Closing<'a> {
    pub fn new(source: Option<&'a SourceMeshes>, urdf: PathBuf, settings: &'a Settings) -> Self {
        let own = source.and_then(|source| source.loops.as_ref());
        Closing { own, urdf, settings, beside: OnceLock::new() }
    }

    /// The loops, as far as they can be read.
    pub fn loops(&self) -> Option<&File> {
        let beside = self.beside().ok().flatten();
        beside.or(self.own).map(|said| &said.file)
    }

    /// What a file beside the URDF says, if there is one.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn beside(&self) -> Result<Option<&Said>, &str> {
        let read = || beside(&self.urdf, self.settings).map_err(|error| error.to_string());
        let said = self.beside.get_or_init(read).as_ref();
        said.map(Option::as_ref).map_err(String::as_str)
    }
}

/// A file that may be an SRDF of the robot.
pub struct SrdfFile {
    /// Its path as seen from the URDF's folder.
    pub shown: String,
    pub path: PathBuf,
    pub text: String,
    /// Where xacro has the text from, if it made it.
    pub trail: Option<Trail>,
    /// Whether it is in the URDF's own package, not in one of MoveIt's beside it.
    pub is_own: bool,
    pub has_stem: bool,
}

/// An SRDF, parsed on first use.
pub struct Srdf<'a> {
    pub file: &'a SrdfFile,
    xml: OnceLock<Xml<'a>>,
}

impl<'a> Srdf<'a> {
    pub fn new(file: &'a SrdfFile) -> Self {
        Srdf { file, xml: OnceLock::new() }
    }

    pub fn document(&self) -> Result<&Document<'a>, &XmlError> {
        self.xml.get_or_init(|| Xml::new(&self.file.text)).document()
    }
}
