//! The names under which mesh files are stored.
//!
//! Files keep their relative positions, so that references in a mesh to other files remain valid. Files of a package
//! keep their paths, below `meshes/<package>/`. Files around the URDF are stored in `meshes/`, relative to their
//! deepest common folder. Files in other folders are stored in `meshes/outside_<n>/`. Nothing of a path above these
//! folders gets into a URDD.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use urdd_directory::path::portable;
use urdd_source::Place;

/// File names relative to `meshes/`, with forward slashes.
pub(crate) struct Layout {
    names: BTreeMap<PathBuf, String>,
}

/// The group of files that are stored together.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Package(String, PathBuf),
    Own,
    /// The n-th folder with a mesh among those that the user allowed, in the order of the URDF.
    Outside(usize),
}

impl Layout {
    /// Takes the files in the order of the URDF, each with its place and the mesh that it belongs to.
    pub(crate) fn new<'a>(files: impl Iterator<Item = (&'a Path, &'a Place, &'a Path)>) -> Self {
        let mut groups: BTreeMap<Group, Vec<&Path>> = BTreeMap::new();
        let mut outside: Vec<&Path> = Vec::new();
        let mut seen = BTreeSet::new();
        for (file, place, mesh) in files {
            // A file belongs to the group of the first mesh that references it.
            if !seen.insert(file) {
                continue;
            }
            let group = match place {
                Place::Package(name, folder) => Group::Package(name.clone(), folder.clone()),
                Place::Own => Group::Own,
                Place::Allowed => {
                    let folder = mesh.parent().unwrap_or(mesh);
                    let known = outside.iter().position(|known| *known == folder);
                    Group::Outside(known.unwrap_or_else(|| {
                        outside.push(folder);
                        outside.len() - 1
                    }))
                }
            };
            groups.entry(group).or_default().push(file);
        }
        let mut taken = BTreeSet::new();
        let mut names = BTreeMap::new();
        for (group, files) in groups {
            let (folder, base) = match group {
                Group::Package(name, base) => (Some(portable(&name)), base),
                Group::Own => (None, common_folder(&files)),
                Group::Outside(idx) => {
                    let meshes = outside[idx];
                    let common = common_folder(&files);
                    // The path may reveal the mesh's folder and its parent, but no more.
                    let near = meshes.parent().filter(|near| near.parent().is_some());
                    let is_near = near.is_some_and(|near| common.starts_with(near));
                    let base = if is_near { common } else { meshes.to_owned() };
                    (Some(format!("outside_{}", idx + 1)), base)
                }
            };
            for file in files {
                // A file outside the base folder keeps only its file name.
                let name = Path::new(file.file_name().unwrap_or_default());
                let inside = file.strip_prefix(&base).unwrap_or(name);
                let parts = inside.components().filter_map(|component| match component {
                    Component::Normal(name) => Some(portable(&name.to_string_lossy())),
                    _ => None,
                });
                let parts: Vec<String> = folder.iter().cloned().chain(parts).collect();
                names.insert(file.to_owned(), unique(parts, &mut taken));
            }
        }
        Layout { names }
    }

    /// The stored name of one of the files.
    pub(crate) fn name(&self, file: &Path) -> Option<&str> {
        self.names.get(file).map(String::as_str)
    }
}

/// The deepest folder that contains all of the files.
pub(crate) fn common_folder(files: &[&Path]) -> PathBuf {
    let mut folders = files.iter().filter_map(|file| file.parent());
    let mut common = folders.next().map(Path::to_owned).unwrap_or_default();
    for folder in folders {
        while !folder.starts_with(&common) && common.pop() {}
    }
    common
}

/// A path that is unique regardless of case: some file systems ignore case.
fn unique(parts: Vec<String>, taken: &mut BTreeSet<String>) -> String {
    let path = parts.join("/");
    let mut candidate = path.clone();
    let mut number = 2;
    while !taken.insert(candidate.to_lowercase()) {
        let (folder, name) = match path.rsplit_once('/') {
            Some((folder, name)) => (format!("{folder}/"), name),
            None => (String::new(), path.as_str()),
        };
        candidate = match name.rsplit_once('.') {
            Some((stem, extension)) => format!("{folder}{stem}_{number}.{extension}"),
            None => format!("{folder}{name}_{number}"),
        };
        number += 1;
    }
    candidate
}
