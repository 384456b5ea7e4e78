//! Why robots cannot be combined, and notes about those that are.

use std::fmt;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::GenerateError;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::position::Position;
use urdd_format::escape;
use urdd_format::nearest::nearest;

pub(super) type Result<T, E = CombineError> = std::result::Result<T, E>;

/// Why robots cannot be combined. Nothing was written, and an existing URDD is unchanged.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CombineError {
    /// The recipe's file cannot be read.
    #[error("{}: cannot be read: {reason}", escape::line(file))]
    Unreadable {
        /// The file, as the user named it.
        file: String,
        /// Why.
        reason: String,
    },
    /// A temporary file or folder cannot be written.
    #[error("{}: cannot be written: {reason}; nothing was changed", escape::line(&path.display().to_string()))]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The recipe is invalid.
    #[error("{}{}: {fault}", escape::line(file), at.map(|at| format!(":{at}")).unwrap_or_default())]
    Recipe {
        /// The file of the recipe.
        file: String,
        /// The position in it; `None` for a recipe from the command line, or for the recipe as a whole.
        at: Option<Position>,
        /// What is wrong, and what to do; on one line.
        fault: String,
    },
    /// A part cannot be used.
    #[error("{}{}: {fault}", about(Some(id)), escape::line(source_path))]
    Part {
        /// The part; empty for a legacy URDD that becomes a recipe.
        id: String,
        /// Its source as written in the recipe.
        source_path: String,
        /// What is wrong.
        fault: PartFault,
    },
    /// The URDD of a part, or of the combined robot, cannot be generated.
    #[error("{}{error}", about(id.as_ref()))]
    Generate {
        /// The part; `None` for the combined robot.
        id: Option<String>,
        /// Why.
        error: GenerateError,
    },
}

impl From<Cancelled> for CombineError {
    fn from(cancelled: Cancelled) -> Self {
        CombineError::Generate { id: None, error: cancelled.into() }
    }
}

fn about(id: Option<&String>) -> String {
    let id = id.filter(|id| !id.is_empty());
    id.map_or_else(String::new, |id| format!("part `{}`: ", escape::line(id)))
}

pub(super) fn did_you_mean<'a>(known: impl Iterator<Item = &'a str>, name: &str) -> String {
    nearest(known, name).map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

impl CombineError {
    pub(super) fn unwritable(path: &Path, error: std::io::Error) -> Self {
        CombineError::Unwritable { path: path.to_owned(), reason: error.to_string() }
    }

    /// A machine-readable code for the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            CombineError::Unreadable { .. } => "unreadable",
            CombineError::Unwritable { .. } => "unwritable",
            CombineError::Recipe { .. } => "recipe",
            CombineError::Part { fault: PartFault::Fails { .. }, .. } => "part-fails",
            CombineError::Part { .. } => "part",
            CombineError::Generate { error, .. } => error.code(),
        }
    }
}

/// Why a part cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PartFault {
    /// The part has validation errors.
    #[error(
        "it does not pass `urdd validate`: {}; correct it, or use it anyway: --force", codes.join(", ")
    )]
    Fails {
        /// The codes of the rules that found errors, with the number of findings.
        codes: Vec<String>,
    },
    /// It is missing, unreadable, not a robot, or may not be used: what is wrong, and what to do.
    #[error("{0}")]
    Unusable(String),
}

impl PartFault {
    pub(super) fn unusable(why: impl Into<String>) -> Self {
        PartFault::Unusable(why.into())
    }

    /// A file of the part cannot be read, named relative to its root.
    pub(super) fn unreadable(file: &str, reason: impl ToString) -> Self {
        PartFault::unusable(format!("{}: {}", escape::line(file), reason.to_string()))
    }

    pub(super) fn no_urdf() -> Self {
        PartFault::unusable(
            "this URDD carries no URDF, but parts are combined as URDFs; give the URDF itself as the source",
        )
    }
}

/// A note about combined robots. Its text says what was found in a part, and what was done about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// A machine-readable name of its kind, such as `left-alone`.
    pub kind: &'static str,
    /// The part; `None` for the robot as a whole.
    pub part: Option<String>,
    /// The text. Names in it are not escaped.
    pub text: String,
}

impl Note {
    pub(super) fn of_part(kind: &'static str, part: &str, text: String) -> Self {
        Note { kind, part: Some(part.to_owned()), text }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(part) = &self.part {
            write!(f, "part `{}`: ", escape::line(part))?;
        }
        f.write_str(&escape::line(&self.text))
    }
}
