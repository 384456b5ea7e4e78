//! What the files of a set or of a disk are, and which of those that are imported are parts of others.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::account::{Account, AccountError};
use urdd_directory::file_type::FileType;
use urdd_directory::file_type::HEAD;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_usd::{Door, outline};
use urdd_xml::{Mended, parse_leniently};

use crate::files::{Files, MAX_SOURCE_BYTES};

pub use urdd_directory::file_type::{Format, RobotFile};

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
    account: &Account,
) -> HashSet<PathBuf> {
    let usd = RobotFile::Imported(Format::Usd);
    let (usds, others): (Vec<_>, Vec<_>) = sources.partition(|(_, is)| *is == usd);
    let usds: Vec<&Path> = usds.into_iter().map(|(source, _)| source).collect();
    let others = others.into_iter();
    let others = others.flat_map(|(source, is)| parts_of(source, is, files).unwrap_or_default());
    others.chain(layers_of_others(&usds, files, account)).collect()
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

/// One file, and what may be made of it.
struct OneFile(Arc<[u8]>, Account);

impl Door for OneFile {
    fn read(&mut self, _: &str) -> Result<Arc<[u8]>, String> {
        Ok(Arc::clone(&self.0))
    }

    fn charge(&self, cost: usize) -> Result<(), AccountError> {
        self.1.charge(cost)
    }
}

struct Known {
    /// The files that it names, symbolic links resolved.
    names: Vec<PathBuf>,
    has_bodies: bool,
}

/// The USDs among some that are no robots: layers of others, and those without bodies. What cannot be read stays: it is named
/// where it is imported.
pub(crate) fn layers_of_others(
    usds: &[&Path],
    files: &Files,
    account: &Account,
) -> HashSet<PathBuf> {
    let known = |path: &&Path| Some((files.canonicalize(path).ok()?, known(path, files, account)?));
    let all: HashMap<PathBuf, Known> = usds.iter().filter_map(known).collect();
    let mut users: HashMap<&Path, Vec<&Path>> = HashMap::new();
    for (user, known) in &all {
        for name in known.names.iter().filter(|name| *name != user) {
            users.entry(name).or_default().push(user);
        }
    }
    // Whoever is composed of a file with bodies has them. Of one outside of the folder, nothing is known.
    let may_have = |path: &&Path| all.get(*path).is_none_or(|known| known.has_bodies);
    let mut waiting: Vec<&Path> =
        users.keys().copied().chain(all.keys().map(PathBuf::as_path)).filter(may_have).collect();
    let mut with_bodies = HashSet::new();
    while let Some(next) = waiting.pop() {
        if with_bodies.insert(next) {
            waiting.extend(users.get(next).into_iter().flatten());
        }
    }
    let is_part = |path: &&PathBuf| {
        users.contains_key(path.as_path()) || !with_bodies.contains(path.as_path())
    };
    all.keys().filter(is_part).cloned().collect()
}

fn known(path: &Path, files: &Files, account: &Account) -> Option<Known> {
    let bytes: Arc<[u8]> = files.read(path, MAX_DOCUMENT_BYTES).ok()?.into();
    account.deposit(bytes.len());
    let name = path.file_name()?.to_string_lossy();
    let outline = outline(&name, &mut OneFile(bytes, account.clone())).ok()?;
    let folder = path.parent()?;
    let names = outline.names.iter().filter_map(|name| files.canonicalize(&folder.join(name)).ok());
    Some(Known { names: names.collect(), has_bodies: outline.has_bodies })
}
