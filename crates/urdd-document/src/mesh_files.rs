//! Resolves the paths of mesh modules: in version 1 inside the URDD, in legacy versions inside it or a sibling URDD.
//! Never opens anything else.

use std::collections::HashMap;

use thiserror::Error;

use crate::urdd::Urdd;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::path;
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::OpenFile;
use urdd_format::registry::Profile;

/// Why a mesh file is not available.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Absence {
    #[error("there is no such file")]
    Missing,
    #[error("it is in the URDD `{}`, which is not beside this one", .0.escape_debug())]
    NoSibling(String),
    /// The path is invalid, or the file cannot be read. Other rules report this.
    #[error(transparent)]
    Other(ReadError),
}

/// Resolves the paths of one URDD, and caches its siblings.
pub struct MeshFiles<'a> {
    urdd: &'a Urdd,
    own_name: String,
    siblings: HashMap<String, Option<Root>>,
}

impl<'a> MeshFiles<'a> {
    /// A resolver for a URDD.
    pub fn new(urdd: &'a Urdd) -> Self {
        MeshFiles { urdd, own_name: urdd.root().folder_name(), siblings: HashMap::new() }
    }

    /// The path relative to the URDD's root, if it is inside the URDD.
    pub fn own<'p>(&self, profile: Profile, path: &'p str) -> Option<&'p str> {
        match profile {
            Profile::V1 => Some(path),
            Profile::Legacy => path.strip_prefix(self.own_name.as_str())?.strip_prefix('/'),
        }
    }

    /// Checks that there is a file at a path.
    ///
    /// # Errors
    /// Why it is not available.
    pub fn find(&mut self, profile: Profile, path: &str) -> Result<(), Absence> {
        if let Some(own) = self.own(profile, path)
            && self.urdd.listing().has_file(own)
        {
            return Ok(());
        }
        self.open(profile, path).map(|_| ())
    }

    /// Opens the file at a path, and returns its size.
    ///
    /// # Errors
    /// Why it is not available.
    pub fn open(&mut self, profile: Profile, path: &str) -> Result<(OpenFile, u64), Absence> {
        self.at(profile, path, Root::open_file)
    }

    /// The bytes of the file at a path.
    ///
    /// # Errors
    /// Why it is not available, or too large.
    pub fn read(&mut self, profile: Profile, path: &str) -> Result<Vec<u8>, Absence> {
        self.at(profile, path, |root, path| root.read(path, MAX_DOCUMENT_BYTES))
    }

    fn at<T>(
        &mut self,
        profile: Profile,
        path: &str,
        get: impl FnOnce(&Root, &str) -> Result<T, ReadError>,
    ) -> Result<T, Absence> {
        path::check(path).map_err(|fault| Absence::Other(ReadError::Path(fault)))?;
        let got = match self.own(profile, path) {
            Some(own) => get(self.urdd.root(), own),
            None => {
                let (folder, rest) = path.split_once('/').ok_or(Absence::Missing)?;
                let urdd = self.urdd;
                let sibling = self
                    .siblings
                    .entry(folder.to_owned())
                    .or_insert_with(|| urdd.root().sibling(folder));
                match sibling {
                    Some(root) => get(root, rest),
                    None => return Err(Absence::NoSibling(folder.to_owned())),
                }
            }
        };
        got.map_err(|error| match error {
            ReadError::Missing => Absence::Missing,
            other => Absence::Other(other),
        })
    }
}
