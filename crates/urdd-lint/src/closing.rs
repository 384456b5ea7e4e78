//! What is said of a robot's loops, in its URDF and beside it.

use std::path::PathBuf;
use std::sync::OnceLock;

use urdd_source::loops::{File, Said, beside};
use urdd_source::{Settings, SourceMeshes};

/// What is said of a robot's loops. What stands beside the URDF is read where a rule asks for it.
pub struct Closing<'a> {
    own: Option<&'a Said>,
    urdf: PathBuf,
    settings: &'a Settings,
    beside: OnceLock<Result<Option<Said>, String>>,
}

impl<'a> Closing<'a> {
    /// That of a URDF at a path.
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
