//! Deviations of a source from URDF, and how they were interpreted.

use std::fmt;

use urdd_format::escape;

macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $word:literal,)*) => {
        /// The kind of deviation that a note reports.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum NoteKind { $($(#[$doc])* $kind,)* }

        impl NoteKind {
            /// The machine-readable name.
            pub fn as_str(self) -> &'static str {
                match self { $(NoteKind::$kind => $word,)* }
            }
        }
    };
}

kinds! {
    /// The file is not UTF-8.
    Encoding = "encoding",
    /// XML that readers reject but that has only one possible meaning.
    Xml = "xml",
    /// A name in a different case.
    Case = "case",
    /// Xacro macros that are not expanded.
    XacroLeftOver = "xacro-left-over",
    /// The robot has no name.
    RobotName = "robot-name",
    /// An attribute without the expected numbers.
    Numbers = "numbers",
    /// A number that is infinite or NaN.
    NotFinite = "not-finite",
    /// A shape without its size, or a mesh without its file name.
    Shape = "shape",
    /// A joint type in a nonstandard spelling.
    JointType = "joint-type",
    /// A mimic element that cannot be resolved.
    Mimic = "mimic",
    /// A revolute or prismatic joint without limits.
    NoLimits = "no-limits",
    /// A repeated element that is ignored.
    Repeated = "repeated",
    /// Two declarations of a material that differ.
    Material = "material",
    /// A mesh file that was not found, or is not a mesh.
    MeshNotFound = "mesh-not-found",
    /// A mesh that is stored but cannot be read.
    MeshNotUsable = "mesh-not-usable",
    /// A mesh that was repaired, or lacks a file that it references.
    Mesh = "mesh",
    /// A stored file from outside the URDF's folder and package.
    Outside = "outside",
    /// A part of a module that is left out for this robot.
    LeftOut = "left-out",
    /// A table that is left out because the robot is large, as the specification allows.
    TooLarge = "too-large",
    /// A selected module that would be of no use.
    OfNoUse = "of-no-use",
    /// What a URDF cannot say of a description that is imported.
    Lost = "lost",
    /// What a URDF has in another way than the description that is imported.
    Otherwise = "otherwise",
    /// Which elements the shapes of links are made of.
    GeometryTaken = "geometry-taken",
    /// Links that are skipped because they touch in one configuration, and touch in others too.
    SkippedContact = "skipped-contact",
    /// Files of the user's in the folder of a module that is not made any more.
    LeftBehind = "left-behind",
}

impl NoteKind {
    /// Whether the assumption may change the robot from what the author meant.
    pub fn changes_robot(self) -> bool {
        use NoteKind::*;
        !matches!(
            self,
            Encoding
                | Xml
                | Outside
                | TooLarge
                | OfNoUse
                | LeftBehind
                | Otherwise
                | GeometryTaken
                | SkippedContact
        )
    }
}

/// A place in a file of the user's.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourcePlace {
    /// The file, as the user named it; as seen from there for one that it includes.
    pub file: String,
    /// Line in the file, from 1; 0 for the file as a whole.
    pub line: u32,
    /// Column in the line, from 1, in characters; 0 for the file as a whole.
    pub column: u32,
}

/// A call of a macro.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MacroCall {
    /// Where it is.
    pub place: SourcePlace,
    /// The macro's name.
    pub name: String,
}

impl fmt::Display for SourcePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // One line: a name must not add line breaks.
        f.write_str(&escape::line(&self.file))?;
        if self.line > 0 { write!(f, ":{}:{}", self.line, self.column) } else { Ok(()) }
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
    /// What was assumed or done; empty where the problem says it.
    pub assumed: String,
}

impl Note {
    /// A note about a place.
    pub fn at(
        place: SourcePlace,
        kind: NoteKind,
        problem: impl Into<String>,
        assumed: impl Into<String>,
    ) -> Self {
        let SourcePlace { file, line, column } = place;
        Note { kind, file, line, column, problem: problem.into(), assumed: assumed.into() }
    }

    /// A note about a file as a whole.
    pub fn of_file(
        file: &str,
        kind: NoteKind,
        problem: impl Into<String>,
        assumed: impl Into<String>,
    ) -> Self {
        Note::at(SourcePlace { file: file.to_owned(), line: 0, column: 0 }, kind, problem, assumed)
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // One line: a name must not add line breaks.
        f.write_str(&escape::line(&self.file))?;
        if self.line > 0 {
            write!(f, ":{}:{}", self.line, self.column)?;
        }
        let [problem, assumed] = [&self.problem, &self.assumed].map(|text| escape::line(text));
        write!(f, ": {problem}")?;
        if assumed.is_empty() { Ok(()) } else { write!(f, ": {assumed}") }
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
