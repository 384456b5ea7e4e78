//! Reads JSON documents of a part.

use serde::de::DeserializeOwned;

use super::error::PartFault;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;

/// A JSON document of a URDD, with its length in bytes.
pub(super) fn document<T: DeserializeOwned>(
    root: &Root,
    path: &str,
) -> Result<(T, usize), PartFault> {
    let bytes = bytes(root, path)?;
    Ok((parsed(&bytes, path)?, bytes.len()))
}

/// The bytes of a document of a URDD.
pub(super) fn bytes(root: &Root, path: &str) -> Result<Vec<u8>, PartFault> {
    root.read(path, MAX_DOCUMENT_BYTES).map_err(|error| PartFault::unreadable(path, error))
}

/// The value of a JSON document; `path` names it in faults.
pub(super) fn parsed<T: DeserializeOwned>(bytes: &[u8], path: &str) -> Result<T, PartFault> {
    let value = json::read(bytes).map_err(|error| PartFault::unreadable(path, error))?;
    T::deserialize(&value.value).map_err(|error| PartFault::unreadable(path, error))
}
