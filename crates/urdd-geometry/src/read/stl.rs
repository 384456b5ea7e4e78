//! STL, binary and ASCII.

use nalgebra::Matrix4;

use super::assembly::{Assembly, Material, within};
use super::bytes::{Words, skip_byte_order_mark};
use super::scene::{Failure, Fault, NoteCode, Place};
use crate::mesh::Mesh;
use crate::polygon::fan;

const HEADER: usize = 84;
const RECORD: usize = 50;

/// Reads binary STL: an arbitrary header of 80 bytes, a count, and 50 bytes per triangle.
///
/// The count is used if there is data for it. Some writers never fill in the count: if it is 0, all complete records
/// are read. A count beyond the end means a truncated file or a placeholder: the complete records are read.
pub(super) fn read_binary(bytes: &[u8], assembly: &mut Assembly) -> Result<(), Failure> {
    // `format_of` has found a whole header.
    let (count, data) = (word(&bytes[80..]) as usize, &bytes[HEADER..]);
    let whole = data.len() / RECORD;
    let used = if count == 0 { whole } else { count.min(whole) };
    if used == 0 && count > 0 {
        let text = format!("the header states {count} triangles, but none is complete");
        return Err(Failure::from(Fault::Truncated(text)).at(|| Place::Byte(bytes.len())));
    }
    if count > whole {
        let text = format!(
            "the file is cut off: it contains {whole} of the {count} triangles that its header states"
        );
        assembly.notes.add(NoteCode::CutOff, text);
    } else if used != count {
        let text = format!("the header states 0 triangles, but the file contains {used}");
        assembly.notes.add(NoteCode::WrongCount, text);
    } else if data.len() != used * RECORD {
        let text =
            format!("{} bytes after the last triangle were ignored", data.len() - used * RECORD);
        assembly.notes.add(NoteCode::WrongCount, text);
    }
    let mut mesh =
        Mesh { vertices: Vec::with_capacity(used * 3), triangles: Vec::with_capacity(used) };
    for record in data.chunks_exact(RECORD).take(used) {
        // Skip the stored normal: it is often 0, and the corners determine it.
        let corner = |at: usize| {
            std::array::from_fn(|axis| f64::from(f32::from_bits(word(&record[at + 4 * axis..]))))
        };
        push_triangle(&mut mesh, [corner(12), corner(24), corner(36)])?;
    }
    assembly.add(&mesh, &Matrix4::identity(), &Material::default())
}

/// Reads ASCII STL. Line breaks do not matter; a loop of more than three vertices becomes a fan.
pub(super) fn read_ascii(bytes: &[u8], assembly: &mut Assembly) -> Result<(), Failure> {
    let mut words = Words::new(skip_byte_order_mark(bytes));
    let mut mesh = Mesh::default();
    let mut corners: Vec<[f64; 3]> = Vec::new();
    let mut open = false;
    while let Some(word) = words.next() {
        if word.eq_ignore_ascii_case(b"vertex") {
            let coordinates = [words.float(), words.float(), words.float()];
            if coordinates.iter().any(Option::is_none) {
                break;
            }
            corners.push(coordinates.map(|coordinate| coordinate.unwrap_or(f64::NAN)));
        } else if word.eq_ignore_ascii_case(b"endloop") || word.eq_ignore_ascii_case(b"endfacet") {
            for triangle in fan(&corners) {
                push_triangle(&mut mesh, triangle)?;
            }
            corners.clear();
        } else if word.eq_ignore_ascii_case(b"solid") {
            // The rest of the line is a name, which may contain any word.
            open = true;
            words.skip_line();
        } else if word.eq_ignore_ascii_case(b"endsolid") {
            open = false;
            words.skip_line();
        }
    }
    if open {
        let text = "the file is cut off: `endsolid` is missing; everything before its end was read";
        assembly.notes.add(NoteCode::CutOff, text);
    }
    assembly.add(&mesh, &Matrix4::identity(), &Material::default())
}

fn push_triangle(mesh: &mut Mesh, corners: [[f64; 3]; 3]) -> Result<(), Failure> {
    let corner = mesh.vertices.len();
    mesh.vertices.extend(corners);
    within("vertices", mesh.vertices.len(), u32::MAX as usize)?;
    let triangle = [corner, corner + 1, corner + 2];
    mesh.triangles.push(triangle.map(|corner| corner as u32));
    Ok(())
}

fn word(bytes: &[u8]) -> u32 {
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}
