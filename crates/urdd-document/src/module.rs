//! What is in a URDD, as far as it is readable: `urdd.json`, a module, the source URDF.

use std::fmt;

use thiserror::Error;

use crate::schema_check::SchemaViolation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_type::{Foreign, foreign};
use urdd_directory::json::{self, JsonDocument};
use urdd_directory::limits::MAX_URDF_BYTES;
use urdd_directory::position;
use urdd_directory::position::TextFaults;
use urdd_directory::root::{EntryKind, Listing, ReadError, Root};
use urdd_format::registry::{ModuleDocument, ModuleKind, ModuleSpec, Profile};
use urdd_format::root_metadata::{RootMetadata, Source};

/// A JSON file, as far as it is readable.
pub enum JsonFile {
    /// The file is missing.
    Missing,
    /// The file exists but cannot be read.
    Unreadable(ReadError),
    /// It is not JSON.
    Broken(TextFaults),
    /// It is JSON.
    Read(Box<JsonDocument>),
    /// Faultless JSON, parsed directly into the module's types without keeping the JSON value. The text is empty if
    /// positions are not needed.
    Taken(String),
}

impl JsonFile {
    pub(crate) fn of(bytes: Result<Vec<u8>, ReadError>) -> Self {
        match bytes {
            Err(ReadError::Missing) => JsonFile::Missing,
            Err(error) => JsonFile::Unreadable(error),
            Ok(bytes) => match json::read(&bytes) {
                Ok(document) => JsonFile::Read(Box::new(document)),
                Err(unreadable) => JsonFile::Broken(unreadable.faults),
            },
        }
    }

    /// The document as JSON, if it is readable and was kept.
    pub fn document(&self) -> Option<&JsonDocument> {
        match self {
            JsonFile::Read(document) => Some(document),
            _ => None,
        }
    }

    /// Why it cannot be read, if it exists.
    pub fn unreadable(&self) -> Option<&ReadError> {
        match self {
            JsonFile::Unreadable(error) => Some(error),
            _ => None,
        }
    }

    /// Its text, if it is JSON.
    pub fn text(&self) -> Option<&str> {
        match self {
            JsonFile::Read(document) => Some(&document.text),
            JsonFile::Taken(text) => Some(text),
            _ => None,
        }
    }

    /// Faults of its text.
    pub fn faults(&self) -> Option<&TextFaults> {
        match self {
            JsonFile::Broken(faults) => Some(faults),
            JsonFile::Read(document) => Some(&document.faults),
            _ => None,
        }
    }
}

/// The YAML mirror of a document.
pub enum Mirror {
    /// The file is missing.
    Missing,
    /// The file exists but cannot be read.
    Unreadable(ReadError),
    /// Not compared, because the JSON is not readable.
    NotCompared,
    /// Compared, with the faults found.
    Compared(TextFaults),
}

/// A module's `VERSION` file.
pub enum VersionFile {
    /// The file is missing.
    Missing,
    /// The file exists but cannot be read.
    Unreadable(ReadError),
    /// Its text, without the final newline.
    Text(String),
}

/// The root metadata file.
pub struct MetadataFile {
    /// The file.
    pub json: JsonFile,
    /// Its schema violations.
    pub violations: Vec<SchemaViolation>,
    /// The parsed metadata, if it fits its schema.
    pub metadata: Option<RootMetadata>,
}

/// A module folder.
pub struct Module {
    /// Path of the folder, relative to the root.
    pub folder: String,
    /// The module of the registry; `None` for extensions and unknown modules.
    pub kind: Option<ModuleKind>,
    /// Its `VERSION` file.
    pub version_file: VersionFile,
    /// The version from its `VERSION` file or from the root metadata.
    pub version: Option<String>,
    /// The registry's entry that it is checked against.
    pub spec: Option<&'static ModuleSpec>,
    /// Whether its version is newer than all known ones, so that it is checked as the newest.
    pub newer: bool,
    /// Its `module.json`.
    pub json: JsonFile,
    /// Its `module.yaml`.
    pub mirror: Mirror,
    /// Schema violations of the document.
    pub violations: Vec<SchemaViolation>,
    /// The document, if it fits its schema; raised to version 1 where it can be.
    pub document: Option<ModuleDocument>,
    /// Whether the document breaks its schema only as a draft does: see [`crate::schema_check`].
    pub is_draft: bool,
}

impl Module {
    /// Path of a file of the module, relative to the root.
    pub fn file(&self, name: &str) -> String {
        format!("{}/{name}", self.folder)
    }

    /// Last part of its folder's path.
    pub fn name(&self) -> &str {
        self.folder.rsplit('/').next().unwrap_or(&self.folder)
    }

    /// Whether its version is from before the specification.
    pub fn is_legacy(&self) -> bool {
        self.spec.is_some_and(|spec| spec.profile == Profile::Legacy)
    }

    /// Why one of its files cannot be read, if it exists.
    pub fn unreadable(&self) -> Option<&ReadError> {
        match &self.version_file {
            VersionFile::Unreadable(error) => Some(error),
            _ => self.json.unreadable(),
        }
    }

    /// Why its document is unusable; `None` if it is usable.
    pub fn unusable(&self) -> Option<Unusable> {
        let why = match (&self.json, &self.document) {
            (_, Some(_)) => return None,
            (JsonFile::Missing, _) => DocumentFault::Missing,
            (JsonFile::Unreadable(_), _) => DocumentFault::Unreadable,
            (JsonFile::Broken(_), _) => DocumentFault::NotJson,
            (JsonFile::Read(_) | JsonFile::Taken(_), None) => match self.spec {
                None => DocumentFault::UnknownVersion(self.version.clone()),
                Some(_) if self.is_draft => DocumentFault::IsDraft,
                Some(_) => DocumentFault::BreaksSchema,
            },
        };
        Some(Unusable { folder: self.folder.clone(), why })
    }

    /// The first fault of its document with its position: `file:line:column: message`.
    pub fn first_fault(&self) -> Option<String> {
        let file = self.file("module.json");
        let (position, message) = match &self.json {
            JsonFile::Broken(faults) => {
                let fault = faults.iter().next()?;
                (fault.position, fault.message.clone())
            }
            JsonFile::Read(document) => {
                let violation = self.violations.first()?;
                let position = position::locate(&document.text, &violation.pointer);
                let message = format!("{}: {}", violation.pointer, violation.message);
                (position, message)
            }
            JsonFile::Unreadable(error) => (None, error.to_string()),
            JsonFile::Missing | JsonFile::Taken(_) => return None,
        };
        Some(match position {
            Some(position) => format!("{file}:{position}: {message}"),
            None => format!("{file}: {message}"),
        })
    }
}

/// A module with an unusable document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unusable {
    /// The module's folder, relative to the root.
    pub folder: String,
    /// Reason.
    pub why: DocumentFault,
}

/// Why a document is unusable.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DocumentFault {
    /// `module.json` is missing.
    Missing,
    /// It cannot be read.
    Unreadable,
    /// It is not JSON.
    NotJson,
    /// The module's version is unknown or missing.
    UnknownVersion(Option<String>),
    /// It follows a draft of urdd 0.1.0 or 0.2.0.
    IsDraft,
    /// It breaks its schema.
    BreaksSchema,
}

impl fmt::Display for Unusable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let folder = &self.folder;
        let name = folder.rsplit('/').next().unwrap_or(folder);
        match &self.why {
            DocumentFault::Missing => write!(f, "{folder}/module.json is missing"),
            DocumentFault::Unreadable => write!(f, "{folder}/module.json cannot be read"),
            DocumentFault::NotJson => write!(f, "{folder}/module.json is not well-formed JSON"),
            DocumentFault::UnknownVersion(Some(version)) => {
                write!(f, "version {version} of {name} is not known")
            }
            DocumentFault::UnknownVersion(None) => write!(f, "the version of {name} is not known"),
            DocumentFault::IsDraft => {
                write!(f, "{folder}/module.json follows a draft of the format")
            }
            DocumentFault::BreaksSchema => write!(f, "{folder}/module.json breaks its schema"),
        }
    }
}

/// Whether a folder has the name of an extension module (SPEC 11.1).
pub fn is_extension(folder: &str) -> bool {
    let Some(middle) = folder.strip_prefix("x_").and_then(|rest| rest.strip_suffix("_module"))
    else {
        return false;
    };
    let allowed = middle.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_');
    let parts: Vec<&str> = middle.splitn(2, '_').collect();
    allowed && parts.len() == 2 && parts.iter().all(|part| !part.is_empty())
}

/// The source URDF in a URDD.
pub struct CarriedUrdf {
    /// Path relative to the root.
    pub path: String,
    /// Its text, with invalid UTF-8 replaced.
    pub text: String,
    /// Byte offset of the first invalid UTF-8, if any.
    pub not_utf8_at: Option<usize>,
    /// What it is instead, if it is not UTF-8 and no URDF.
    pub foreign: Option<Foreign>,
}

/// Why the source URDF is not available.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum NoUrdf {
    /// The root metadata is unusable, so the source is unknown.
    #[error("{ROOT_METADATA} does not match its schema, so the source is unknown")]
    MetadataUnusable,
    /// Only selected modules were read.
    #[error("the URDF was not read")]
    NotRead,
    #[error("the root metadata names no source")]
    NoSource,
    #[error("no URDF file is carried")]
    NoneCarried,
    #[error("several URDF files are carried, and none has the folder's name")]
    Several,
    #[error("{path}: {error}")]
    Unreadable { path: String, error: ReadError },
}

impl NoUrdf {
    /// Whether the file is there, and too large.
    pub fn is_too_large(&self) -> bool {
        matches!(self, NoUrdf::Unreadable { error: ReadError::TooLarge { .. }, .. })
    }
}

/// Reads the source URDF.
///
/// # Errors
/// If the URDD contains none, or it cannot be read.
pub(crate) fn read_urdf(
    root: &Root,
    listing: &Listing,
    metadata: &MetadataFile,
) -> Result<CarriedUrdf, NoUrdf> {
    let path = match (&metadata.json, &metadata.metadata) {
        (JsonFile::Missing, _) => lone_urdf(root, listing)?,
        (_, None) => return Err(NoUrdf::MetadataUnusable),
        (_, Some(metadata)) => match &metadata.source {
            Some(Source::Urdf(file)) => file.path.clone(),
            None => return Err(NoUrdf::NoSource),
        },
    };
    read_file(root, &path).map_err(|error| NoUrdf::Unreadable { path, error })
}

/// Reads a URDF file below a root.
///
/// # Errors
/// If it cannot be read.
pub fn read_file(root: &Root, path: &str) -> Result<CarriedUrdf, ReadError> {
    CarriedUrdf::of_bytes(path, &root.read(path, MAX_URDF_BYTES)?)
}

impl CarriedUrdf {
    /// The URDF of these bytes; `path` is its name.
    ///
    /// # Errors
    /// If they are too many.
    pub fn of_bytes(path: &str, bytes: &[u8]) -> Result<CarriedUrdf, ReadError> {
        let size = bytes.len() as u64;
        if size > MAX_URDF_BYTES {
            return Err(ReadError::TooLarge { size, limit: MAX_URDF_BYTES });
        }
        // A second mark is a character before the root; the parser passes over one mark itself.
        let mark = b"\xef\xbb\xbf";
        let rest = bytes.strip_prefix(mark).filter(|rest| !rest.starts_with(mark));
        let bytes = rest.unwrap_or(bytes);
        let not_utf8_at = std::str::from_utf8(bytes).err().map(|error| error.valid_up_to());
        Ok(CarriedUrdf {
            path: path.to_owned(),
            text: String::from_utf8_lossy(bytes).into_owned(),
            not_utf8_at,
            foreign: not_utf8_at.and_then(|_| foreign(bytes)),
        })
    }
}

/// Without root metadata: the only `.urdf` file in the root, or the one named after the folder.
fn lone_urdf(root: &Root, listing: &Listing) -> Result<String, NoUrdf> {
    let files = listing.entries.iter().filter(|entry| entry.kind == EntryKind::File);
    let in_root = files.map(|entry| &entry.path).filter(|path| !path.contains('/'));
    let mut urdfs = in_root.filter(|path| path.ends_with(".urdf"));
    match (urdfs.next(), urdfs.next()) {
        (None, _) => Err(NoUrdf::NoneCarried),
        (Some(only), None) => Ok(only.clone()),
        (Some(_), Some(_)) => {
            let named = format!("{}.urdf", root.folder_name());
            if listing.has_file(&named) { Ok(named) } else { Err(NoUrdf::Several) }
        }
    }
}
