//! What a document is.

use std::fs;
use std::path::Path;

use crate::uri;
use urdd_directory::discover::ROOT_METADATA;
use urdd_format::registry::{self, ModuleKind, ModuleSpec, modules};

/// What a document is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Kind {
    /// A URDF.
    Urdf,
    /// A xacro file.
    Xacro,
    /// `urdd.json`, or the document of a module, as JSON or YAML.
    Urdd {
        /// Its schema; `None` for an extension.
        schema: Option<Schema>,
        /// Whether it is YAML.
        is_yaml: bool,
    },
    /// Nothing that is known here.
    Other,
}

impl Kind {
    /// What a document is, by its name; by its language if it has no name with an extension.
    pub fn of(uri: &str, path: Option<&Path>, language: &str) -> Kind {
        let name = uri::file_name(uri).to_lowercase();
        if name.ends_with(".urdf") {
            return Kind::Urdf;
        }
        if name.ends_with(".xacro") {
            return Kind::Xacro;
        }
        if let Some(found) = path.and_then(Schema::of_file) {
            return found;
        }
        match language.to_lowercase().as_str() {
            "urdf" => Kind::Urdf,
            "xacro" => Kind::Xacro,
            // A text that is not saved yet.
            "xml" if path.is_none() && !name.contains('.') => Kind::Urdf,
            _ => Kind::Other,
        }
    }

    /// Whether it is XML.
    pub fn is_xml(&self) -> bool {
        matches!(self, Kind::Urdf | Kind::Xacro)
    }
}

/// The schema of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Schema {
    /// Of `urdd.json`.
    Root,
    /// Of a module: its index in [`modules`], and whether the document is of a later minor version.
    Module(usize, bool),
}

impl Schema {
    /// What a file of a URDD is; `None` for other files.
    pub fn of_file(path: &Path) -> Option<Kind> {
        let name = path.file_name()?.to_str()?;
        if name == ROOT_METADATA {
            return Some(Kind::Urdd { schema: Some(Schema::Root), is_yaml: false });
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
        Some(Kind::Urdd { schema: kind.and_then(|kind| Schema::of_module(kind, folder)), is_yaml })
    }

    /// The schema of a module in a folder, by its `VERSION`: as the validator chooses it.
    fn of_module(kind: ModuleKind, folder: &Path) -> Option<Schema> {
        let text = fs::read_to_string(folder.join("VERSION")).unwrap_or_default();
        let text = text.trim_end();
        let of = |spec: &ModuleSpec| {
            modules()
                .iter()
                .position(|other| other.kind == spec.kind && other.version == spec.version)
        };
        if let Some(spec) = registry::find(kind, text) {
            return Some(Schema::Module(of(spec)?, false));
        }
        if text.is_empty() {
            // A module that somebody begins to write.
            let newest = modules().iter().find(|spec| spec.kind == kind)?;
            return Some(Schema::Module(of(newest)?, false));
        }
        let version = semver::Version::parse(text).ok()?;
        let known = modules().iter().filter(|spec| spec.kind == kind);
        let known =
            known.filter_map(|spec| Some((semver::Version::parse(spec.version).ok()?, spec)));
        let newest = known
            .filter(|(known, _)| {
                known.major == version.major && *known < version && known.major >= 1
            })
            .max_by(|a, b| a.0.cmp(&b.0));
        Some(Schema::Module(of(newest?.1)?, true))
    }
}
