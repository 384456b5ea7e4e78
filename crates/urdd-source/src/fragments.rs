//! Files of MJCF and SDF that are parts of others, and descriptions of other formats in a folder.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use urdd_xml::{Mended, parse_leniently};

use super::files::{Files, MAX_SOURCE_BYTES};
use super::import::format::Format;
use super::import::format_of;

/// Extensions of files that are an MJCF or SDF, if their content is.
const EXTENSIONS: [&str; 4] = ["xml", "sdf", "mjcf", "world"];

/// Whether a file may be one that is imported, by its extension.
pub fn may_be_imported(file: &Path) -> bool {
    let extension = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    EXTENSIONS.contains(&&*extension)
}

/// The format of a file that is imported, by its extension and its content.
pub fn imported(file: &Path, files: &Files) -> Option<Format> {
    may_be_imported(file).then(|| format_of(file, files)).flatten()
}

/// The files among some that are imported and are no robots: MJCFs that one of them includes, or without bodies, and SDFs
/// without models.
pub fn parts<'p>(sources: impl Iterator<Item = &'p Path>, files: &Files) -> HashSet<PathBuf> {
    sources.flat_map(|source| parts_of(source, files).unwrap_or_default()).collect()
}

fn parts_of(source: &Path, files: &Files) -> Option<Vec<PathBuf>> {
    let bytes = files.read(source, MAX_SOURCE_BYTES).ok()?;
    let text = std::str::from_utf8(&bytes).ok()?;
    if !["<body", "<include", "<attach", "<model"].iter().any(|tag| text.contains(tag)) {
        return Some(vec![files.canonicalize(source).ok()?]);
    }
    // A text that names no file is not parsed.
    let mended = Mended::default();
    let document =
        text.contains("<include").then(|| parse_leniently(text, "mujoco", &mended))?.ok()?;
    let elements = document.descendants().filter(|node| node.has_tag_name("include"));
    let named = elements.filter_map(|node| Some(source.parent()?.join(node.attribute("file")?)));
    Some(named.filter_map(|file| files.canonicalize(&file).ok()).collect())
}
