//! What is in the meshes of the bases.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex};

use urdd_programs::{Mesh, MeshFacts, Program};

use crate::table::folder;

/// Files that were read, by their paths and the names that they were asked by.
static READ: LazyLock<Mutex<HashMap<(PathBuf, String), Mesh>>> = LazyLock::new(Mutex::default);

/// The mesh that a base, `file`, names, where a program looks for it: the table was made with the base's folder beside the
/// file, `packages/` in `base/`, and packages in the latter.
pub fn find(program: Program, file: &str, name: &str) -> Mesh {
    let packages = folder().join("base/packages");
    let base = folder().join("base").join(file);
    let base = base.parent().unwrap_or(Path::new(""));
    let (scheme, rest) = match name.split_once("://") {
        Some((scheme, rest)) => (scheme, rest),
        None => ("", name),
    };
    let in_any =
        |rest: &str| [base, &packages].map(|folder| folder.join(rest.trim_start_matches('/')));
    let places: Vec<PathBuf> = match (program.id(), scheme) {
        // Programs were given the files in a folder of another name.
        (_, "") if rest.starts_with("../base/") => Vec::new(),
        // What is no scheme is a name, relative ones in the folders of packages too.
        ("pinocchio", "") if !rest.starts_with('/') => in_any(rest).into(),
        ("pinocchio", "package" | "model") => in_any(rest).into(),
        (_, "package" | "model") => vec![packages.join(rest)],
        ("usd", "file") => vec![base.join(rest)],
        (_, "file") => vec![rest.into()],
        // A person puts all meshes together for it.
        ("mujoco33", _) => vec![base.join(name), base.join("together").join(name)],
        _ => vec![base.join(name)],
    };
    // `base/` had another name there.
    if name.contains("../base/") {
        return Mesh::Missing;
    }
    let Some(path) = places.into_iter().find(|path| path.exists()) else { return Mesh::Missing };
    let mut read = READ.lock().unwrap();
    let mesh = read.entry((path, name.to_owned())).or_insert_with_key(|(path, _)| {
        let bytes = fs::read(path).unwrap_or_default();
        Mesh::Found(Arc::new(MeshFacts::of(name, &bytes)))
    });
    mesh.clone()
}
