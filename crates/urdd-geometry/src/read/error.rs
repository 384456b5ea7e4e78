//! Why a mesh file could not be read, and what was assumed where it could.

use std::fmt;

/// Why a mesh file could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {}{fault}", place.as_ref().map(|place| format!("{place}: ")).unwrap_or_default())]
pub struct MeshError {
    /// The name that the caller gave.
    pub file: String,
    /// Where in the file, if one place is at fault.
    pub place: Option<Place>,
    /// What is wrong.
    pub fault: Fault,
}

/// A place in a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of a text file, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
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
    /// No bytes.
    #[error("the file is empty; export the mesh again")]
    Empty,
    /// Neither the content nor the extension says what it is.
    #[error("not a mesh in STL, COLLADA, OBJ, glTF or GLB; convert it to one of these")]
    UnknownFormat,
    /// A format, or a part of one, that this reader does not read.
    #[error("{0}; convert the mesh to binary STL, or to GLB without compression")]
    NotSupported(String),
    /// The file ends before its content does.
    #[error("the file is cut off: {0}; copy or export it again")]
    Truncated(String),
    /// The content breaks the rules of its format.
    #[error("{0}; repair the file or export it again")]
    Malformed(String),
    /// More than the reader is willing to hold.
    #[error("more than {limit} {what}; simplify the mesh")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How many are allowed.
        limit: usize,
    },
    /// A file that holds geometry and was not found.
    #[error(
        "the file '{0}', which holds the geometry, was not found; put it where the mesh names it"
    )]
    NoSideFile(String),
}

impl Fault {
    pub(super) fn malformed(what: impl Into<String>) -> Failure {
        Failure {
            place: None,
            fault: Self::Malformed(what.into()),
        }
    }
}

/// An error before the file's name is known.
#[derive(Debug)]
pub(super) struct Failure {
    pub(super) place: Option<Place>,
    pub(super) fault: Fault,
}

impl Failure {
    /// The same failure at a place, if it has none yet.
    pub(super) fn at(mut self, place: impl FnOnce() -> Place) -> Self {
        self.place.get_or_insert_with(place);
        self
    }

    /// The same failure inside a named element.
    pub(super) fn within(self, kind: &str, name: impl fmt::Display) -> Self {
        self.at(|| Place::Element(format!("{kind} '{name}'")))
    }

    pub(super) fn in_file(self, file: &str) -> MeshError {
        MeshError {
            file: file.to_owned(),
            place: self.place,
            fault: self.fault,
        }
    }
}

impl From<Fault> for Failure {
    fn from(fault: Fault) -> Self {
        Self { place: None, fault }
    }
}

/// Something that was assumed, left out or repaired. What it says is about one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Of what sort.
    pub code: NoteCode,
    /// One sentence for people.
    pub text: String,
    /// How often.
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

/// The sort of a [`Note`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum NoteCode {
    /// The content is of another format than the extension says; the content was believed.
    WrongExtension,
    /// The file's own count of triangles is not that of its data.
    WrongCount,
    /// The file is cut off; what is whole was read.
    CutOff,
    /// Triangles with a corner that is no finite number were dropped.
    NotFinite,
    /// Triangles or faces that name a vertex that is not there were dropped.
    IndexOutOfRange,
    /// A file for appearance only was not found.
    SideFileMissing,
    /// The `up_axis` of a COLLADA file was not applied (nor do RViz, Pinocchio or trimesh).
    UpAxisIgnored,
    /// The lengths were scaled to metres.
    UnitApplied,
    /// The y-up axes of glTF were turned to z-up.
    TurnedToZUp,
    /// A skinned mesh was read in its bind shape.
    SkinAsShape,
    /// A part that carries no triangles for us, or that cannot be read, was left out.
    LeftOut,
    /// A value was not understood, and its default taken.
    Assumed,
    /// There is no triangle.
    NoTriangles,
    /// Vertices that no triangle uses were left out.
    UnusedVertices,
    /// The least and greatest coordinates that a glTF gives are not those of its positions.
    WrongBounds,
    /// Normals of a glTF are not of unit length.
    WrongNormals,
    /// A node of a glTF places its mesh by a transform.
    NodeTransform,
    /// A glTF shows something else than its triangles: morph targets, animations, instances.
    ShownOtherwise,
}

/// Notes in the order in which they came up; equal ones are counted.
#[derive(Debug, Default)]
pub(super) struct Notes(pub(super) Vec<Note>);

/// So many different notes are kept of one file; it may name a million missing things.
const MOST_NOTES: usize = 50;

impl Notes {
    pub(super) fn add(&mut self, code: NoteCode, text: impl Into<String>) {
        self.add_many(code, text, 1);
    }

    pub(super) fn add_many(&mut self, code: NoteCode, text: impl Into<String>, count: usize) {
        if count == 0 {
            return;
        }
        let text = text.into();
        if let Some(note) = self
            .0
            .iter_mut()
            .find(|note| note.code == code && note.text == text)
        {
            note.count += count;
        } else if self.0.len() < MOST_NOTES {
            self.0.push(Note { code, text, count });
        }
    }
}
