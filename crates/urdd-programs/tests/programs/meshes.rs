//! What is in the meshes of the bases.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use urdd_programs::{Mesh, MeshFacts, Program};

use crate::table::folder;

/// The mesh that a base names, where a program looks for it: the table was made with `base/` beside the file, `packages/` in
/// it, and packages in the latter.
pub fn find(program: Program, name: &str) -> Mesh {
    let base = folder().join("base");
    let packages = base.join("packages");
    let (scheme, rest) = match name.split_once("://") {
        Some((scheme, rest)) => (scheme, rest),
        None => ("", name),
    };
    let in_any =
        |rest: &str| [&base, &packages].map(|folder| folder.join(rest.trim_start_matches('/')));
    let places: Vec<PathBuf> = match (program.id(), scheme) {
        // Programs were given the files in a folder of another name.
        (_, "") if rest.starts_with("../base/") => Vec::new(),
        // What is no scheme is a name, relative ones in the folders of packages too.
        ("pinocchio", "") if !rest.starts_with('/') => in_any(rest).into(),
        ("pinocchio", "package" | "model") => in_any(rest).into(),
        (_, "package" | "model") => vec![packages.join(rest)],
        ("usd", "file") => vec![base.join(rest)],
        (_, "file") => vec![rest.into()],
        _ => vec![base.join(name)],
    };
    // `base/` had another name there.
    if name.contains("../base/") {
        return Mesh::Missing;
    }
    let Some(path) = places.into_iter().find(|path| path.exists()) else { return Mesh::Missing };
    let bytes = fs::read(&path).unwrap_or_default();
    Mesh::Found(Arc::new(MeshFacts::of(name, &bytes)))
}
