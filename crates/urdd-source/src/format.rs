//! What a description is by its content, if it is no URDF: MJCF, SDF or USD. Files of these that are parts of others.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use urdd_directory::file_type::FileType;
use urdd_xml::{Mended, parse_leniently, root_name};

use super::files::{Files, MAX_SOURCE_BYTES};
use super::usd_layers::layers_of_others;

/// How many bytes at the start of a file are searched for its outermost element.
const HEAD: u64 = 1 << 20;

/// A format that is imported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// The XML of MuJoCo.
    Mjcf,
    /// The simulation description format of Gazebo.
    Sdf,
    /// Universal Scene Description.
    Usd,
}

impl Format {
    /// All of them, in the order of the table in docs/import.md.
    pub const ALL: [Format; 3] = [Format::Mjcf, Format::Sdf, Format::Usd];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Format::Mjcf => "mjcf",
            Format::Sdf => "sdf",
            Format::Usd => "usd",
        }
    }

    /// The format of a description with this outermost element; none of a URDF, and of anything else.
    pub fn of_root(name: &str) -> Option<Self> {
        match name {
            "mujoco" => Some(Format::Mjcf),
            "sdf" | "gazebo" => Some(Format::Sdf),
            _ => None,
        }
    }

    /// The format of a text, by its outermost element, or the first line of a USD.
    pub fn of(text: &str) -> Option<Self> {
        match is_usd(text.as_bytes()) {
            true => Some(Format::Usd),
            false => Format::of_root(root_name(text)?),
        }
    }
}

/// Whether bytes begin as a USD layer does.
fn is_usd(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.starts_with(b"#usda ") || bytes.starts_with(b"PXR-USDC")
}

/// Whether a file is a USD: a layer, or a package with that ending. Other zip archives are URDDs.
fn is_usd_file(path: &Path, files: &Files) -> bool {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let is_package = ending.is_some_and(|ending| ending == "usdz" || ending == "usd");
    let Ok(head) = files.head(path, 16) else { return false };
    is_usd(&head) || is_package && head.starts_with(b"PK\x03\x04")
}

/// The name of the outermost element of a file, if that is in the beginning of it.
pub fn root_of(path: &Path, files: &Files) -> Option<String> {
    let head = files.head(path, HEAD).ok()?;
    // By its byte order mark, if it has one.
    let (text, ..) = encoding_rs::UTF_8.decode(&head);
    root_name(&text).map(str::to_owned)
}

/// The format of a file, by its outermost element or its first bytes; none of a URDF, and of anything else.
pub fn format_of(path: &Path, files: &Files) -> Option<Format> {
    match is_usd_file(path, files) {
        true => Some(Format::Usd),
        false => Format::of_root(&root_of(path, files)?),
    }
}

/// The format of a file of a folder that is imported, by its extension and its content.
pub(crate) fn imported(file: &Path, files: &Files) -> Option<Format> {
    match FileType::of(file)? {
        FileType::Xml | FileType::Sdf | FileType::Mjcf => Format::of_root(&root_of(file, files)?),
        FileType::Usd => is_usd_file(file, files).then_some(Format::Usd),
        _ => None,
    }
}

/// The files among some that are imported and are no robots: MJCFs that one of them includes, or without bodies, SDFs
/// without models, and USDs that are layers of others, or without bodies.
pub(crate) fn parts_of_others<'p>(
    sources: impl Iterator<Item = &'p Path>,
    files: &Files,
) -> HashSet<PathBuf> {
    let (usds, others): (Vec<&Path>, Vec<&Path>) =
        sources.partition(|source| FileType::Usd.is_of(source));
    let others = others.into_iter().flat_map(|source| parts_of(source, files).unwrap_or_default());
    others.chain(layers_of_others(&usds, files)).collect()
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
