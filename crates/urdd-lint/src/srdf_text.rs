//! The SRDFs of a robot.

use std::path::PathBuf;
use std::sync::OnceLock;

use crate::settings::LintSettings;
use urdd_source::Trail;
use urdd_xml::{Document, XmlError};

/// An SRDF of the robot.
pub struct Srdf {
    /// Its path as seen from the URDF's folder.
    pub shown: String,
    pub path: PathBuf,
    pub text: String,
    /// Where xacro has the text from, if it made it.
    pub trail: Option<Trail>,
}

impl Srdf {
    /// Its XML, or why it is none.
    pub fn parse(&self) -> Result<Document<'_>, XmlError> {
        urdd_xml::parse(&self.text, urdd_xml::Kind::Robot)
    }
}

/// The SRDFs of a robot.
pub struct Srdfs<'a> {
    /// The settings by which those that are xacro are expanded, if they may be.
    pub xacro: Option<&'a LintSettings>,
    /// All, read on first use.
    pub all: OnceLock<Vec<Srdf>>,
}

impl<'a> Srdfs<'a> {
    /// Those that are xacro are expanded where the settings allow that.
    pub fn new(settings: &'a LintSettings) -> Self {
        let xacro = Some(settings).filter(|settings| settings.source.xacro.expand_urdf);
        Srdfs { xacro, all: OnceLock::new() }
    }
}
