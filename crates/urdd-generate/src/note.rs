//! What a source has that is not as URDF should be, and what was made of it.

use std::fmt;

use urdd_format::escape;

/// What kind of oddity a note is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NoteKind {
    /// The file is not UTF-8.
    Encoding,
    /// XML that readers refuse, with one possible meaning.
    Xml,
    /// A name that is written in another case.
    Case,
    /// Macros that nothing has expanded.
    XacroLeftOver,
    /// The robot has no name.
    RobotName,
    /// An attribute that is not the numbers it should be.
    Numbers,
    /// A number that is infinite, or none.
    NotFinite,
    /// A shape that lacks its size, or a mesh its file name.
    Shape,
    /// The type of a joint, written as URDF does not write it.
    JointType,
    /// A mimic that follows nothing it could follow.
    Mimic,
    /// A revolute or prismatic joint without limits.
    NoLimits,
    /// An element that is there again, and does not count.
    Repeated,
    /// A material that is declared twice, in two ways.
    Material,
    /// A mesh that was not found, or a file that is no mesh.
    MeshNotFound,
    /// A mesh that is carried and cannot be read.
    MeshNotUsable,
    /// A mesh that was repaired, or lacks a file that it names.
    Mesh,
    /// A file that is carried, and lies outside of the URDF's folder and package.
    Outside,
    /// A part of a module that is not made of this robot.
    LeftOut,
    /// A table that is left out, as the specification allows for a robot of this size.
    TooLarge,
    /// A module that was asked for and would be of no use.
    OfNoUse,
}

impl NoteKind {
    /// Every kind.
    pub const ALL: &[NoteKind] = &[
        NoteKind::Encoding,
        NoteKind::Xml,
        NoteKind::Case,
        NoteKind::XacroLeftOver,
        NoteKind::RobotName,
        NoteKind::Numbers,
        NoteKind::NotFinite,
        NoteKind::Shape,
        NoteKind::JointType,
        NoteKind::Mimic,
        NoteKind::NoLimits,
        NoteKind::Repeated,
        NoteKind::Material,
        NoteKind::MeshNotFound,
        NoteKind::MeshNotUsable,
        NoteKind::Mesh,
        NoteKind::Outside,
        NoteKind::LeftOut,
        NoteKind::TooLarge,
        NoteKind::OfNoUse,
    ];

    /// Whether what was assumed may make another robot of it than the author meant.
    pub fn changes_robot(self) -> bool {
        use NoteKind::{Encoding, OfNoUse, Outside, TooLarge, Xml};
        !matches!(self, Encoding | Xml | Outside | TooLarge | OfNoUse)
    }

    /// Its word, for programs.
    pub fn as_str(self) -> &'static str {
        match self {
            NoteKind::Encoding => "encoding",
            NoteKind::Xml => "xml",
            NoteKind::Case => "case",
            NoteKind::XacroLeftOver => "xacro-left-over",
            NoteKind::RobotName => "robot-name",
            NoteKind::Numbers => "numbers",
            NoteKind::NotFinite => "not-finite",
            NoteKind::Shape => "shape",
            NoteKind::JointType => "joint-type",
            NoteKind::Mimic => "mimic",
            NoteKind::NoLimits => "no-limits",
            NoteKind::Repeated => "repeated",
            NoteKind::Material => "material",
            NoteKind::MeshNotFound => "mesh-not-found",
            NoteKind::MeshNotUsable => "mesh-not-usable",
            NoteKind::Mesh => "mesh",
            NoteKind::Outside => "outside",
            NoteKind::LeftOut => "left-out",
            NoteKind::TooLarge => "too-large",
            NoteKind::OfNoUse => "of-no-use",
        }
    }
}

/// An oddity of the source, and what was made of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// What kind of oddity it is.
    pub kind: NoteKind,
    /// The file, as the user named it.
    pub file: String,
    /// Line in the file, from 1; 0 where it is about the file as a whole.
    pub line: u32,
    /// Column in the line, from 1, in characters; 0 where it is about the file as a whole.
    pub column: u32,
    /// What is wrong.
    pub problem: String,
    /// What was assumed, or done.
    pub assumed: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // One line: no name may add another.
        f.write_str(&escape::line(&self.file))?;
        if self.line > 0 {
            write!(f, ":{}:{}", self.line, self.column)?;
        }
        let [problem, assumed] = [&self.problem, &self.assumed].map(|text| escape::line(text));
        write!(f, ": {problem}: {assumed}")
    }
}

/// A note as the readers make it: at a byte offset of the text that they read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Remark {
    pub kind: NoteKind,
    /// Byte offset in the text.
    pub offset: usize,
    pub problem: String,
    pub assumed: String,
}
