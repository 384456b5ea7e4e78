//! What the files of a set or of a disk are, and which of those that are imported are parts of others.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use urdd_directory::file_type::FileType;
use urdd_directory::robot_file::HEAD;
pub use urdd_directory::robot_file::{Format, RobotFile};
use urdd_xml::{Mended, parse_leniently};

use super::files::{Files, MAX_SOURCE_BYTES};
use super::usd_layers::layers_of_others;

/// What a file is, by its content, or by its name where that does not say.
pub fn robot_file(path: &Path, files: &Files) -> Option<RobotFile> {
    RobotFile::of(path, &files.head(path, HEAD).unwrap_or_default())
}

/// The format of a file, by its outermost element or its first bytes; none of a URDF, and of anything else.
pub fn format_of(path: &Path, files: &Files) -> Option<Format> {
    robot_file(path, files)?.format()
}

/// What a file of a folder is whose name does not say it, but that it may be a description.
pub(crate) fn by_content(file: &Path, files: &Files) -> Option<RobotFile> {
    match FileType::of(file)? {
        FileType::Xml | FileType::Sdf | FileType::Mjcf | FileType::Usd => robot_file(file, files),
        FileType::Urdf | FileType::Xacro | FileType::Srdf => None,
        FileType::Archive | FileType::Document => None,
    }
}

/// The files among some that are no robots: MJCFs that one of them includes, or without bodies, SDFs without models, USDs
/// that are layers of others, or without bodies, and URDFs without links.
pub(crate) fn parts_of_others<'p>(
    sources: impl Iterator<Item = (&'p Path, RobotFile)>,
    files: &Files,
) -> HashSet<PathBuf> {
    let usd = RobotFile::Imported(Format::Usd);
    let (usds, others): (Vec<_>, Vec<_>) = sources.partition(|(_, is)| *is == usd);
    let usds: Vec<&Path> = usds.into_iter().map(|(source, _)| source).collect();
    let others = others.into_iter();
    let others = others.flat_map(|(source, is)| parts_of(source, is, files).unwrap_or_default());
    others.chain(layers_of_others(&usds, files)).collect()
}

fn parts_of(source: &Path, is: RobotFile, files: &Files) -> Option<Vec<PathBuf>> {
    let bytes = files.read(source, MAX_SOURCE_BYTES).ok()?;
    let text = std::str::from_utf8(&bytes).ok()?;
    let of_robots: &[&str] = match is {
        RobotFile::Imported(_) => &["<body", "<include", "<attach", "<model"],
        RobotFile::Urdf | RobotFile::Xacro | RobotFile::Srdf => &["<link"],
    };
    if !of_robots.iter().any(|tag| text.contains(tag)) {
        return Some(vec![files.canonicalize(source).ok()?]);
    }
    is.format()?;
    // A text that names no file is not parsed.
    let mended = Mended::default();
    let document =
        text.contains("<include").then(|| parse_leniently(text, "mujoco", &mended))?.ok()?;
    let elements = document.descendants().filter(|node| node.has_tag_name("include"));
    let named = elements.filter_map(|node| Some(source.parent()?.join(node.attribute("file")?)));
    Some(named.filter_map(|file| files.canonicalize(&file).ok()).collect())
}
