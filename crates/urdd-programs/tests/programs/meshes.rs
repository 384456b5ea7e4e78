//! What is in the meshes of the bases.

use std::fs;
use std::sync::Arc;

use urdd_programs::{Mesh, MeshFacts};

use crate::table::folder;

/// The mesh that a base names.
pub fn find(name: &str) -> Mesh {
    let base = folder().join("base");
    let path = match name.split_once("://") {
        Some(("package" | "model", rest)) => base.join("packages").join(rest),
        Some(("file", rest)) => rest.into(),
        // Programs were given the files in a folder of another name.
        _ if name.starts_with("../base/") => return Mesh::Missing,
        _ => base.join(name),
    };
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(_) if path.is_dir() => Vec::new(),
        Err(_) => return Mesh::Missing,
    };
    Mesh::Found(Arc::new(MeshFacts::of(name, &bytes)))
}
