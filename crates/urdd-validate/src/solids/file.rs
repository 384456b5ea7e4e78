//! Mesh files: their bytes, what is wrong with their format, and the carried meshes that the URDF names.

use std::collections::{BTreeSet, HashMap};
use std::io::{self, Read};

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::tolerance::{STL_NORMAL, mesh_resolution};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::path::beside;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_document::urdd::Urdd;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_geometry::Mesh;
use urdd_geometry::read::{Format, GltfUp, MeshError, NoteCode, Options, Scene, read, read_with};
use urdd_geometry::surface::is_thin;
use urdd_xml::foreign::LFS_POINTER;

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
pub fn read_bytes(
    files: &mut MeshFiles,
    profile: Profile,
    path: &str,
) -> Result<Vec<u8>, MeshFault> {
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

/// Length of the header: magic, version, length of the file.
const GLB_HEADER: u64 = 12;
/// Length of what is before a chunk's content: its length and kind.
const CHUNK_HEAD: u64 = 8;

/// The fault of the header of a binary glTF of `size` bytes, or of the list of its chunks (SPEC 7.6). What the chunks hold is not
/// looked at: reads up to the head of the last one.
///
/// # Errors
/// If the file cannot be read.
pub fn glb_fault(file: impl Read, size: u64) -> io::Result<Option<String>> {
    let mut file = file.take(size);
    let header = next_bytes(&mut file, GLB_HEADER)?;
    match header_fault(&header, size) {
        Some(fault) => Ok(Some(fault)),
        None => chunk_fault(&mut file, size),
    }
}

/// The next bytes, fewer where the file ends.
fn next_bytes(file: &mut impl Read, length: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(length).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

fn header_fault(header: &[u8], size: u64) -> Option<String> {
    let begins = |text: &[u8]| header.starts_with(text);
    Some(match (word(header, 4), word(header, 8)) {
        _ if begins(b"{") => "it is glTF as JSON (a .gltf file)".to_owned(),
        _ if LFS_POINTER.get(..header.len()) == Some(header) && header.len() > 8 => {
            "it is a Git LFS pointer; fetch the file itself".to_owned()
        }
        _ if !begins(b"glTF") => "it does not begin with `glTF`".to_owned(),
        (Some(2), Some(length)) if u64::from(length) == size => return None,
        (Some(2), Some(length)) => format!("its header says {length} bytes, and it has {size}"),
        (Some(version), Some(_)) => format!("it is of glTF version {version}"),
        _ => format!("it has only {} bytes", header.len()),
    })
}

/// The fault of the chunks, which follow the header up to the file's end.
fn chunk_fault(file: &mut impl Read, size: u64) -> io::Result<Option<String>> {
    let mut at = GLB_HEADER;
    loop {
        let head = next_bytes(file, CHUNK_HEAD)?;
        let (Some(length), Some(kind)) = (word(&head, 0), head.get(4..8)) else {
            let what = if at == GLB_HEADER { "header" } else { "last chunk" };
            return Ok(Some(format!(
                "{} bytes follow its {what}, too few for a chunk",
                head.len()
            )));
        };
        let (length, room) = (u64::from(length), size.saturating_sub(at + CHUNK_HEAD));
        if at == GLB_HEADER && kind != b"JSON" {
            return Ok(Some("its first chunk is not JSON".to_owned()));
        }
        if !length.is_multiple_of(4) {
            let text = "bytes, which is not a multiple of four";
            return Ok(Some(format!("its chunk at byte {at} has {length} {text}")));
        }
        if length > room {
            let text = format!("its chunk at byte {at} says {length} bytes, and {room} follow");
            return Ok(Some(text));
        }
        if length == room {
            return Ok(None);
        }
        at += CHUNK_HEAD + length;
        io::copy(&mut file.by_ref().take(length), &mut io::sink())?;
    }
}

pub const STL_HEADER: usize = 84;
pub const STL_RECORD: usize = 50;

/// The fault of the normals or the unused bytes of a binary STL, for its first faulty triangle: what it has besides
/// corners. These are assumed
/// sound.
pub fn stl_fault(stl: &[u8]) -> Option<String> {
    stl.get(STL_HEADER..)?.chunks_exact(STL_RECORD).enumerate().find_map(|(at, record)| {
        let mut numbers = [0.0; 12];
        for (number, bytes) in numbers.iter_mut().zip(record.as_chunks().0) {
            *number = f64::from(f32::from_le_bytes(*bytes));
        }
        let &[normal, a, b, c] = numbers.as_chunks().0 else { return None };
        let (normal, corners) = (Vector3::from(normal), [a, b, c]);
        let extent = numbers[3..].iter().map(|x| x.abs()).fold(0.0, f64::max);
        if record[48..] != [0, 0] {
            return Some(format!(
                "triangle {at} has {:?} in the two unused bytes; write zeros",
                &record[48..]
            ));
        }
        // A zero normal means that it is to be computed, which is impossible for a thin triangle.
        if normal == Vector3::zeros() || is_thin(corners, mesh_resolution(extent) / STL_NORMAL) {
            return None;
        }
        let (a, b, c) = (Vector3::from(a), Vector3::from(b), Vector3::from(c));
        let right = (b - a).cross(&(c - a)).normalize();
        let off = (right - normal).norm();
        (off.is_nan() || off > STL_NORMAL).then(|| {
            format!(
                "the normal of triangle {at} is not the one of its corners; write that, or zeros"
            )
        })
    })
}

/// A mesh that the URDF names.
#[derive(Debug)]
pub struct Original {
    /// Its content in the axes of the URDF's mesh element, metres; or why it cannot be read as a mesh with a surface.
    pub mesh: Result<Mesh, MeshFault>,
    /// The existing files that it names, sorted; `None` if it cannot be read.
    pub side_files: Option<Vec<String>>,
    /// Whether a URDD may say that it is no mesh all the same (SPEC 7.5).
    pub may_be_refused: bool,
}

/// Reads every mesh of `original_meshes_module`, by its path as written.
pub fn read_originals(urdd: &Urdd) -> HashMap<String, Original> {
    let (profile, paths) = paths(urdd);
    paths
        .into_par_iter()
        .map_init(
            || MeshFiles::new(urdd),
            |files, path| (path.to_owned(), read_one(files, profile, path)),
        )
        .collect()
}

/// A mesh that the URDF names, with its faces uncut (see [`Options`]); `None` if it cannot be read.
pub fn uncut(urdd: &Urdd, path: &str) -> Option<Mesh> {
    let (profile, _) = paths(urdd);
    let bytes = read_bytes(&mut MeshFiles::new(urdd), profile, path).ok()?;
    let options = Options { uncut: true, ..Options::default() };
    let scene = read_with(&bytes, path, &mut |_| None, &options).ok()?;
    matches!(scene.format, Format::Obj | Format::Collada).then(|| scene.merged())
}

fn paths(urdd: &Urdd) -> (Profile, BTreeSet<&str>) {
    match urdd.document(ModuleKind::OriginalMeshes) {
        Some(ModuleDocument::OriginalMeshes(module)) => {
            let paths = module.files.iter().map(|file| file.path.as_str());
            (Profile::V1, paths.collect())
        }
        _ => {
            let meshes = urdd.meshes(ModuleKind::OriginalMeshes);
            let paths = meshes.iter().flat_map(|meshes| meshes.paths());
            (Profile::Legacy, paths.map(|(_, path)| path.path).collect())
        }
    }
}

fn read_one(files: &mut MeshFiles, profile: Profile, path: &str) -> Original {
    let mut scene = || {
        let bytes = read_bytes(files, profile, path)?;
        let mut fetch = |side: &str| read_bytes(files, profile, &beside(path, side)?).ok();
        read(&bytes, path, &mut fetch).map_err(|error| MeshFault::Broken(without_name(&error)))
    };
    let scene = match scene() {
        Ok(scene) => scene,
        Err(fault) => {
            return Original { mesh: Err(fault), side_files: None, may_be_refused: false };
        }
    };
    let named: BTreeSet<String> = scene
        .side_files
        .iter()
        .filter_map(|side| beside(path, side))
        .filter(|side| side != path && files.find(profile, side).is_ok())
        .collect();
    let mesh = scene.merged();
    let nothing = || MeshFault::Broken("it holds no triangle with an area".to_owned());
    Original {
        mesh: if mesh.area() > 0.0 { Ok(mesh) } else { Err(nothing()) },
        side_files: Some(named.into_iter().collect()),
        may_be_refused: scene.notes.iter().any(|note| note.code == NoteCode::ReadOtherwise),
    }
}
