//! The files of a URDD that change when a user edits a module.

use std::collections::BTreeMap;

use serde_json::Value;

use super::Robot;
use super::error::RobotError;
use super::robot::of_read;
use urdd_directory::canonical;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_entry;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::ReadError;
use urdd_format::registry::ModuleKind;

/// Files by path relative to the root.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The version of the modules that this program writes.
const VERSION: &str = "1.0.0";

impl Robot {
    /// A module's JSON and YAML from its document, and `urdd.json` with their sizes and hashes. A module that the URDD lacks is added.
    pub(super) fn edited_files(
        &self,
        kind: ModuleKind,
        document: serde_json::Result<Value>,
    ) -> Result<Files, RobotError> {
        let document = document
            .map_err(|error| RobotError::Unusable { module: kind, reason: error.to_string() })?;
        let path = |name: &str| format!("{}/{name}", kind.folder());
        let (json, yaml) = (canonical::json_string(&document), canonical::yaml_string(&document));
        let mut files = Files::from([
            (path("module.json"), json.into_bytes()),
            (path("module.yaml"), yaml.into_bytes()),
        ]);
        // Not from what was kept: an edit of a URDD that changed meanwhile would undo that change.
        let text = self.root().read(ROOT_METADATA, MAX_DOCUMENT_BYTES);
        let metadata = |error: ReadError| RobotError::Metadata(error.to_string());
        let text = text.map_err(|error| of_read(self.root(), error, metadata))?;
        let metadata = json::read(&text);
        let metadata = metadata.map_err(|error| RobotError::Metadata(error.to_string()))?;
        let mut metadata = metadata.value;
        let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
        let modules =
            modules.ok_or_else(|| RobotError::Metadata("`modules` is missing".to_owned()))?;
        if !modules.iter().any(|module| module["name"] == kind.name()) {
            files.insert(path("VERSION"), format!("{VERSION}\n").into_bytes());
            let own = files.iter();
            let own = own.map(|(path, bytes)| (path.clone(), bytes.as_slice()));
            let (name, folder) = (kind.name(), kind.folder());
            file_entry::insert_module(modules, name, VERSION, folder, kind.depends_on(), own);
        }
        file_entry::reseal(&mut metadata, |path| files.get(path).map(Vec::as_slice));
        let metadata = canonical::json_string(&metadata).into_bytes();
        files.insert(ROOT_METADATA.to_owned(), metadata);
        Ok(files)
    }
}
