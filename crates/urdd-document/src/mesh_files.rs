//! Where the paths of mesh modules lead: in version 1 into the URDD itself, in legacy ones into it
//! or into a URDD beside it. Nothing else is ever opened.

use std::collections::HashMap;

use crate::urdd::Urdd;
use urdd_directory::path;
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::OpenFile;
use urdd_format::registry::Profile;

/// Why a mesh file cannot be had.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Absence {
    /// There is no such file.
    Missing,
    /// The path leads into a URDD of this name beside this one, and there is none.
    NoSibling(String),
    /// The path is not one that may be followed, or what is there cannot be read: what other rules
    /// report.
    Other(ReadError),
}

/// Follows paths of one URDD; remembers the URDDs beside it.
pub struct MeshFiles<'a> {
    urdd: &'a Urdd,
    own_name: String,
    siblings: HashMap<String, Option<Root>>,
}

impl<'a> MeshFiles<'a> {
    /// For a URDD.
    pub fn new(urdd: &'a Urdd) -> Self {
        MeshFiles {
            urdd,
            own_name: urdd.root().folder_name(),
            siblings: HashMap::new(),
        }
    }

    /// Path relative to the URDD's own root, where the path leads into it.
    pub fn own<'p>(&self, profile: Profile, path: &'p str) -> Option<&'p str> {
        match profile {
            Profile::V1 => Some(path),
            Profile::Legacy => path.strip_prefix(self.own_name.as_str())?.strip_prefix('/'),
        }
    }

    /// Whether there is a file at a path.
    ///
    /// # Errors
    /// Why there is none.
    pub fn find(&mut self, profile: Profile, path: &str) -> Result<(), Absence> {
        if let Some(own) = self.own(profile, path)
            && self.urdd.listing().has_file(own)
        {
            return Ok(());
        }
        self.open(profile, path).map(|_| ())
    }

    /// Opens the file at a path, and tells its size.
    ///
    /// # Errors
    /// Why it cannot be had.
    pub fn open(&mut self, profile: Profile, path: &str) -> Result<(OpenFile, u64), Absence> {
        path::check(path).map_err(|fault| Absence::Other(ReadError::Path(fault)))?;
        let opened = match self.own(profile, path) {
            Some(own) => self.urdd.root().open_file(own),
            None => {
                let (folder, rest) = path.split_once('/').ok_or(Absence::Missing)?;
                let urdd = self.urdd;
                let sibling = self
                    .siblings
                    .entry(folder.to_owned())
                    .or_insert_with(|| urdd.root().sibling(folder));
                match sibling {
                    Some(root) => root.open_file(rest),
                    None => return Err(Absence::NoSibling(folder.to_owned())),
                }
            }
        };
        opened.map_err(|error| match error {
            ReadError::Missing => Absence::Missing,
            other => Absence::Other(other),
        })
    }
}
