//! The URDD that is replaced.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde_json::Value;

use super::metadata::{GENERATOR, INPUTS_KEY};
use urdd_directory::digest;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{FileEntry, RootMetadata};

/// A URDD whose root metadata is readable.
#[derive(Debug)]
pub(super) struct Old {
    pub folder: PathBuf,
    pub root: Root,
    pub metadata: RootMetadata,
    /// The root metadata as a value, including keys that extend the format.
    pub value: Value,
}

impl Old {
    /// Reads the root metadata of a folder; `None` if it is missing or does not fit the format.
    pub fn read(folder: &Path) -> Option<Self> {
        let root = Root::open_folder(folder).ok()?;
        let bytes = root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES).ok()?;
        let value = json::read(&bytes).ok()?.value;
        let metadata = serde_json::from_value(value.clone()).ok()?;
        Some(Old {
            folder: folder.to_owned(),
            root,
            metadata,
            value,
        })
    }

    /// Whether this program wrote it.
    pub fn is_ours(&self) -> bool {
        let generator = self.metadata.generator.as_ref();
        generator.is_some_and(|generator| generator.name == GENERATOR)
    }

    /// The files of a module that was built from the same inputs, if they are all unchanged.
    pub fn kept(&self, kind: ModuleKind, version: &str, inputs: &str) -> Option<&[FileEntry]> {
        let mut entries = self
            .metadata
            .modules
            .iter()
            .zip(self.value["modules"].as_array()?);
        let (entry, value) = entries.find(|(entry, _)| entry.name == kind.name())?;
        let same = value[INPUTS_KEY].as_str() == Some(inputs)
            && entry.version.as_str() == version
            && entry.path == kind.folder();
        let intact = same && entry.files.iter().all(|file| self.is_intact(file));
        intact.then_some(entry.files.as_slice())
    }

    /// Whether a file matches its entry in the metadata.
    pub fn is_intact(&self, file: &FileEntry) -> bool {
        digest::of(&self.root, &file.path).is_ok_and(|(size, sha256)| {
            size == u64::from(file.size.0) && sha256 == file.sha256.as_str()
        })
    }
}

/// The document of a module of an intact URDD by this program, or the reason why it cannot be read.
pub(super) fn document<T: DeserializeOwned>(root: &Root, kind: ModuleKind) -> Result<T, String> {
    let path = format!("{}/module.json", kind.folder());
    let bytes = root.read(&path, MAX_DOCUMENT_BYTES);
    let bytes = bytes.map_err(|error| error.to_string())?;
    serde_json::from_slice(&bytes).map_err(|error| error.to_string())
}
