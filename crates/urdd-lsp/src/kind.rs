//! What a document is.

use std::path::Path;

use serde_json::Value;

use crate::uri;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_type::FileType;
use urdd_directory::limits::MAX_VERSION_BYTES;
use urdd_directory::regular;
use urdd_directory::robot_file::{HEAD, RobotFile};
use urdd_document::load::{find_spec, metadata_of};
use urdd_document::schema_check::{self, SchemaViolation};
use urdd_format::registry::{ModuleKind, modules};
use urdd_format::schema::Subject;

/// What a document is.
#[derive(Clone, Copy)]
pub enum FileKind {
    Urdf,
    Xacro,
    /// `urdd.json`, or the document of a module, as JSON or YAML.
    Urdd {
        /// Its schema; `None` for an extension.
        schema: Option<Schema>,
        is_yaml: bool,
    },
    /// Nothing that is known here.
    Other,
}

impl FileKind {
    /// What a document is: by its text, by its name where that does not say, and then by its language.
    pub fn of(uri: &str, path: Option<&Path>, language: &str, text: &str) -> FileKind {
        let name = uri::file_name(uri);
        let language = language.to_lowercase();
        let most = usize::try_from(HEAD).unwrap_or(usize::MAX);
        let head = text.as_bytes().get(..most).unwrap_or(text.as_bytes());
        match RobotFile::of(Path::new(&name), head) {
            Some(RobotFile::Imported(_)) => return FileKind::Other,
            Some(RobotFile::Xacro) => return FileKind::Xacro,
            Some(RobotFile::Urdf) if FileType::Urdf.is_of(Path::new(&name)) => {
                return FileKind::Urdf;
            }
            Some(RobotFile::Urdf) if language != "xacro" => return FileKind::Urdf,
            _ => {}
        }
        if let Some(found) = path.and_then(Schema::of_file) {
            return found;
        }
        match language.as_str() {
            "urdf" => FileKind::Urdf,
            "xacro" => FileKind::Xacro,
            // A text that is not saved yet.
            "xml" if path.is_none() && !name.contains('.') => FileKind::Urdf,
            _ => FileKind::Other,
        }
    }

    pub fn is_of_urdd(self) -> bool {
        matches!(self, FileKind::Urdd { .. })
    }

    pub fn is_xml(self) -> bool {
        matches!(self, FileKind::Urdf | FileKind::Xacro)
    }
}

/// The schema of a document.
#[derive(Clone, Copy)]
pub struct Schema {
    /// The document that it is of.
    pub subject: Subject,
    /// Whether the document is a module of a later minor version.
    pub is_newer: bool,
}

impl Schema {
    /// What a file of a URDD is; `None` for other files.
    pub fn of_file(path: &Path) -> Option<FileKind> {
        let name = path.file_name()?.to_str()?;
        if name == ROOT_METADATA {
            let schema = Schema { subject: Subject::RootMetadata, is_newer: false };
            return Some(FileKind::Urdd { schema: Some(schema), is_yaml: false });
        }
        let is_yaml = match name {
            "module.json" => false,
            "module.yaml" => true,
            _ => return None,
        };
        let folder = path.parent()?;
        let module = folder.file_name()?.to_str()?;
        if !module.ends_with("_module") {
            return None;
        }
        let mut kinds = ModuleKind::ALL.iter().copied();
        let kind = kinds.find(|kind| kind.name() == module);
        Some(FileKind::Urdd {
            schema: kind.and_then(|kind| Schema::of_module(kind, folder)),
            is_yaml,
        })
    }

    /// The schema of a module in a folder, by its `VERSION`.
    fn of_module(kind: ModuleKind, folder: &Path) -> Option<Schema> {
        let text = regular::read(&folder.join("VERSION"), MAX_VERSION_BYTES).unwrap_or_default();
        let text = str::from_utf8(&text).unwrap_or_default().trim_end();
        let (spec, is_newer) = find_spec(kind, Some(text));
        // A module that somebody begins to write.
        let newest = || modules().iter().find(|spec| spec.kind == kind && text.is_empty());
        Some(Schema { subject: Subject::Module(spec.or_else(newest)?), is_newer })
    }

    /// How a document breaks it.
    pub fn violations(self, document: &Value) -> Vec<SchemaViolation> {
        match self.subject {
            Subject::Module(spec) => schema_check::read(spec, document, self.is_newer).1,
            _ => metadata_of(document).1,
        }
    }
}
