//! The SRDFs of a robot: each is read once, and parsed once for all rules.

use std::path::PathBuf;
use std::sync::OnceLock;

use crate::settings::LintSettings;
use urdd_source::Trail;
use urdd_xml::{Document, Xml, XmlError};

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
    /// That of a file.
    pub fn new(file: &'a SrdfFile) -> Self {
        Srdf { file, xml: OnceLock::new() }
    }

    /// Its XML, or why it is none.
    pub fn document(&self) -> Result<&Document<'a>, &XmlError> {
        self.xml.get_or_init(|| Xml::new(&self.file.text)).document()
    }
}

/// The SRDFs of a robot.
pub struct Srdfs<'a> {
    /// The settings by which those that are xacro are expanded, if they may be.
    pub xacro: Option<&'a LintSettings>,
    /// What may be one, read on first use.
    pub files: &'a OnceLock<Vec<SrdfFile>>,
    /// All that are, found on first use.
    pub all: OnceLock<Vec<Srdf<'a>>>,
}

impl<'a> Srdfs<'a> {
    /// Those that are xacro are expanded where the settings allow that.
    pub fn new(settings: &'a LintSettings, files: &'a OnceLock<Vec<SrdfFile>>) -> Self {
        let xacro = Some(settings).filter(|settings| settings.source.xacro.expand_urdf);
        Srdfs { xacro, files, all: OnceLock::new() }
    }
}
