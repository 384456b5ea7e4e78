//! Finding and reading the source URDF that a URDD carries.

use super::load::{CarriedUrdf, JsonFile, MetadataFile};
use crate::directory::discover::ROOT_METADATA;
use crate::directory::root::{EntryKind, Listing, Root};
use crate::format::root_metadata::Source;

/// Longest source URDF that is read, bytes.
const MAX_URDF_BYTES: u64 = 64 << 20;

/// The source URDF, or why there is none to look at.
pub fn read(
    root: &Root,
    listing: &Listing,
    metadata: &MetadataFile,
) -> Result<CarriedUrdf, String> {
    let path = match (&metadata.json, &metadata.metadata) {
        (JsonFile::Missing, _) => lone_urdf(root, listing)?,
        (_, None) => {
            return Err(format!(
                "{ROOT_METADATA} does not fit its schema, so the source is not known"
            ));
        }
        (_, Some(metadata)) => match &metadata.source {
            Some(Source::Urdf(file)) => file.path.clone(),
            Some(Source::Composition(_)) => {
                return Err("the source is a composition; no URDF is carried".to_owned());
            }
            None => return Err("the root metadata names no source".to_owned()),
        },
    };
    let bytes = root
        .read(&path, MAX_URDF_BYTES)
        .map_err(|error| format!("{path}: {error}"))?;
    let text = String::from_utf8(bytes).map_err(|_| format!("{path} is not UTF-8"))?;
    let text = text
        .strip_prefix('\u{feff}')
        .map(str::to_owned)
        .unwrap_or(text);
    Ok(CarriedUrdf { path, text })
}

/// Without root metadata: the one `.urdf` in the root, or the one that is named as the folder is.
fn lone_urdf(root: &Root, listing: &Listing) -> Result<String, String> {
    let mut urdfs = listing
        .entries
        .iter()
        .filter(|entry| {
            entry.kind == EntryKind::File
                && !entry.path.contains('/')
                && entry.path.ends_with(".urdf")
        })
        .map(|entry| entry.path.clone());
    match (urdfs.next(), urdfs.next()) {
        (None, _) => Err("no URDF file is carried".to_owned()),
        (Some(only), None) => Ok(only),
        (Some(_), Some(_)) => {
            let named = format!("{}.urdf", root.folder_name());
            match listing.has_file(&named) {
                true => Ok(named),
                false => Err(
                    "several URDF files are carried, and none is named as the folder is".to_owned(),
                ),
            }
        }
    }
}
