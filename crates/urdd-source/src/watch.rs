//! Watches xacro, which does not say from where the elements of its output are: a module that Python loads in its place,
//! and that loads it, notes them. Where Python loads none of ours, nothing is known, and xacro runs all the same.

use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use crate::files::MAX_SOURCE_BYTES;
use urdd_directory::outputs;
use urdd_directory::regular;
use urdd_directory::temporary::Temporary;

const MODULE: &str = include_str!("watch.py");
/// Where the module writes.
const PLACES: &str = "URDD_XACRO_PLACES";
const PYTHON: &str = "PYTHONPATH";

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

    /// Has the command's Python load the module.
    pub(super) fn tell(&self, command: &mut Command) {
        let set = command.get_envs().find(|(name, _)| *name == PYTHON);
        let set = set.and_then(|(_, paths)| paths.map(ToOwned::to_owned));
        let paths = set.or_else(|| std::env::var_os(PYTHON)).unwrap_or_default();
        let own = self.0.path().join("python");
        let all = std::env::split_paths(&paths).filter(|path| path != Path::new(""));
        if let Ok(paths) = std::env::join_paths(std::iter::once(own).chain(all)) {
            command.env(PYTHON, paths).env(PLACES, self.notes());
        }
    }

    /// What it noted; nothing if it could not.
    pub(super) fn trail(&self) -> Trail {
        let text = regular::read(&self.notes(), MAX_SOURCE_BYTES).ok();
        text.and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
    }
}
