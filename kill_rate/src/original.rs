//! The unmodified URDD in memory.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;
use thiserror::Error;

use super::reach;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::{EntryKind, ReadError, Root};
use urdd_format::registry::{self, ModuleKind, Profile};
use urdd_format::root_metadata::RootMetadata;

/// Why a URDD cannot be used for measuring.
#[derive(Debug, Error)]
pub enum OriginalError {
    /// A file cannot be read.
    #[error("{path}: {error}")]
    Read {
        /// The file, relative to the root.
        path: String,
        /// What is wrong.
        error: ReadError,
    },
    /// A document is not JSON.
    #[error("{path} is not JSON; `urdd validate` says more")]
    NotJson {
        /// The file, relative to the root.
        path: String,
    },
    /// It has no root metadata.
    #[error("{ROOT_METADATA} is missing: only URDDs of version 1 can be measured with")]
    Legacy,
}

/// A document of a URDD: a module's, or the root metadata.
pub(crate) struct Document {
    /// Its name in reports: the module's name, or `urdd.json`.
    pub name: String,
    /// Its JSON file.
    pub file: String,
    /// Its YAML mirror, if any.
    pub mirror: Option<String>,
    /// Its value.
    pub value: Value,
    /// Its published schema.
    pub schema: Value,
}

/// A URDD before any mutation.
pub(crate) struct Original {
    /// Every file by path.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Names and folders of the known modules, in the order of the specification.
    pub modules: Vec<(&'static str, &'static str)>,
    /// The documents of modules in the order of the specification, with the root metadata last.
    pub documents: Vec<Document>,
    /// The robot's reach (SPEC 5.6), m.
    pub reach: f64,
    /// The largest absolute number among the shapes' positions and sizes, m.
    pub shapes: f64,
}

impl Original {
    pub(crate) fn read(path: &Path) -> Result<Self, OriginalError> {
        let files = read_files(path)?;
        let value = |file: &str| -> Result<Value, OriginalError> {
            let bytes = files.get(file).map_or(&[][..], Vec::as_slice);
            let document = json::read(bytes);
            let document =
                document.map_err(|_| OriginalError::NotJson { path: file.to_owned() })?;
            Ok(document.value)
        };
        if !files.contains_key(ROOT_METADATA) {
            return Err(OriginalError::Legacy);
        }
        let known: Vec<&ModuleKind> = ModuleKind::ALL
            .iter()
            .filter(|kind| files.contains_key(&format!("{}/module.json", kind.folder())))
            .collect();
        let mut documents = Vec::new();
        for kind in &known {
            let file = format!("{}/module.json", kind.folder());
            let mirror = format!("{}/module.yaml", kind.folder());
            let spec = registry::modules()
                .iter()
                .find(|spec| spec.kind == **kind && spec.profile == Profile::V1);
            let Some(spec) = spec else { continue };
            documents.push(Document {
                name: kind.name().to_owned(),
                value: value(&file)?,
                mirror: files.contains_key(&mirror).then_some(mirror),
                file,
                schema: spec.schema().to_value(),
            });
        }
        documents.push(Document {
            name: ROOT_METADATA.to_owned(),
            file: ROOT_METADATA.to_owned(),
            mirror: None,
            value: value(ROOT_METADATA)?,
            schema: schemars::schema_for!(RootMetadata).to_value(),
        });
        let of = |name: &str| documents.iter().find(|document| document.name == name);
        let reach = reach::reach(
            of("chain_module").map(|document| &document.value),
            of("urdf_module").map(|document| &document.value),
        );
        Ok(Original {
            modules: known.iter().map(|k| (k.name(), k.folder())).collect(),
            files,
            shapes: of("link_shapes_approximations_module").map_or(0.0, |d| largest(&d.value)),
            reach,
            documents,
        })
    }

    /// The document of a module, or `urdd.json`.
    pub(crate) fn document(&self, name: &str) -> Option<&Document> {
        self.documents.iter().find(|document| document.name == name)
    }

    /// The root metadata.
    pub(crate) fn metadata(&self) -> &Value {
        self.document(ROOT_METADATA).map_or(&Value::Null, |document| &document.value)
    }

    /// Path of the source URDF.
    pub(crate) fn source(&self) -> Option<&str> {
        self.metadata().pointer("/source/Urdf/path")?.as_str()
    }

    /// Name and folder of the module that contains a file.
    pub(crate) fn module_of(&self, path: &str) -> Option<(&'static str, &'static str)> {
        self.modules
            .iter()
            .copied()
            .find(|(_, folder)| path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/')))
    }
}

/// The largest absolute number in a document, except angles.
fn largest(value: &Value) -> f64 {
    match value {
        Value::Number(number) => number.as_f64().map_or(0.0, f64::abs),
        Value::Array(list) => list.iter().map(largest).fold(0.0, f64::max),
        Value::Object(object) => {
            let lengths = object.iter().filter(|(key, _)| *key != "offset_rpy");
            lengths.map(|(_, value)| largest(value)).fold(0.0, f64::max)
        }
        _ => 0.0,
    }
}

fn read_files(path: &Path) -> Result<BTreeMap<String, Vec<u8>>, OriginalError> {
    let failed = |path: &str| {
        let path = path.to_owned();
        move |error| OriginalError::Read { path, error }
    };
    let root = Root::open(path).map_err(failed("."))?;
    let listing = root.list().map_err(failed("."))?;
    let files = listing.entries.into_iter().filter(|entry| entry.kind == EntryKind::File);
    files
        .map(|entry| {
            let bytes = root.read(&entry.path, MAX_DOCUMENT_BYTES);
            Ok((entry.path.clone(), bytes.map_err(failed(&entry.path))?))
        })
        .collect()
}
