//! Under which names mesh files are carried.
//!
//! Files keep their places to each other, so that what a mesh names in turn lies where it expects
//! it: files of a package lie in `meshes/<package>/` as they do in the package, files around the
//! URDF in `meshes/` below the nearest folder that holds them all, those of other folders in
//! `meshes/outside_<n>/`. Nothing of a path above these gets into a URDD.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use super::roots::Place;
use urdd_directory::path::portable;

/// The names of files, relative to `meshes/`, with forward slashes.
pub(crate) struct Layout {
    names: BTreeMap<PathBuf, String>,
}

/// What files lie together with.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Package(String, PathBuf),
    Own,
    /// The n-th folder that the user allowed and a mesh lies in, in the order of the URDF.
    Outside(usize),
}

impl Layout {
    /// Of files in the order in which the URDF brings them up, each with its place, and with the
    /// mesh that it belongs to.
    pub(crate) fn new<'a>(files: impl Iterator<Item = (&'a Path, &'a Place, &'a Path)>) -> Self {
        let mut groups: BTreeMap<Group, Vec<&Path>> = BTreeMap::new();
        let mut outside: Vec<&Path> = Vec::new();
        let mut seen = BTreeSet::new();
        for (file, place, mesh) in files {
            // The first mesh that brings a file along decides what it lies with.
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
                    // The mesh's folder and one above it may be named, no more.
                    let near = meshes.parent().filter(|near| near.parent().is_some());
                    let is_near = near.is_some_and(|near| common.starts_with(near));
                    let base = if is_near { common } else { meshes.to_owned() };
                    (Some(format!("outside_{}", idx + 1)), base)
                }
            };
            for file in files {
                // What lies elsewhere goes by its name alone.
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

    /// The name of a file that was given.
    pub(crate) fn name(&self, file: &Path) -> Option<&str> {
        self.names.get(file).map(String::as_str)
    }
}

/// The deepest folder that holds all of the files.
fn common_folder(files: &[&Path]) -> PathBuf {
    let mut folders = files.iter().filter_map(|file| file.parent());
    let mut common = folders.next().map(Path::to_owned).unwrap_or_default();
    for folder in folders {
        while !folder.starts_with(&common) && common.pop() {}
    }
    common
}

/// A path that differs from all others by more than case: not every file system tells case apart.
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
