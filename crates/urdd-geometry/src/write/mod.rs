//! Writes meshes as binary STL, OBJ and GLB.
//!
//! All formats contain the same triangles in the same order: part by part, each in its own order. Coordinates are
//! written as binary32, which is lossless after [`round_to_f32`](crate::Mesh::round_to_f32). OBJ has the shortest text
//! of each binary32 value; a reader that parses it as binary64 must round, as `round_to_f32` does. The output depends
//! only on the parts: it contains no time or machine name.

mod glb;

pub use glb::{glb, smooth_glb};

use super::mesh::{Mesh, double_area_normal};
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

fn single(position: [f64; 3]) -> [f32; 3] {
    // Adding 0 turns -0 into 0.
    position.map(|coordinate| coordinate as f32 + 0.0)
}

/// The only binary32 value (found by trying all) whose shortest text, 7.038531e-26, becomes its neighbour when parsed
/// as binary64 and then rounded. It is written with binary64 digits.
const ROUNDED_TWICE: u32 = 0x15ae_43fd;

/// Writes all parts as one OBJ: the vertices and faces of each part in turn, without materials. A part with a texture has
/// its texture coordinates.
///
/// # Errors
/// [`WriteError`] if there are no triangles, or if a part is invalid.
pub fn obj(parts: &[Part]) -> Result<Vec<u8>, WriteError> {
    let parts = checked(parts, "OBJ")?;
    let size: usize = parts
        .iter()
        .map(|part| part.mesh.vertices.len() * 36 + part.mesh.triangles.len() * 21)
        .sum();
    let mut text = Vec::with_capacity(size);
    let mut float = zmij::Buffer::new();
    let mut integer = itoa::Buffer::new();
    let [mut first, mut first_uv] = [1_u64; 2];
    for part in parts {
        let mut write = |name: &[u8], numbers: &[f32]| {
            text.extend_from_slice(name);
            for coordinate in numbers {
                let coordinate = *coordinate;
                let digits = if coordinate.abs().to_bits() == ROUNDED_TWICE {
                    float.format_finite(f64::from(coordinate))
                } else {
                    float.format_finite(coordinate)
                };
                text.push(b' ');
                text.extend_from_slice(digits.strip_suffix(".0").unwrap_or(digits).as_bytes());
            }
            text.push(b'\n');
        };
        part.mesh.vertices.iter().for_each(|vertex| write(b"v", &single(*vertex)));
        let uvs = part.texture.as_ref().map_or(&[][..], |texture| &texture.uv);
        let uvs = if uvs.len() == part.mesh.vertices.len() { uvs } else { &[] };
        uvs.iter().for_each(|[u, v]| write(b"vt", &single([*u, *v, 0.0])[..2]));
        for triangle in &part.mesh.triangles {
            text.push(b'f');
            for index in triangle {
                text.push(b' ');
                text.extend_from_slice(integer.format(first + u64::from(*index)).as_bytes());
                if !uvs.is_empty() {
                    text.push(b'/');
                    let index = first_uv + u64::from(*index);
                    text.extend_from_slice(integer.format(index).as_bytes());
                }
            }
            text.push(b'\n');
        }
        first += part.mesh.vertices.len() as u64;
        first_uv += uvs.len() as u64;
    }
    Ok(text)
}

/// Must not start with "solid": some readers would take the file for ASCII STL.
const HEADER: &[u8] = b"binary STL, metres";

/// Writes all parts as one binary STL. Normals are computed from the triangles; 0 for a triangle without area.
///
/// # Errors
/// [`WriteError`] if there are no triangles, or if a part is invalid.
pub fn stl(parts: &[Part]) -> Result<Vec<u8>, WriteError> {
    let parts = checked(parts, "STL")?;
    let count: usize = parts.iter().map(|part| part.mesh.triangles.len()).sum();
    let mut bytes = Vec::with_capacity(84 + 50 * count);
    bytes.extend_from_slice(HEADER);
    bytes.resize(80, 0);
    bytes.extend(u32::try_from(count).map_err(|_| WriteError::TooLarge("STL"))?.to_le_bytes());
    for part in parts {
        for triangle in &part.mesh.triangles {
            let corners = triangle.map(|index| single(part.mesh.vertices[index as usize]));
            let normal = double_area_normal(corners.map(|corner| corner.map(f64::from)));
            let normal = normal.try_normalize(0.0).unwrap_or_default();
            for number in
                [single(normal.into()), corners[0], corners[1], corners[2]].into_iter().flatten()
            {
                bytes.extend(number.to_le_bytes());
            }
            bytes.extend([0, 0]);
        }
    }
    Ok(bytes)
}
