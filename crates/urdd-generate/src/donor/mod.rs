//! Donors: the URDDs from which a new URDD takes over what need not be built again, or must not be lost. A donor is the
//! URDD that is replaced, or the URDD of a part of a combined robot.
//!
//! | what | from | when |
//! |---|---|---|
//! | a whole module: [`Donor::kept`] | the replaced URDD | its inputs are the same, and its files are unchanged |
//! | meshes and shapes of a link: [`links`] | parts | the link's geometry and the settings are the same |
//! | the user's edits of skips and named configurations: [`edits`] | the replaced URDD | always; edits that cannot be read are an error |
//! | all other files: [`others`] | the replaced URDD | always; a file in the way of the new URDD is an error |
//!
//! Modules and meshes are taken over only from URDDs of this version of the program, and only if their bytes match
//! `urdd.json`.
//!
//! One cache cannot serve for both. A module is kept whole, also where it is about pairs of links, which no link alone
//! determines; a part's links are in another robot under other indices, so they are found by content. Equal meshes
//! within a run (`distinct`) have no files yet by which to find them.

mod decided;
pub(super) mod edits;
pub(super) mod links;
pub(super) mod others;

use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::metadata::{self, GENERATOR, INPUTS_KEY, MODULE_VERSION};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_directory::{digest, json};
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{FileEntry, ModuleEntry, RootMetadata};

/// A URDD whose root metadata is readable.
#[derive(Debug)]
pub(super) struct Donor {
    pub root: Root,
    pub metadata: RootMetadata,
    /// The root metadata as a value, including keys that extend the format.
    pub value: Value,
}

impl Donor {
    /// Reads the root metadata of a URDD; `None` if it is missing or does not fit the format.
    pub fn open(root: Root) -> Option<Self> {
        let bytes = root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES).ok()?;
        let value = json::read(&bytes).ok()?.value;
        let metadata = RootMetadata::deserialize(&value).ok()?;
        Some(Donor { root, metadata, value })
    }

    pub fn is_ours(&self) -> bool {
        let generator = self.metadata.generator.as_ref();
        generator.is_some_and(|generator| generator.name == GENERATOR)
    }

    /// The folder and the files of a module that was built from the same inputs, if they are all unchanged.
    pub fn kept(&self, kind: ModuleKind, inputs: &str) -> Option<(&Path, &[FileEntry])> {
        let module = self.same(kind, inputs)?;
        let intact = module.files.iter().all(|file| self.is_intact(file));
        intact.then_some((self.root.folder()?, module.files.as_slice()))
    }

    /// The document of a module that this program would build from the same inputs now. `text` gives the module's input
    /// besides other modules.
    fn same_document<T: DeserializeOwned>(
        &self,
        kind: ModuleKind,
        text: &dyn Fn(ModuleKind) -> Option<String>,
    ) -> Option<T> {
        self.same(kind, &metadata::inputs(kind, &text(kind)?, self.metadata.modules.iter()))?;
        self.current_document(kind)
    }

    /// The document of a module of the version that this program writes.
    fn current_document<T: DeserializeOwned>(&self, kind: ModuleKind) -> Option<T> {
        self.current(kind)?;
        document(&self.root, kind).ok()
    }

    /// The entry of a module that was built from these inputs.
    fn same(&self, kind: ModuleKind, inputs: &str) -> Option<&ModuleEntry> {
        let (module, value) = self.current(kind)?;
        (value[INPUTS_KEY].as_str() == Some(inputs)).then_some(module)
    }

    /// The entry of a module with the version and the folder that this program gives it, also as a value.
    fn current(&self, kind: ModuleKind) -> Option<(&ModuleEntry, &Value)> {
        let values = self.value["modules"].as_array()?;
        let mut modules = self.metadata.modules.iter().zip(values);
        let (module, value) = modules.find(|(module, _)| module.name == kind.name())?;
        let is_current = module.version.as_str() == MODULE_VERSION && module.path == kind.folder();
        is_current.then_some((module, value))
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
    let bytes = root.read(&path, MAX_DOCUMENT_BYTES).map_err(|error| error.to_string())?;
    // From the text, without a tree of values: some documents grow with the square of the number of links.
    let text = std::str::from_utf8(&bytes).map_err(|error| error.to_string())?;
    serde_json::from_str(text).map_err(|error| error.to_string())
}
