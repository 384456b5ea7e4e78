//! Meshes written to files and read from them.

use std::sync::Arc;

use crate::error::{GenerateError, Result};
use crate::made::MadeFile;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_format::meshes::MeshFiles;
use urdd_geometry::read::{GltfUp, Options, Part, read_with};
use urdd_geometry::{Mesh, write};

/// The mesh of a link or a piece, as in its files.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrittenMesh {
    pub mesh: Mesh,
    /// The colour with the largest area.
    pub color: Option<[f64; 4]>,
}

impl WrittenMesh {
    /// Merges parts of several colours.
    pub fn of(parts: &[Part]) -> Self {
        let mut mesh = Mesh::default();
        let mut areas: Vec<(Option<[f64; 4]>, f64)> = Vec::new();
        for part in parts {
            mesh.append(&part.mesh);
            let area = part.mesh.area();
            match areas.iter_mut().find(|(color, _)| *color == part.color) {
                Some((_, sum)) => *sum += area,
                None => areas.push((part.color, area)),
            }
        }
        let largest = areas.into_iter().reduce(|a, b| if b.1 > a.1 { b } else { a });
        WrittenMesh { mesh, color: largest.and_then(|(color, _)| color) }
    }

    pub fn part(&self) -> Part {
        Part { mesh: self.mesh.clone(), color: self.color, ..Part::default() }
    }
}

/// A mesh of each link that has one.
pub(crate) type Meshes = Vec<Option<WrittenMesh>>;
/// The pieces of each link.
pub(crate) type Pieces = Vec<Vec<WrittenMesh>>;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shading {
    /// Flat, for hulls and pieces.
    Flat,
    /// Smooth, with vertex normals.
    Smooth,
}

/// The files of a mesh in the formats listed in `files`.
pub(crate) fn files_of(
    parts: &[Part],
    files: &MeshFiles,
    shading: Shading,
) -> Result<Vec<MadeFile>> {
    let glb = match shading {
        Shading::Flat => write::glb(parts),
        Shading::Smooth => write::smooth_glb(parts),
    };
    let internal = |error: write::WriteError| GenerateError::internal(&files.glb, error);
    let file =
        |path: &String, bytes: Vec<u8>| MadeFile { path: path.clone(), bytes: Arc::new(bytes) };
    let mut made = Vec::with_capacity(3);
    if let Some(stl) = &files.stl {
        made.push(file(stl, write::stl(parts).map_err(internal)?));
    }
    if let Some(obj) = &files.obj {
        made.push(file(obj, write::obj(parts).map_err(internal)?));
    }
    made.push(file(&files.glb, glb.map_err(internal)?));
    Ok(made)
}

/// Reads a mesh from the files of an earlier run.
pub(crate) fn read_mesh(root: &Root, files: &MeshFiles) -> Result<WrittenMesh> {
    let bytes = root.read(&files.glb, MAX_DOCUMENT_BYTES);
    let bytes = bytes.map_err(|error| GenerateError::internal(&files.glb, error))?;
    read_glb(&bytes, &files.glb)
}

/// Reads a mesh from the bytes of its .glb.
pub(crate) fn read_glb(bytes: &[u8], path: &str) -> Result<WrittenMesh> {
    let options = Options { gltf_up: GltfUp::Keep, ..Options::default() };
    let mut scene = read_with(bytes, path, &mut |_| None, &options)
        .map_err(|error| GenerateError::internal(path, error))?;
    for part in &mut scene.parts {
        // Merge vertices that were split for their normals.
        part.mesh.weld();
    }
    Ok(WrittenMesh::of(&scene.parts))
}
