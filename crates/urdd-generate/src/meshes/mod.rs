//! The mesh files that a URDF references, and the derived ones: their names, how they are written and read, and how identical
//! meshes are processed once.

pub(crate) mod derived;
pub(crate) mod original;
pub(crate) mod plain;

use std::collections::HashMap;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use rayon::prelude::*;

use crate::error::{GenerateError, Result};
use crate::made::MadeFile;
use crate::settings::MeshFormats;
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_format::meshes::MeshFiles;
use urdd_format::registry::ModuleKind;
use urdd_geometry::read::{GltfUp, Options, Part, read_with};
use urdd_geometry::{Mesh, write};

pub use original::MeshCount;

/// Maximum length of a slug in characters.
const LONGEST: usize = 64;

/// The part of a file name that identifies the link.
pub fn slug(link: &str) -> String {
    let mut slug = String::new();
    let mut in_gap = false;
    for c in link.chars() {
        let kept = c.is_ascii_alphanumeric() || c == '-' || c == '_';
        match (kept, in_gap) {
            (true, _) => slug.push(c),
            (false, false) => slug.push('_'),
            (false, true) => {}
        }
        in_gap = !kept;
    }
    slug.truncate(LONGEST);
    if slug.is_empty() { "link".to_owned() } else { slug }
}

/// The files of a link's mesh, or of one of its pieces: SPEC 7.3.
pub fn mesh_files(
    kind: ModuleKind,
    link_idx: usize,
    link: &str,
    piece_idx: Option<usize>,
    formats: MeshFormats,
) -> MeshFiles {
    let slug = slug(link);
    let path = |extension: &str| {
        let name = match piece_idx {
            None => format!("{link_idx}_{slug}"),
            Some(piece) => format!("{link_idx}_{slug}/{piece}"),
        };
        format!("{}/meshes/{extension}/{name}.{extension}", kind.folder())
    };
    MeshFiles {
        stl: formats.stl.then(|| path("stl")),
        obj: formats.obj.then(|| path("obj")),
        glb: path("glb"),
    }
}

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

pub(crate) type Meshes = Vec<Option<WrittenMesh>>;
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

/// The result of `work` for each mesh. Runs `work` once for meshes that are identical bit for bit, with the index of the
/// first.
/// Fails if cancelled; checked before each mesh.
pub fn for_each_content<T: Clone + Send>(
    meshes: &[&Mesh],
    cancellation: &Cancellation,
    work: impl Fn(usize, &Mesh) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut seen: HashMap<Content, usize> = HashMap::new();
    let mut distinct: Vec<(usize, &Mesh)> = Vec::new();
    let places: Vec<usize> = meshes
        .iter()
        .enumerate()
        .map(|(first, mesh)| {
            *seen.entry(Content(mesh)).or_insert_with(|| {
                distinct.push((first, mesh));
                distinct.len() - 1
            })
        })
        .collect();
    let made = distinct.into_par_iter().map(|(first, mesh)| {
        cancellation.check()?;
        Ok(work(first, mesh))
    });
    let made: Vec<T> = made.collect::<Result<_, Cancelled>>()?;
    Ok(places.into_iter().map(|place| made[place].clone()).collect())
}

/// A mesh, compared by the bits of its numbers. Its hash is that of a few of them: hashing all took longer than comparing
/// the few meshes with an equal hash.
struct Content<'a>(&'a Mesh);

/// Number of vertices that are hashed, or up to twice as many.
const HASHED: usize = 64;

impl Content<'_> {
    fn bits(&self) -> impl Iterator<Item = u64> {
        self.0.vertices.as_flattened().iter().map(|x| x.to_bits())
    }
}

impl PartialEq for Content<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.0.triangles == other.0.triangles && self.bits().eq(other.bits())
    }
}

impl Eq for Content<'_> {}

impl Hash for Content<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let Mesh { vertices, triangles } = self.0;
        (vertices.len(), triangles.len()).hash(state);
        for vertex in vertices.iter().step_by((vertices.len() / HASHED).max(1)) {
            vertex.map(f64::to_bits).hash(state);
        }
    }
}
