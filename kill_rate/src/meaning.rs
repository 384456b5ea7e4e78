//! Checks whether a file keeps its meaning after its bytes changed.

use serde_json::Value;

use super::original::Original;
use super::pointer;
use urdd_directory::json;
use urdd_geometry::read::{self, GltfUp, Options, Part, Scene};

/// Vertices that moved by less than this proportion of the largest coordinate count as equal: ten times the resolution
/// of meshes (SPEC 7.6: 8 * 2^-23).
pub(crate) const SAME_VERTEX: f64 = 10.0 * 8.0 / 8_388_608.0;

/// Whether a file of the URDD has the same meaning with other bytes.
pub(crate) fn is_same(original: &Original, path: &str, after: &[u8]) -> bool {
    let Some(before) = original.files.get(path) else {
        return false;
    };
    if before == after {
        return true;
    }
    let name = path.rsplit('/').next().unwrap_or(path);
    match name.rsplit_once('.').map_or("", |(_, extension)| extension) {
        "json" => match (json::read(before), json::read(after)) {
            (Ok(a), Ok(b)) => fields(a.value) == fields(b.value) && b.faults == a.faults,
            _ => false,
        },
        "yaml" => is_same_but_for_space(before, after),
        _ if name == "VERSION" => without_newline(before) == without_newline(after),
        _ if path.contains("/meshes/") => is_same_mesh(original, path, after),
        _ => false,
    }
}

/// A document without extension keys and `$schema`.
fn fields(value: Value) -> Value {
    match value {
        Value::Object(object) => {
            let members = object.into_iter().filter(|(key, _)| pointer::is_field(key));
            members.map(|(key, value)| (key, fields(value))).collect()
        }
        Value::Array(list) => list.into_iter().map(fields).collect(),
        other => other,
    }
}

/// Whether YAML differs only in ways that may not matter: trailing white space, bytes that are white space before or
/// after, and letter case (`Null` is also `null`).
fn is_same_but_for_space(before: &[u8], after: &[u8]) -> bool {
    let space = |(a, b): (&u8, &u8)| {
        a.eq_ignore_ascii_case(b) || a.is_ascii_whitespace() || b.is_ascii_whitespace()
    };
    before.trim_ascii_end() == after.trim_ascii_end()
        || before.len() == after.len() && before.iter().zip(after).all(space)
}

fn without_newline(text: &[u8]) -> &[u8] {
    text.strip_suffix(b"\n").unwrap_or(text)
}

fn is_same_mesh(original: &Original, path: &str, after: &[u8]) -> bool {
    let carried =
        original.module_of(path).is_some_and(|(name, _)| name == "original_meshes_module");
    let mut mesh = path.to_owned();
    let listed = original
        .document("original_meshes_module")
        .and_then(|document| document.value.get("files")?.as_array());
    for file in listed.into_iter().flatten().filter(|_| carried) {
        let sides = file.get("side_files").and_then(|sides| sides.as_array());
        if let (Some(sides), Some(listed)) = (sides, file["path"].as_str())
            && sides.iter().any(|side| side == path)
        {
            mesh = listed.to_owned();
        }
    }
    let before = scene(original, &mesh, None);
    let after = scene(original, &mesh, Some((path, after)));
    match (before, after) {
        (Some(before), Some(after)) => are_same(&before, &after),
        // Not a mesh before or after.
        (None, None) => true,
        _ => false,
    }
}

/// A mesh of the URDD in the axes of its file, read with one file replaced. `None` if it is not a mesh.
pub(crate) fn scene(
    original: &Original,
    path: &str,
    replaced: Option<(&str, &[u8])>,
) -> Option<Scene> {
    let bytes = |path: &str| match replaced {
        Some((replaced, bytes)) if replaced == path => Some(bytes.to_vec()),
        _ => original.files.get(path).cloned(),
    };
    let (folder, name) = path.rsplit_once('/')?;
    let mut fetch = |side: &str| bytes(&format!("{folder}/{}", side.trim_start_matches("./")));
    let options = Options { gltf_up: GltfUp::Keep, ..Options::default() };
    let scene = read::read_with(&bytes(path)?, name, &mut fetch, &options).ok()?;
    scene.parts.iter().any(|part| !part.mesh.triangles.is_empty()).then_some(scene)
}

/// Whether two scenes have the same triangles, in the same colours.
fn are_same(a: &Scene, b: &Scene) -> bool {
    let corners = |parts: &[Part]| -> Vec<[[f64; 3]; 3]> {
        let triangles = parts.iter().flat_map(|part| {
            let mesh = &part.mesh;
            mesh.triangles.iter().map(|triangle| mesh.corners(*triangle))
        });
        triangles.collect()
    };
    let colours = |scene: &Scene| -> Vec<(Option<[f64; 4]>, usize)> {
        let of = |part: &Part| (part.color, part.mesh.triangles.len());
        scene.parts.iter().map(of).collect()
    };
    let (here, there) = (corners(&a.parts), corners(&b.parts));
    let largest = here.iter().flatten().flatten().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let near = |(p, q): (&f64, &f64)| (p - q).abs() <= SAME_VERTEX * largest;
    colours(a) == colours(b)
        && here.len() == there.len()
        && here.iter().flatten().flatten().zip(there.iter().flatten().flatten()).all(near)
}
