//! glTF 2.0, as JSON and as GLB.

mod accessor;
mod json;
mod scene;

use super::assembly::Assembly;
use super::bytes::skip_byte_order_mark;
use super::error::{Failure, Fault, NoteCode, Place};
use accessor::{Buffers, Fetch, is_data};

/// The beginnings of names of extensions for textures, lights and materials, which leave positions as they are.
const LOOKS: [&str; 5] =
    ["KHR_texture_", "EXT_texture_", "KHR_lights_", "EXT_lights_", "KHR_materials_"];

/// Reads a .gltf.
pub(super) fn read_json(
    bytes: &[u8],
    fetch: Fetch<'_>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    read_document(skip_byte_order_mark(bytes), None, fetch, assembly)
}

/// Reads a .glb: a 12-byte header, a JSON chunk, and optionally a binary chunk. Clamps lengths beyond the end of the
/// file. A wrong total length adds a note; missing data fails where it is used.
pub(super) fn read_binary(
    bytes: &[u8],
    fetch: Fetch<'_>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    let word = |at: usize| {
        bytes.get(at..at + 4).and_then(|word| word.try_into().ok()).map(u32::from_le_bytes)
    };
    let cut = || Fault::Truncated("a GLB has a header of 12 bytes and a chunk of JSON".to_owned());
    let version = word(4).ok_or_else(cut)?;
    if version != 2 {
        let text = format!("GLB version {version} is not supported, only version 2");
        return Err(Fault::not_supported(text));
    }
    let length = word(8).ok_or_else(cut)? as usize;
    if length != bytes.len() {
        let text = format!("the header states {length} bytes, but the file has {}", bytes.len());
        let is_cut = length > bytes.len();
        assembly.notes.add(if is_cut { NoteCode::CutOff } else { NoteCode::WrongCount }, text);
    }
    let mut chunks = Vec::new();
    let mut at = 12;
    while let (Some(length), Some(kind), true) = (word(at), word(at + 4), chunks.len() < 2) {
        let start = at + 8;
        let end = start.saturating_add(length as usize).min(bytes.len());
        chunks.push((kind, &bytes[start..end]));
        at = end;
    }
    const JSON: u32 = u32::from_le_bytes(*b"JSON");
    const BIN: u32 = u32::from_le_bytes(*b"BIN\0");
    match chunks[..] {
        [(JSON, json), (BIN, data), ..] => read_document(json, Some(data), fetch, assembly),
        [(JSON, json), ..] => read_document(json, None, fetch, assembly),
        [] => Err(cut().into()),
        _ => Err(Fault::malformed("the first chunk is not JSON").at(|| Place::Byte(12))),
    }
}

fn read_document(
    json: &[u8],
    data: Option<&[u8]>,
    fetch: Fetch<'_>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    let root: json::Root = serde_json::from_slice(json.trim_ascii_end()).map_err(|error| {
        let line = error.line();
        Fault::malformed(format!("the JSON is not glTF ({error})")).at(|| Place::Line(line))
    })?;
    if !root.asset.version.starts_with("2.") {
        let version = &root.asset.version;
        let text = format!("glTF version '{version}' is not supported, only 2.x");
        return Err(Fault::not_supported(text));
    }
    for extension in &root.extensions_required {
        match extension.as_str() {
            "KHR_draco_mesh_compression"
            | "EXT_meshopt_compression"
            | "KHR_meshopt_compression" => {
                return Err(Fault::not_supported(format!("the mesh is compressed ({extension})")));
            }
            "KHR_mesh_quantization" => {}
            other if LOOKS.iter().any(|look| other.starts_with(look)) => {}
            other => {
                let text = format!("the extension {other} is required, but not supported");
                assembly.notes.add(NoteCode::LeftOut, text);
            }
        }
    }
    if !root.animations.is_empty() {
        assembly.notes.add(NoteCode::ShownOtherwise, "its animations were left out");
    }
    let files = root.images.iter().chain(&root.buffers);
    for uri in files.filter_map(|file| file.uri.as_deref()) {
        if !is_data(uri) {
            assembly.add_side_file(&super::collada::path_of_url(uri));
        }
    }
    scene::walk(&mut Buffers::new(&root, data, fetch), assembly)
}
