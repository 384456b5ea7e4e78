//! Wavefront OBJ.

use super::super::read::Part;
use super::{WriteError, checked, single};

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
