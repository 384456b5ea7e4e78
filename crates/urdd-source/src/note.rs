//! Deviations of a source from URDF, and how they were interpreted.

use std::fmt;

use urdd_format::escape;

/// The kind of deviation that a note reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NoteKind {
    /// The file is not UTF-8.
    Encoding,
    /// XML that readers reject but that has only one possible meaning.
    Xml,
    /// A name in a different case.
    Case,
    /// Xacro macros that are not expanded.
    XacroLeftOver,
    /// The robot has no name.
    RobotName,
    /// An attribute without the expected numbers.
    Numbers,
    /// A number that is infinite or NaN.
    NotFinite,
    /// A shape without its size, or a mesh without its file name.
    Shape,
    /// A joint type in a nonstandard spelling.
    JointType,
    /// A mimic element that cannot be resolved.
    Mimic,
    /// A revolute or prismatic joint without limits.
    NoLimits,
    /// A repeated element that is ignored.
    Repeated,
    /// Two declarations of a material that differ.
    Material,
    /// A mesh file that was not found, or is not a mesh.
    MeshNotFound,
    /// A mesh that is stored but cannot be read.
    MeshNotUsable,
    /// A mesh that was repaired, or lacks a file that it references.
    Mesh,
    /// A stored file from outside the URDF's folder and package.
    Outside,
    /// A part of a module that is left out for this robot.
    LeftOut,
    /// A table that is left out because the robot is large, as the specification allows.
    TooLarge,
    /// A selected module that would be of no use.
    OfNoUse,
    /// Files of the user's in the folder of a module that is not made any more.
    LeftBehind,
}

impl NoteKind {
    /// Whether the assumption may change the robot from what the author meant.
    pub fn changes_robot(self) -> bool {
        use NoteKind::{Encoding, LeftBehind, OfNoUse, Outside, TooLarge, Xml};
        !matches!(self, Encoding | Xml | Outside | TooLarge | OfNoUse | LeftBehind)
    }

    /// The machine-readable name.
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
            NoteKind::LeftBehind => "left-behind",
        }
    }
}

/// A deviation in the source, and how it was interpreted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// The kind of deviation.
    pub kind: NoteKind,
    /// The file, as the user named it.
    pub file: String,
    /// Line in the file, from 1; 0 for the file as a whole.
    pub line: u32,
    /// Column in the line, from 1, in characters; 0 for the file as a whole.
    pub column: u32,
    /// What is wrong.
    pub problem: String,
    /// What was assumed or done.
    pub assumed: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // One line: a name must not add line breaks.
        f.write_str(&escape::line(&self.file))?;
        if self.line > 0 {
            write!(f, ":{}:{}", self.line, self.column)?;
        }
        let [problem, assumed] = [&self.problem, &self.assumed].map(|text| escape::line(text));
        write!(f, ": {problem}: {assumed}")
    }
}

/// A note from a reader, at a byte offset of the text.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Its kind.
    pub kind: NoteKind,
    /// Byte offset in the text.
    pub offset: usize,
    /// What is wrong.
    pub problem: String,
    /// What is read instead.
    pub assumed: String,
}
