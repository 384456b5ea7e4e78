//! The packages around a URDF: those that it is in, and those beside them.

use std::collections::HashSet;
use std::path::{Component, Path, PathBuf};

use super::files::{Files, is_broad};
use super::packages::{MOST_NAMES, of_workspace, package_name};
use urdd_format::escape;
use urdd_format::nearest::nearest;

/// How many folders above a URDF are searched for packages beside it.
const LEVELS: usize = 4;

/// A folder that may be a package.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Around {
    /// The name in its `package.xml`, otherwise that of the folder.
    pub name: String,
    /// The folder.
    pub folder: PathBuf,
    /// Whether it has a `package.xml`.
    pub has_manifest: bool,
    /// Whether the URDF is in it.
    pub is_above: bool,
}

/// A package whose name is near to one that is not there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NearPackage {
    /// The package.
    pub package: Around,
    /// Whether the file that was looked for is in it.
    pub has_file: bool,
}

impl NearPackage {
    /// What to do about a package `name` that is not there.
    pub fn in_words(&self, name: &str) -> String {
        let Around { name: near, has_manifest, .. } = &self.package;
        let file = if self.has_file { ", which has this file" } else { "" };
        let (there, rename) = match has_manifest {
            true => ("package", String::new()),
            false => ("folder", format!(", rename the folder to `{name}`")),
        };
        format!(
            "there is no package `{name}`, but there is the {there} `{near}`{file}; write `{near}`{rename}, or say --package {}=FOLDER",
            escape::shell(name)
        )
    }
}

/// The name of the folder of a workspace that has its sources.
const SOURCES: &str = "src";

/// The folders above a URDF's folder, nearest first, then those beside them, then other packages of the workspace or
/// repository.
pub fn around(urdf_folder: &Path, files: &Files) -> Vec<Around> {
    let of = |folder: &Path, is_above| {
        let written = package_name(folder, files).filter(|name| is_plain(name));
        let has_manifest = written.is_some();
        let plain = || Some(folder.file_name()?.to_str()?.to_owned());
        let name = written.or_else(plain)?;
        Some(Around { name, folder: folder.to_owned(), has_manifest, is_above })
    };
    let mut found: Vec<Around> =
        urdf_folder.ancestors().filter_map(|folder| of(folder, true)).collect();
    for above in urdf_folder.ancestors().take(LEVELS) {
        let mut names = files.names(above);
        names.truncate(MOST_NAMES);
        let beside = names.into_iter().map(|name| above.join(name));
        let beside =
            beside.filter(|folder| !urdf_folder.starts_with(folder) && files.is_dir(folder));
        found.extend(beside.filter_map(|folder| of(&folder, false)));
    }
    if let (Files::Disk, Some(root)) = (files, workspace(urdf_folder)) {
        let known: HashSet<PathBuf> = found.iter().map(|one| one.folder.clone()).collect();
        let others = of_workspace(root, files).into_iter();
        let others = others.filter(|(name, folder)| is_plain(name) && !known.contains(folder));
        found.extend(others.map(|(name, folder)| {
            let is_above = urdf_folder.starts_with(&folder);
            Around { name, folder, has_manifest: true, is_above }
        }));
    }
    found
}

/// The highest folder above a URDF that has the sources of a workspace, or is a repository.
fn workspace(urdf_folder: &Path) -> Option<&Path> {
    let is_root = |folder: &&Path| {
        let has_sources = folder.file_name().is_some_and(|name| name == SOURCES);
        !is_broad(folder) && (has_sources || folder.join(".git").exists())
    };
    let home = std::env::home_dir();
    let above = urdf_folder.ancestors().take_while(|folder| home.as_deref() != Some(*folder));
    above.filter(is_root).last()
}

/// The package whose name differs from `name` in case, `-`, `_`, `.` and spaces alone; or one around the URDF that has the file
/// `rest`, with a near name and the same numbers.
pub fn near(around: &[Around], name: &str, rest: &str, files: &Files) -> Option<NearPackage> {
    let bare = |name: &str| name.to_lowercase().replace(['-', '_', ' ', '.'], "");
    let has_file = |one: &Around| !rest.is_empty() && files.is_file(&one.folder.join(rest));
    let same = around.iter().filter(|one| bare(&one.name) == bare(name));
    // The first of the best.
    let same = same.rev().max_by_key(|one| has_file(one));
    let misspelt = || {
        let is_near = |one: &&Around| {
            nearest(std::iter::once(one.name.as_str()), name).is_some()
                && digits(&one.name) == digits(name)
        };
        around.iter().filter(|one| one.is_above && has_file(one)).find(is_near)
    };
    let package = same.or_else(misspelt)?.clone();
    Some(NearPackage { has_file: has_file(&package), package })
}

fn digits(name: &str) -> String {
    name.chars().filter(char::is_ascii_digit).collect()
}

/// Whether a name is a single part of a path.
pub fn is_plain(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    matches!(parts.next(), Some(Component::Normal(_))) && parts.next().is_none()
}
