//! What the readers are asked for, and what they return: scenes, notes and errors.

use std::fmt;
use std::sync::Arc;

use crate::mesh::Mesh;

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

impl Format {
    /// Its file extension, and its name.
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::StlBinary | Self::StlAscii => ("stl", "STL"),
            Self::Collada => ("dae", "COLLADA"),
            Self::Obj => ("obj", "OBJ"),
            Self::Gltf => ("gltf", "glTF"),
            Self::Glb => ("glb", "GLB"),
        }
    }

    /// The file extension of this format, without the dot.
    pub fn extension(self) -> &'static str {
        self.names().0
    }

    pub(super) fn label(self) -> &'static str {
        self.names().1
    }
}

/// How to treat the y-up axes of glTF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GltfUp {
    /// Rotate by +90 degrees about x: (x, y, z) becomes (x, -z, y).
    #[default]
    Turn,
    /// Keep the file's axes.
    Keep,
}

/// Reader options.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Treatment of the glTF axes.
    pub gltf_up: GltfUp,
    /// Maximum number of triangles; a file with more is an error.
    pub max_triangles: usize,
    /// Whether to leave the faces that are not convex uncut. Each is then a fan from its first corner, which may overlap
    /// itself, between two triangles of three equal indices. No other triangle has three equal indices.
    pub uncut: bool,
    /// Whether to read textures. Vertices then have one texture coordinate each: one where a texture is cut is several.
    pub textures: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { gltf_up: GltfUp::Turn, max_triangles: 20_000_000, uncut: false, textures: false }
    }
}

/// The content of a mesh file with all placements applied, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The detected format of the content.
    pub format: Format,
    /// One part per material, in the order of first use. Empty without triangles.
    pub parts: Vec<Part>,
    /// Files that the mesh references (.mtl, .bin, textures), relative to it, sorted, including missing ones.
    pub side_files: Vec<String>,
    /// Assumptions, repairs and omissions.
    pub notes: Vec<Note>,
}

/// Triangles of one material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// The triangles, in the axes of the URDF's mesh element.
    pub mesh: Mesh,
    /// Red, green, blue and opacity, each from 0 to 1; `None` if the file gives no colour or uses a texture.
    pub color: Option<[f64; 4]>,
    /// The material's name.
    pub material: Option<String>,
    /// Its texture; always `None` without [`Options::textures`].
    pub texture: Option<Texture>,
}

/// An image on a part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texture {
    /// The image's file, as the mesh names it; of an embedded image, what stands for its name.
    pub name: String,
    /// The content of an embedded image.
    pub embedded: Option<Arc<[u8]>>,
    /// Places in the image, one for each vertex of the mesh: (0, 0) is lower left, (1, 1) upper right, and the image
    /// repeats. Empty if the mesh has none.
    pub uv: Vec<[f64; 2]>,
}

impl Scene {
    /// All parts merged into one mesh, in order.
    pub fn merged(&self) -> Mesh {
        let mut mesh = Mesh::default();
        for part in &self.parts {
            mesh.append(&part.mesh);
        }
        mesh
    }

    /// Number of triangles in all parts.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|part| part.mesh.triangles.len()).sum()
    }
}

/// Why a mesh file could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {}{fault}", place.as_ref().map(|place| format!("{place}: ")).unwrap_or_default())]
pub struct MeshError {
    /// The file name that the caller gave.
    pub file: String,
    /// Location in the file, if a single one is at fault.
    pub place: Option<Place>,
    /// What is wrong.
    pub fault: Fault,
}

/// A location in a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// Line of a text file, from 1.
    Line(usize),
    /// Byte offset in a binary file, from 0.
    Byte(usize),
    /// A named element, such as `geometry 'body'` or `accessor 3`.
    Element(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Element(element) => f.write_str(element),
        }
    }
}

/// What is wrong with a mesh file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The file is empty.
    #[error("the file is empty; export the mesh again")]
    Empty,
    /// Neither content nor extension identifies a format.
    #[error("not a mesh in STL, COLLADA, OBJ, glTF or GLB; convert it to one of these")]
    UnknownFormat,
    /// An unsupported format, or an unsupported feature of a format.
    #[error("{0}; convert the mesh to binary STL, or to GLB without compression")]
    NotSupported(String),
    /// The file ends before its content does.
    #[error("the file is cut off: {0}; copy or export it again")]
    Truncated(String),
    /// The content violates its format.
    #[error("{0}; repair the file or export it again")]
    Malformed(String),
    /// A resource limit is exceeded.
    #[error("more than {limit} {what}; simplify the mesh")]
    TooLarge {
        /// The limited items.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// A file with geometry was not found.
    #[error(
        "the file '{0}', which contains the geometry, was not found; put it at the path that the mesh names"
    )]
    NoSideFile(String),
}

impl Fault {
    pub(super) fn malformed(what: impl Into<String>) -> Failure {
        Self::Malformed(what.into()).into()
    }

    pub(super) fn not_supported(what: impl Into<String>) -> Failure {
        Self::NotSupported(what.into()).into()
    }
}

/// An error whose file has no name yet.
pub(super) type Failure = MeshError;

impl MeshError {
    /// Sets the location, unless one is set.
    pub(super) fn at(mut self, place: impl FnOnce() -> Place) -> Self {
        self.place.get_or_insert_with(place);
        self
    }

    /// Sets the named element as the location, unless one is set.
    pub(super) fn within(self, kind: &str, name: impl fmt::Display) -> Self {
        self.at(|| Place::Element(format!("{kind} '{name}'")))
    }

    pub(super) fn in_file(self, file: &str) -> Self {
        Self { file: file.to_owned(), ..self }
    }
}

impl From<Fault> for MeshError {
    fn from(fault: Fault) -> Self {
        Self { file: String::new(), place: None, fault }
    }
}

/// An assumption, omission or repair in one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Kind of note.
    pub code: NoteCode,
    /// One human-readable sentence.
    pub text: String,
    /// Number of occurrences.
    pub count: usize,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)?;
        if self.count > 1 {
            write!(f, " ({} times)", self.count)?;
        }
        Ok(())
    }
}

/// The kind of a [`Note`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum NoteCode {
    /// Content and extension disagree; the content decides.
    WrongExtension,
    /// The triangle count in the file differs from its data.
    WrongCount,
    /// The file is truncated; all complete triangles were read.
    CutOff,
    /// Triangles with a non-finite corner were dropped.
    NotFinite,
    /// Triangles or faces that reference a missing vertex were dropped.
    IndexOutOfRange,
    /// A file that only affects appearance was not found.
    SideFileMissing,
    /// The `up_axis` of a COLLADA file was not applied, as in RViz, Pinocchio and trimesh.
    UpAxisIgnored,
    /// The lengths were scaled to metres.
    UnitApplied,
    /// The y-up axes of glTF were converted to z-up.
    TurnedToZUp,
    /// A skinned mesh was read in its bind shape.
    SkinAsShape,
    /// Content without triangles, or content that cannot be read, was skipped.
    LeftOut,
    /// What other readers refuse was read: whether such a file is a mesh, SPEC 7.5 leaves to the URDD.
    ReadOtherwise,
    /// A value was missing or not understood; a default replaces it.
    Assumed,
    /// The file has no triangles.
    NoTriangles,
    /// Vertices that no triangle uses were dropped.
    UnusedVertices,
    /// The accessor bounds of a glTF differ from its positions.
    WrongBounds,
    /// Normals of a glTF have a wrong length or number, or cannot be read.
    WrongNormals,
    /// A glTF node has a transform.
    NodeTransform,
    /// A glTF shows more than its triangles: morph targets, animations, instances.
    ShownOtherwise,
}

/// Notes in order of first occurrence; equal notes are counted.
#[derive(Debug, Default)]
pub(super) struct Notes(pub(super) Vec<Note>);

/// Maximum number of distinct notes per file. A file can reference a million missing things.
const MAX_NOTES: usize = 50;

impl Notes {
    pub(super) fn add(&mut self, code: NoteCode, text: impl Into<String>) {
        self.add_many(code, text, 1);
    }

    pub(super) fn add_many(&mut self, code: NoteCode, text: impl Into<String>, count: usize) {
        if count == 0 {
            return;
        }
        let text = text.into();
        if let Some(note) = self.0.iter_mut().find(|note| note.code == code && note.text == text) {
            note.count += count;
        } else if self.0.len() < MAX_NOTES {
            self.0.push(Note { code, text, count });
        }
    }
}
