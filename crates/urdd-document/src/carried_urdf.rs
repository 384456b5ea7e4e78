//! Finds and reads the source URDF in a URDD.

use thiserror::Error;

use super::module::{JsonFile, MetadataFile};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_URDF_BYTES;
use urdd_directory::root::{EntryKind, Listing, ReadError, Root};
use urdd_format::root_metadata::Source;

/// The source URDF in a URDD.
pub struct CarriedUrdf {
    /// Path relative to the root.
    pub path: String,
    /// Its text, with invalid UTF-8 replaced.
    pub text: String,
    /// Byte offset of the first invalid UTF-8, if any.
    pub not_utf8_at: Option<usize>,
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
pub(super) fn read(
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
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let not_utf8_at = std::str::from_utf8(bytes).err().map(|error| error.valid_up_to());
        Ok(CarriedUrdf {
            path: path.to_owned(),
            text: String::from_utf8_lossy(bytes).into_owned(),
            not_utf8_at,
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
