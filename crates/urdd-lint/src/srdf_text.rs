//! An SRDF of a robot.

use std::path::PathBuf;

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
