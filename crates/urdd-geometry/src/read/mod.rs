//! Reads the mesh formats that URDFs name.
//!
//! # What each reader handles
//!
//! | | STL | COLLADA (.dae) | OBJ | glTF, GLB |
//! |---|---|---|---|---|
//! | versions | binary, ASCII (any case, several solids) | 1.4, 1.5 | as written by the tools of the field | 2.0 |
//! | faces | triangles | triangles, polylist, polygons, trifans, tristrips | triangles, n-gons, negative indices, continued lines | triangles, strips, fans, with and without indices (8, 16, 32 bits) |
//! | placement | none | matrix, translate, rotate, scale, skew, lookat in order; nested nodes, `instance_node`, a geometry used often | none | matrix or translation, rotation, scale; nested nodes; the default scene |
//! | lengths | as they are | times `unit` | as they are | metres |
//! | up axis | none | `up_axis` is *not* applied | none | y-up is turned to z-up (see [`GltfUp`]) |
//! | colours | none | diffuse colour (of `constant`: emission) | `Kd` and `d` of the .mtl | `baseColorFactor`, `diffuseFactor` |
//! | left out | the attribute bytes (colours of some tools) | lines, splines, textures, animation, skins (the bind shape is read), holes of polygons | lines, points, curves, textures, vertex colours | points, lines, textures, animation, morph targets, skins (read as they stand) |
//! | refused | no whole triangle | no UTF-8 or UTF-16, a DTD | an index 0 or a face that is no face is dropped with a note | version 1, Draco, meshopt |
//! | repaired, with a note | wrong count, cut off, NaN corners, a header that begins with `solid` | NaN, indices out of range, missing scene | NaN, indices out of range, missing .mtl | NaN, indices out of range, wrong lengths in the GLB header |
//!
//! A part with a texture has no colour: the true one is in the image. Colours are taken as they stand in the file;
//! nothing is converted between sRGB and linear values.
//!
//! # Axes and lengths
//!
//! URDF says nothing of the axes and units inside mesh files, so we do what its readers do.
//!
//! COLLADA's `unit` is applied, as the format demands and as RViz, MoveIt, Gazebo and three.js do (Assimp 6 through
//! Pinocchio's coal, `PyBullet` and trimesh leave it out: with those a file in inches is 39 times too large). Its
//! `up_axis` is ignored, as RViz, MoveIt, coal, `PyBullet`, trimesh and Habitat do: exporters write it at random
//! (95 of 331 files of known robots do not say `Z_UP`), and robots are drawn right only without it.
//!
//! glTF fixes y as up. RViz 2 (since June 2025), Drake, Genesis and Blender turn it to z-up, older RViz, coal and
//! trimesh do not. We turn it and say so in a note; [`Options`] can keep the axes, which is right for the .glb files
//! of a URDD itself.
//!
//! # Why own readers
//!
//! Tried in 2026 on 2,100 meshes of robots and on broken ones: `stl_io` 0.11 takes a binary file that begins with
//! `solid` for text, and fails on one that is cut off. `mesh-loader` 0.1.13 refuses three of 574 real STL files and every
//! one that is cut off, does not look at the count, places each COLLADA geometry once, and computes in binary32.
//! `dae-parser` 0.11 refuses 85 of 331 real files. `tobj` 4.0 panics on `Kd 1 1`, and refuses `vt` of one number,
//! continued lines and a missing .mtl. `gltf` 1.4 refuses accessors without bounds, panics on accessors
//! without elements, with a huge count or of another component type, and reads nothing from those without a view.
//! The readers here build on `roxmltree`, `serde_json`, `base64` and `earcut`.
//!
//! # Bounds
//!
//! Memory is in proportion to the input; where a file can name more than it holds (instances of instances, empty
//! accessors) it is counted and limited. No input makes a reader panic.

mod assembly;
mod collada;
mod error;
mod gltf;
mod mtl;
mod number;
mod obj;
mod sniff;
mod stl;

pub use error::{Fault, MeshError, Note, NoteCode, Place};

use super::mesh::Mesh;
use assembly::Assembly;
use error::Failure;

/// What a mesh file holds, placed, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The format that the content has.
    pub format: Format,
    /// Triangles by material, in the order in which the materials first appear. Empty if there are no triangles.
    pub parts: Vec<Part>,
    /// Files that the mesh names (.mtl, .bin, textures), relative to it, sorted, also where they were not found.
    pub side_files: Vec<String>,
    /// What was assumed, repaired or left out.
    pub notes: Vec<Note>,
}

/// Triangles of one material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// The triangles, in the axes of the URDF's mesh element.
    pub mesh: Mesh,
    /// Red, green, blue and opacity, each from 0 to 1; `None` if the file gives none, or a texture.
    pub color: Option<[f64; 4]>,
    /// The material's name.
    pub material: Option<String>,
}

/// A mesh format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Binary STL.
    StlBinary,
    /// STL as text.
    StlAscii,
    /// COLLADA (.dae).
    Collada,
    /// Wavefront OBJ.
    Obj,
    /// glTF as JSON.
    Gltf,
    /// Binary glTF.
    Glb,
}

/// What to do with the axes of glTF, which has y up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GltfUp {
    /// Turn by +90 degrees about x: (x, y, z) becomes (x, -z, y).
    #[default]
    Turn,
    /// Keep the file's axes.
    Keep,
}

/// How to read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The axes of glTF.
    pub gltf_up: GltfUp,
    /// More triangles than this are an error.
    pub max_triangles: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            gltf_up: GltfUp::Turn,
            max_triangles: 20_000_000,
        }
    }
}

impl Scene {
    /// All parts as one mesh, in order.
    #[must_use]
    pub fn merged(&self) -> Mesh {
        let mut mesh = Mesh::default();
        for part in &self.parts {
            mesh.append(&part.mesh);
        }
        mesh
    }

    /// How many triangles there are in all parts.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.parts
            .iter()
            .map(|part| part.mesh.triangles.len())
            .sum()
    }
}

/// Reads a mesh file as a URDF's mesh element means it.
///
/// `name` is the file's name: its extension decides where the content does not, and errors carry it. `fetch` gives
/// the bytes of a side file by the name that the mesh has for it; the reader opens no files itself.
///
/// # Errors
/// [`MeshError`] where the content cannot be understood; what can be repaired is a note in the scene instead.
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
    read_format(bytes, name, fetch, options).map_err(|failure| failure.in_file(name))
}

fn read_format(
    bytes: &[u8],
    name: &str,
    fetch: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
    options: &Options,
) -> Result<Scene, Failure> {
    let format = sniff::format(bytes, name)?;
    let mut assembly = Assembly::new(options.max_triangles);
    let named = sniff::extension_format(name);
    if let Some(named) = named.filter(|named| named.extension() != format.extension()) {
        let text = format!(
            "the extension says {}, the content is {}",
            named.label(),
            format.label()
        );
        assembly.notes.add(NoteCode::WrongExtension, text);
    }
    match format {
        Format::StlBinary => stl::read_binary(bytes, &mut assembly)?,
        Format::StlAscii => stl::read_ascii(bytes, &mut assembly)?,
        Format::Collada => collada::read(bytes, &mut assembly)?,
        Format::Obj => obj::read(bytes, fetch, &mut assembly)?,
        Format::Gltf => gltf::read_json(bytes, fetch, options.gltf_up, &mut assembly)?,
        Format::Glb => gltf::read_binary(bytes, fetch, options.gltf_up, &mut assembly)?,
    }
    Ok(assembly.into_scene(format))
}

impl Format {
    fn label(self) -> &'static str {
        match self {
            Self::StlBinary | Self::StlAscii => "STL",
            Self::Collada => "COLLADA",
            Self::Obj => "OBJ",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
        }
    }

    /// The extension that files of this format have, without the point.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::StlBinary | Self::StlAscii => "stl",
            Self::Collada => "dae",
            Self::Obj => "obj",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
        }
    }
}
