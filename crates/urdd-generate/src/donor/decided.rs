//! A module of the replaced URDD that holds a user's decisions. If it cannot be read, generation fails: a syntax error must
//! not discard a user's work.

use std::path::Path;

use serde_json::Value;

use super::Donor;
use crate::error::{EditsFault, GenerateError, Result};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::position::{self, Position};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::text_fault::{KEPT_PER_KIND, TextFaultKind};
use urdd_directory::{json, yaml};
use urdd_format::escape;
use urdd_format::registry::ModuleKind;

/// A module with decisions, in a folder that is to be replaced.
pub(super) struct Decided<'a> {
    pub folder: &'a Path,
    pub kind: ModuleKind,
    /// What the decisions are, for messages.
    pub what: &'static str,
    /// The members of its document that hold the decisions.
    pub keys: &'a [&'a str],
}

/// What is wrong with a document, with its JSON Pointer.
pub(super) type Fault = (String, String);

struct Document {
    value: Value,
    text: String,
}

impl Decided<'_> {
    /// The decisions, whatever else is wrong with the URDD; `None` if there is no such module. `parse` reads them from the
    /// document. The URDD is `replaced` if its root metadata is readable.
    /// Fails if there may be some and they cannot be read.
    pub fn read<T>(
        &self,
        replaced: Option<&Donor>,
        parse: impl FnOnce(&Root, &Value) -> Result<T, Fault>,
    ) -> Result<Option<T>> {
        let Ok(root) = Root::open(self.folder) else { return Ok(None) };
        let Some(document) = self.document(&root)? else { return Ok(None) };
        let decisions = parse(&root, &document.value).map_err(|(pointer, fault)| {
            let at = position::locate(&document.text, &pointer);
            self.unusable(&self.path("module.json"), at, fault)
        })?;
        self.check_mirror(&root, &document, replaced)?;
        Ok(Some(decisions))
    }

    /// The document; `None` if there is no such module.
    fn document(&self, root: &Root) -> Result<Option<Document>> {
        let (json_path, yaml_path) = (self.path("module.json"), self.path("module.yaml"));
        let bytes = match root.read(&json_path, MAX_DOCUMENT_BYTES) {
            Ok(bytes) => bytes,
            Err(ReadError::Missing) => {
                if let Err(ReadError::Missing) = root.read(&yaml_path, MAX_DOCUMENT_BYTES) {
                    return Ok(None);
                }
                let words = "this file may contain edits, but module.json is missing beside it";
                return Err(self.unusable(&yaml_path, None, words.to_owned()));
            }
            Err(error) => return Err(self.unreadable(&json_path, None, &error.to_string())),
        };
        let document = json::read(&bytes).map_err(|unreadable| {
            let first = unreadable.faults.iter().next();
            let words = first.map_or("", |fault| &fault.message);
            self.unreadable(&json_path, first.and_then(|fault| fault.position), words)
        })?;
        let twice = document.faults.iter().find(|fault| {
            let pointer = fault.pointer.as_deref().unwrap_or_default();
            fault.kind == TextFaultKind::DuplicateKey && self.is_of_decisions(pointer)
        });
        if let Some(twice) = twice {
            return Err(self.unreadable(&json_path, twice.position, &twice.message));
        }
        Ok(Some(Document { value: document.value, text: document.text.to_string() }))
    }

    /// Checks that the YAML file says the same. The user may have edited only that one. A YAML file that is still as
    /// generated is merely out of date.
    fn check_mirror(
        &self,
        root: &Root,
        document: &Document,
        replaced: Option<&Donor>,
    ) -> Result<()> {
        let path = self.path("module.yaml");
        if is_as_made(replaced, &path) {
            return Ok(());
        }
        let Ok(bytes) = root.read(&path, MAX_DOCUMENT_BYTES) else { return Ok(()) };
        let faults = yaml::check_mirror(&bytes, &document.value);
        // Only the first of many differences are kept, and those of decisions may be among the rest.
        let is_cut = faults.total(TextFaultKind::YamlDiffers) > KEPT_PER_KIND;
        let differs = faults.iter().find(|fault| match fault.kind {
            TextFaultKind::YamlDiffers => {
                is_cut || self.is_of_decisions(fault.pointer.as_deref().unwrap_or_default())
            }
            TextFaultKind::YamlSyntax | TextFaultKind::YamlNotUtf8 => true,
            _ => false,
        });
        let Some(fault) = differs else { return Ok(()) };
        let words = &fault.message;
        let words = format!("this file differs from module.json, which takes precedence: {words}");
        Err(self.unusable(&path, fault.position, words))
    }

    pub fn path(&self, file: &str) -> String {
        format!("{}/{file}", self.kind.folder())
    }

    pub fn refused(&self, path: &str, at: Option<Position>, fault: EditsFault) -> GenerateError {
        GenerateError::Edits { file: self.folder.join(path), at, lost: self.what, fault }
    }

    fn unusable(&self, path: &str, at: Option<Position>, words: String) -> GenerateError {
        self.refused(path, at, EditsFault::Unusable(escape::line(&words).into_owned()))
    }

    fn unreadable(&self, path: &str, at: Option<Position>, words: &str) -> GenerateError {
        self.unusable(path, at, format!("the file cannot be read: {words}"))
    }

    fn is_of_decisions(&self, pointer: &str) -> bool {
        pointer.split('/').nth(1).is_some_and(|key| self.keys.contains(&key))
    }
}

fn is_as_made(replaced: Option<&Donor>, path: &str) -> bool {
    let Some(replaced) = replaced else { return false };
    let mut files = replaced.metadata.modules.iter().flat_map(|module| &module.files);
    files.find(|file| file.path == path).is_some_and(|file| replaced.is_intact(file))
}

/// The names in a list of a module of the URDD, in its order, if they can be read.
pub(super) fn names(root: &Root, kind: ModuleKind, list: &str) -> Option<Vec<String>> {
    let path = format!("{}/module.json", kind.folder());
    let module = json::read(&root.read(&path, MAX_DOCUMENT_BYTES).ok()?).ok()?;
    let listed = module.value.get(list)?.as_array()?;
    listed.iter().map(|of| Some(of.get("name")?.as_str()?.to_owned())).collect()
}
