//! Triangles of a mesh file.

use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_geometry::read::{GltfUp, Options, read_with};

use crate::files::Files;
use crate::{answer, memory};

/// Maximum number of triangles of a mesh file.
const MAX_TRIANGLES: usize = 5_000_000;

/// The triangles of a mesh file as stored in the URDD (without an axis conversion for .glb): an answer of
/// [`answer::bytes_or_error`] with little-endian 32-bit words: the number of vertices; the number of triangles; x, y, z
/// of each vertex, binary32; three indices of each triangle.
///
/// # Safety
/// `files` is open; the path, in UTF-8, is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_mesh(files: *mut Files, path: *const u8, length: usize) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, path) = unsafe { (&*files, memory::bytes(path, length)) };
    answer::bytes_or_error(triangles(files, &String::from_utf8_lossy(path)))
}

fn triangles(files: &Files, path: &str) -> Result<Vec<u8>, String> {
    let bytes = files.read(path, MAX_DOCUMENT_BYTES)?;
    let options =
        Options { gltf_up: GltfUp::Keep, max_triangles: MAX_TRIANGLES, ..Options::default() };
    let scene =
        read_with(&bytes, path, &mut |_| None, &options).map_err(|error| match &error.place {
            Some(place) => format!("{place}: {}", error.fault),
            None => error.fault.to_string(),
        })?;
    let mesh = scene.merged();
    let words = 2 + 3 * (mesh.vertices.len() + mesh.triangles.len());
    let mut out = Vec::with_capacity(4 * words);
    let mut word = |word: u32| out.extend_from_slice(&word.to_le_bytes());
    let count = |count: usize| u32::try_from(count).map_err(|_| "it is too large".to_owned());
    word(count(mesh.vertices.len())?);
    word(count(mesh.triangles.len())?);
    for x in mesh.vertices.iter().flatten() {
        word((*x as f32).to_bits());
    }
    mesh.triangles.iter().flatten().for_each(|index| word(*index));
    Ok(out)
}
