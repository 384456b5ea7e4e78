//! What a picture of a robot is made of: the visual and collision elements of the URDF with their files, and the
//! triangles of a mesh file.

use serde_json::{Value, json};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_document::robot::Element;
use urdd_format::colors::Colors;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::{MeshReference, OriginalMeshesModule};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::Geometry;
use urdd_geometry::read::{GltfUp, Options, read_with};
use urdd_robot::Robot;

use crate::about::quaternion;
use crate::files::Files;
use crate::{answer, memory};

/// The visual and collision elements, links ascending, visual first: `link`, `geometry` (`Visual` or `Collision`),
/// `element`, `position` (m) and `quaternion_wxyz` in the link's frame, `shape` (an object of one key as in
/// `urdf_module`; null without one), `path` (of the mesh file in the URDD, or null), its `side_files`, and `rgba` of
/// the URDF's material, or null.
pub fn sources(robot: &Robot) -> Result<Value, String> {
    let read = [ModuleKind::Urdf, ModuleKind::OriginalMeshes];
    let part = robot.part_as_it_is(&read).map_err(|error| error.to_string())?;
    let Some(known) = part.robot() else {
        return Err("urdf_module is missing or cannot be read".to_owned());
    };
    let originals = match part.document(ModuleKind::OriginalMeshes) {
        Some(ModuleDocument::OriginalMeshes(module)) => Some(&**module),
        _ => None,
    };
    let description = robot.description().ok();
    let colors = description.as_ref().map(Colors::of);
    let mut found = Vec::new();
    for (link, of) in known.links.iter().enumerate() {
        let visual = of.visual.iter().enumerate();
        for (k, element) in visual {
            let mut value = one(link, GeometryKind::Visual, k, element, originals);
            let visual = description.as_ref().and_then(|urdf| urdf.links.get(link)?.visual.get(k));
            let material = visual.and_then(|visual| visual.material.as_ref());
            value["rgba"] = json!(colors.as_ref().and_then(|colors| colors.get(material)));
            found.push(value);
        }
        let collision = of.collision.iter().enumerate();
        found.extend(collision.map(|(k, e)| one(link, GeometryKind::Collision, k, e, originals)));
    }
    Ok(Value::from(found))
}

fn one(
    link: usize,
    kind: GeometryKind,
    index: usize,
    element: &Element,
    originals: Option<&OriginalMeshesModule>,
) -> Value {
    let is_own = |reference: &&MeshReference| {
        reference.link_idx.get() == link
            && reference.geometry == kind
            && reference.element_idx.get() == index
    };
    let is_mesh = matches!(element.geometry, Some(Geometry::Mesh(_)));
    let path = originals
        .filter(|_| is_mesh)
        .and_then(|module| module.references.iter().find(is_own)?.path.as_ref());
    let file = originals
        .zip(path)
        .and_then(|(module, path)| module.files.iter().find(|file| file.path == *path));
    json!({
        "link": link,
        "geometry": kind,
        "element": index,
        "position": element.origin.xyz,
        "quaternion_wxyz": quaternion(&element.origin),
        "shape": element.geometry,
        "path": path,
        "side_files": file.map_or(&[][..], |file| &file.side_files),
        "rgba": null,
    })
}

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
