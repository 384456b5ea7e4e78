//! Reads a mesh file.

use std::io::Read;

use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_format::registry::Profile;
use urdd_geometry::read::{GltfUp, MeshError, NoteCode, Options, Scene, read_with};

#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MeshFault {
    /// It cannot be opened, which other rules report.
    Absent(Absence),
    /// It is larger than the limit; its size, bytes.
    TooLarge(u64),
    /// It is not a mesh; the reason.
    Broken(String),
}

/// The bytes of a mesh file.
///
/// # Errors
/// If it is missing or too large.
pub fn bytes(files: &mut MeshFiles, profile: Profile, path: &str) -> Result<Vec<u8>, MeshFault> {
    let (file, size) = files.open(profile, path).map_err(MeshFault::Absent)?;
    if size > MAX_DOCUMENT_BYTES {
        return Err(MeshFault::TooLarge(size));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or(0));
    // A file that grows while it is read is cut at its original size.
    file.take(MAX_DOCUMENT_BYTES)
        .read_to_end(&mut bytes)
        .map_err(|error| MeshFault::Broken(format!("it cannot be read: {error}")))?;
    Ok(bytes)
}

/// The content of a derived mesh file, in link axes, and why it is unsound, if the reader had to repair it.
///
/// # Errors
/// If it is not a mesh.
pub fn derived(
    bytes: &[u8],
    path: &str,
    profile: Profile,
) -> Result<(Scene, Option<String>), MeshFault> {
    let options = Options { gltf_up: GltfUp::Keep, ..Options::default() };
    // A derived mesh is read alone: a material file is not part of its surface.
    let scene = read_with(bytes, path, &mut |_| None, &options)
        .map_err(|error| MeshFault::Broken(without_name(&error)))?;
    let named = scene.side_files.first().filter(|_| profile == Profile::V1);
    let fault = named.map(|name| format!("it names another file, `{name}`")).or_else(|| {
        scene.notes.iter().find(|note| is_fault(note.code, profile)).map(ToString::to_string)
    });
    Ok((scene, fault))
}

/// The message, without the file's name, which the finding adds.
pub fn without_name(error: &MeshError) -> String {
    match &error.place {
        Some(place) => format!("{place}: {}", error.fault),
        None => error.fault.to_string(),
    }
}

/// Whether a note of the reader makes a derived mesh unsound. In legacy modules, transforms of nodes and content other
/// than triangles are allowed.
fn is_fault(code: NoteCode, profile: Profile) -> bool {
    match code {
        NoteCode::SideFileMissing
        | NoteCode::TurnedToZUp
        | NoteCode::Assumed
        | NoteCode::WrongExtension => false,
        NoteCode::NodeTransform
        | NoteCode::UnusedVertices
        | NoteCode::WrongBounds
        | NoteCode::WrongNormals
        | NoteCode::ShownOtherwise => profile == Profile::V1,
        _ => true,
    }
}
