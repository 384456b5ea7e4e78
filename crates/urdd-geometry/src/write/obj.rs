//! Wavefront OBJ.

use super::super::read::Part;
use super::{WriteError, checked, single};

/// The only binary32 value (found by trying all) whose shortest text, 7.038531e-26, becomes its neighbour when parsed
/// as binary64 and then rounded. It is written with binary64 digits.
const ROUNDED_TWICE: u32 = 0x15ae_43fd;

/// Writes all parts as one OBJ: the vertices and faces of each part in turn, without materials.
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
    let mut first = 1_u64;
    for part in parts {
        for vertex in &part.mesh.vertices {
            text.push(b'v');
            for coordinate in single(*vertex) {
                let digits = if coordinate.abs().to_bits() == ROUNDED_TWICE {
                    float.format_finite(f64::from(coordinate))
                } else {
                    float.format_finite(coordinate)
                };
                text.push(b' ');
                text.extend_from_slice(digits.strip_suffix(".0").unwrap_or(digits).as_bytes());
            }
            text.push(b'\n');
        }
        for triangle in &part.mesh.triangles {
            text.push(b'f');
            for index in triangle {
                text.push(b' ');
                text.extend_from_slice(integer.format(first + u64::from(*index)).as_bytes());
            }
            text.push(b'\n');
        }
        first += part.mesh.vertices.len() as u64;
    }
    Ok(text)
}
