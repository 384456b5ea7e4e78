//! Under which names mesh files are carried.
//!
//! Files keep their places to each other, so that what a mesh names in turn lies where it expects
//! it: files of a package lie in `meshes/<package>/` as they do in the package, files around the
//! URDF in `meshes/` below the nearest folder that holds them all. Nothing of a full path outside
//! of these gets into a URDD.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use super::resolve::Home;
use crate::directory::path::portable;

/// The names of files, relative to `meshes/`, with forward slashes; for each file (of a home) one.
pub(crate) fn lay_out(files: &BTreeMap<PathBuf, Home>) -> BTreeMap<PathBuf, String> {
    let mut by_home: BTreeMap<&Home, Vec<&Path>> = BTreeMap::new();
    for (file, home) in files {
        by_home.entry(home).or_default().push(file);
    }
    let mut taken = BTreeSet::new();
    let mut names = BTreeMap::new();
    for (home, files) in by_home {
        let folder = match home {
            Home::Package(name, _) => Some(portable(name)),
            Home::Urdf | Home::Elsewhere => None,
        };
        let base = match home {
            Home::Package(_, folder) => folder.canonicalize().unwrap_or_else(|_| folder.clone()),
            Home::Urdf | Home::Elsewhere => common_folder(&files),
        };
        // A link may lead a package's file out of its folder.
        let all_inside = files.iter().all(|file| file.starts_with(&base));
        let base = if all_inside {
            base
        } else {
            common_folder(&files)
        };
        for file in files {
            let inside = file.strip_prefix(&base).unwrap_or(file);
            let parts = inside.components().filter_map(|component| match component {
                Component::Normal(name) => Some(portable(&name.to_string_lossy())),
                _ => None,
            });
            let parts: Vec<String> = folder.iter().cloned().chain(parts).collect();
            names.insert(file.to_owned(), unique(parts, &mut taken));
        }
    }
    names
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
