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
        _ => base.join(name),
    };
    let Ok(bytes) = fs::read(path) else { return Mesh::Missing };
    Mesh::Found(Arc::new(MeshFacts::of(name, &bytes)))
}
