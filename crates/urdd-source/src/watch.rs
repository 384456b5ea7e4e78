//! Watches xacro, which does not say from where the elements of its output are: a module that Python loads in its place,
//! and that loads it, notes them. Where Python loads none of ours, nothing is known, and xacro runs all the same.

use std::io;
use std::path::PathBuf;
use std::process::Command;

use serde::Deserialize;

use crate::files::MAX_SOURCE_BYTES;
use urdd_directory::outputs;
use urdd_directory::regular;
use urdd_directory::temporary::Temporary;

const MODULE: &str = include_str!("watch.py");
/// Where the module writes.
const PLACES: &str = "URDD_XACRO_PLACES";

/// Where xacro has the elements of its output from, in the order of the output.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
pub struct Trail {
    /// The files, with symbolic links resolved.
    pub(super) files: Vec<PathBuf>,
    /// The file, the line and the column of each element; `None` for one that macros made of nothing.
    pub(super) elements: Vec<Option<(usize, u32, u32)>>,
}

/// A run of xacro that is watched.
pub(super) struct Watch(Temporary);

impl Watch {
    pub(super) fn begin() -> io::Result<Self> {
        let folder = Temporary::begin(&std::env::temp_dir(), "xacro")?;
        outputs::fresh(&folder.path().join("python/xacro/__init__.py"), MODULE.as_bytes())?;
        Ok(Watch(folder))
    }

    fn notes(&self) -> PathBuf {
        self.0.path().join("places.json")
    }

    /// The folder of the module: the first of those that Python looks in.
    pub(super) fn folder(&self) -> PathBuf {
        self.0.path().join("python")
    }

    /// Says where the module writes.
    pub(super) fn tell(&self, command: &mut Command) {
        command.env(PLACES, self.notes());
    }

    /// What it noted; nothing if it could not.
    pub(super) fn trail(&self) -> Trail {
        let text = regular::read(&self.notes(), MAX_SOURCE_BYTES).ok();
        text.and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
    }
}
