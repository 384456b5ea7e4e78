//! Readers for the mesh formats that URDFs reference.
//!
//! # What each reader handles
//!
//! | | STL | COLLADA (.dae) | OBJ | glTF, GLB |
//! |---|---|---|---|---|
//! | versions | binary, ASCII (any case, several solids) | 1.4, 1.5 | as common tools write it | 2.0 |
//! | faces | triangles | triangles, polylist, polygons, trifans, tristrips | triangles, n-gons, negative indices, continued lines | triangles, strips, fans, with and without indices (8, 16, 32 bits) |
//! | placement | none | matrix, translate, rotate, scale, skew, lookat in order; nested nodes, `instance_node`, repeated geometries | none | matrix or translation, rotation, scale; nested nodes; the default scene |
//! | lengths | unchanged | times `unit` | unchanged | metres |
//! | up axis | none | `up_axis` is *not* applied | none | y-up is converted to z-up (see [`GltfUp`]) |
//! | colours | none | diffuse colour (emission for `constant`) | `Kd` and `d` of the .mtl | `baseColorFactor`, `diffuseFactor` |
//! | ignored | the attribute bytes (some tools store colours there) | lines, splines, textures, animation, skins (the bind shape is read), polygon holes | lines, points, curves, textures, vertex colours | points, lines, textures, animation, morph targets, skins (read without deformation) |
//! | rejected | no complete triangle | invalid UTF-16, a DTD | nothing: a face with an index 0 or a malformed index is dropped with a note | version 1, Draco, meshopt |
//! | repaired, with a note | wrong count, truncation, NaN corners, a header that begins with `solid` | NaN, indices out of range, missing scene, invalid UTF-8 | NaN, indices out of range, missing .mtl | NaN, indices out of range, wrong lengths in the GLB header |
//!
//! A part with a texture has no colour, because its true colour is in the image. [`Options::textures`] reads that too. Colours are clamped to 0 to 1, and not
//! converted between sRGB and linear values.
//!
//! # Axes and lengths
//!
//! URDF does not define the axes and units inside mesh files, so these readers follow common URDF tools.
//!
//! COLLADA's `unit` is applied, as the format requires and as RViz, MoveIt, Gazebo and three.js do. Assimp 6 through
//! Pinocchio's coal, `PyBullet` and trimesh ignore it: they read a file in inches 39 times too large. `up_axis` is
//! ignored, as in RViz, MoveIt, coal, `PyBullet`, trimesh and Habitat. Exporters set it arbitrarily (95 of 331 files of
//! known robots do not declare `Z_UP`), and the robots look right only without it.
//!
//! In glTF, y is up. RViz 2 (since June 2025), Drake, Genesis and Blender convert to z-up; older RViz, coal and trimesh
//! do not. These readers convert and add a note. [`Options`] can keep the axes, which is right for a URDD's own .glb
//! files.
//!
//! # Why not existing readers
//!
//! Existing crates, tested in 2026 on 2,100 robot meshes and on broken ones: `stl_io` 0.11 takes a binary file that
//! begins with `solid` for text, and fails on a truncated one. `mesh-loader` 0.1.13 rejects three of 574 real STL files
//! and all truncated ones, ignores the count, places each COLLADA geometry once, and computes in binary32. `dae-parser`
//! 0.11 rejects 85 of 331 real files. `tobj` 4.0 panics on `Kd 1 1`, and rejects `vt` with one number, continued lines
//! and a missing .mtl. `gltf` 1.4 rejects accessors without bounds, panics on accessors without elements, with a huge
//! count or with another component type, and reads nothing from accessors without a view. The readers here build on
//! `urdd-xml`, `serde_json`, `base64`, `percent-encoding` and `earcut`.
//!
//! # Resource limits
//!
//! Memory is proportional to the input. Where a file can reference more than it contains (instances of instances, empty
//! accessors), a limit applies. No input makes a reader panic.

mod assembly;
mod bytes;
mod collada;
mod gltf;
mod obj;
mod scene;
mod stl;

pub use scene::{
    Fault, Format, GltfUp, MeshError, Note, NoteCode, Options, Part, Place, Scene, Texture,
};

use assembly::Assembly;
use scene::Failure;

/// Reads a mesh file as a URDF's mesh element uses it.
///
/// `name` is the file's name: errors contain it, and its extension decides where the content is ambiguous. `fetch`
/// returns the bytes of a side file, given the name that the mesh uses. The reader itself opens no files.
///
/// # Errors
/// [`MeshError`] if the content cannot be read. Repairs do not fail; they add notes to the scene.
pub fn read(
    bytes: &[u8],
    name: &str,
    fetch: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<Scene, MeshError> {
    read_with(bytes, name, fetch, &Options::default())
}

/// As [`read`], with options.
///
/// # Errors
/// As [`read`].
pub fn read_with(
    bytes: &[u8],
    name: &str,
    fetch: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
    options: &Options,
) -> Result<Scene, MeshError> {
    let in_file = |failure: Failure| failure.in_file(name);
    let format = bytes::format_of(bytes, name).map_err(|fault| in_file(fault.into()))?;
    let mut assembly = Assembly::new(options);
    let named = bytes::extension_format(name);
    if let Some(named) = named.filter(|named| named.extension() != format.extension()) {
        let text =
            format!("the extension says {}, but the content is {}", named.label(), format.label());
        assembly.notes.add(NoteCode::WrongExtension, text);
    }
    match format {
        Format::StlBinary => stl::read_binary(bytes, &mut assembly),
        Format::StlAscii => stl::read_ascii(bytes, &mut assembly),
        Format::Collada => collada::read(bytes, &mut assembly),
        Format::Obj => obj::read(bytes, fetch, &mut assembly),
        Format::Gltf => gltf::read_json(bytes, fetch, &mut assembly),
        Format::Glb => gltf::read_binary(bytes, fetch, &mut assembly),
    }
    .map_err(in_file)?;
    Ok(assembly.into_scene(format))
}
