//! Writes meshes as binary STL, OBJ and GLB.
//!
//! All formats contain the same triangles in the same order: part by part, each in its own order. Coordinates are
//! written as binary32, which is lossless after [`round_to_f32`](crate::Mesh::round_to_f32). OBJ has the shortest text
//! of each binary32 value; a reader that parses it as binary64 must round, as `round_to_f32` does. The output depends
//! only on the parts: it contains no time or machine name.

mod glb;
mod normals;
mod obj;
mod stl;

pub use glb::{glb, smooth_glb};
pub use obj::obj;
pub use stl::stl;

use super::mesh::Mesh;
use super::read::Part;

/// Why a mesh cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// GLB cannot represent a mesh without triangles, so no format writes one.
    #[error("the mesh has no triangles; do not write it")]
    Empty,
    /// A coordinate has no finite binary32 value.
    #[error("vertex {vertex} of part {part} is not finite in binary32; call `round_to_f32` first")]
    NotFinite {
        /// Index of the part.
        part: usize,
        /// Index of the vertex in the part.
        vertex: usize,
    },
    /// A triangle references a missing vertex.
    #[error("triangle {triangle} of part {part} has a vertex index that is out of range")]
    IndexOutOfRange {
        /// Index of the part.
        part: usize,
        /// Index of the triangle in the part.
        triangle: usize,
    },
    /// The counts exceed the format's 32 bits.
    #[error("the mesh is too large for {0}; simplify it")]
    TooLarge(&'static str),
}

impl From<Mesh> for Part {
    /// A part without colour.
    fn from(mesh: Mesh) -> Self {
        Self { mesh, ..Self::default() }
    }
}

/// The parts with triangles, after checking that all parts can be written.
fn checked<'a>(parts: &'a [Part], format: &'static str) -> Result<Vec<&'a Part>, WriteError> {
    let used: Vec<&Part> = parts.iter().filter(|part| !part.mesh.triangles.is_empty()).collect();
    if used.is_empty() {
        return Err(WriteError::Empty);
    }
    for (index, part) in parts.iter().enumerate() {
        let is_finite = |vertex: &[f64; 3]| single(*vertex).iter().all(|value| value.is_finite());
        if let Some(vertex) = part.mesh.vertices.iter().position(|vertex| !is_finite(vertex)) {
            return Err(WriteError::NotFinite { part: index, vertex });
        }
        let count = part.mesh.vertices.len();
        let bad = |triangle: &[u32; 3]| triangle.iter().any(|corner| *corner as usize >= count);
        if let Some(triangle) = part.mesh.triangles.iter().position(bad) {
            return Err(WriteError::IndexOutOfRange { part: index, triangle });
        }
    }
    let vertices: usize = used.iter().map(|part| part.mesh.vertices.len()).sum();
    let triangles: usize = used.iter().map(|part| part.mesh.triangles.len()).sum();
    if u32::try_from(vertices.max(triangles)).is_err() {
        return Err(WriteError::TooLarge(format));
    }
    Ok(used)
}

#[allow(clippy::cast_possible_truncation)]
fn single(position: [f64; 3]) -> [f32; 3] {
    // Adding 0 turns -0 into 0.
    position.map(|coordinate| coordinate as f32 + 0.0)
}
