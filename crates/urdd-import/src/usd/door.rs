//! The files of a USD, by the gate.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_source::gate::Gate;
use urdd_usd::Door;

use super::super::fault::Unreachable;
use super::super::place::TextFile;

/// Reads layers by the gate of a description.
pub struct GateDoor<'g> {
    pub gate: &'g Gate,
    /// What was read, by the path that layers have.
    pub files: BTreeMap<String, TextFile>,
}

impl Door for GateDoor<'_> {
    fn read(&mut self, path: &str) -> Result<Arc<[u8]>, String> {
        if let Some(known) = self.files.get(path) {
            return Ok(Arc::clone(&known.bytes));
        }
        let found = match Path::new(path).is_absolute() {
            true => self.gate.at(Path::new(path)),
            false => self.gate.find(path),
        };
        let found = found.map_err(|why| Unreachable::of(path, why).to_string())?;
        let bytes = self.gate.bytes(&found, MAX_DOCUMENT_BYTES).map_err(|why| why.to_string())?;
        let bytes: Arc<[u8]> = bytes.into();
        let shown = found.file.display().to_string();
        let file = TextFile::any(shown, found.file, Arc::clone(&bytes));
        self.files.insert(path.to_owned(), file);
        Ok(bytes)
    }

    fn charge(&mut self, bytes: usize) -> Result<(), String> {
        self.gate.account().charge(bytes).map_err(|why| why.to_string())
    }
}

impl GateDoor<'_> {
    /// The file of a layer, which may be in a package.
    pub fn file(&self, layer: &str) -> Option<&TextFile> {
        let path = layer.split_once('[').map_or(layer, |(package, _)| package);
        self.files.get(path)
    }
}
