//! The source URDF as data.

use super::Robot;
use super::error::RobotError;
use urdd_directory::read_error::ReadError;
use urdd_document::carried_urdf::read_file;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::Source;
use urdd_format::urdf::UrdfModule;

/// The file that a URDD was generated from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// The file's path in the URDD.
    pub path: String,
    /// The SHA-256 of its content, as 64 hexadecimal digits.
    pub sha256: String,
}

impl Robot {
    /// The robot's URDF as data: links with mass, visuals and collisions, joints with limits. Link and joint indices
    /// refer to this order. Zeros that a legacy URDD writes for missing values are absent here.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    pub fn description(&self) -> Result<UrdfModule, RobotError> {
        let part = self.part(&[ModuleKind::Urdf])?;
        part.description().cloned().ok_or(RobotError::Missing(ModuleKind::Urdf))
    }

    /// The source URDF that the URDD includes, according to its metadata. `None` if there is none, or in a legacy URDD.
    ///
    /// # Errors
    /// If the files cannot be listed.
    pub fn source(&self) -> Result<Option<SourceFile>, RobotError> {
        let part = self.part_as_it_is(&[])?;
        let source = part.metadata().and_then(|metadata| metadata.source.as_ref());
        Ok(source.map(|Source::Urdf(file)| SourceFile {
            path: file.path.clone(),
            sha256: file.sha256.to_string(),
        }))
    }

    /// The text of the source URDF. `None` if there is none, or it cannot be read.
    ///
    /// # Errors
    /// If the files cannot be listed, or this one changed on disk.
    pub fn source_text(&self) -> Result<Option<String>, RobotError> {
        let Some(file) = self.source()? else { return Ok(None) };
        match read_file(self.root(), &file.path) {
            Err(ReadError::Changed) => Err(RobotError::Changed(self.folder_name())),
            read => Ok(read.ok().map(|read| read.text)),
        }
    }
}
