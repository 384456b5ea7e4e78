//! Why robots cannot be combined.

use std::fmt;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::recipe_fault::{Place, RecipeFault};
use crate::GenerateError;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::position::Position;
use urdd_format::escape;

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
    #[error("{}{}: {fault}", escape::line(file), Place(*at))]
    Recipe {
        /// The file of the recipe.
        file: String,
        /// The position in it; `None` for a recipe from the command line, or for the recipe as a whole.
        at: Option<Position>,
        /// What is wrong.
        fault: Box<RecipeFault>,
    },
    /// A part cannot be used.
    #[error("{}{}: {fault}", About(&(!id.is_empty()).then(|| id.clone())), escape::line(source_path))]
    Part {
        /// The part.
        id: String,
        /// Its source as written in the recipe.
        source_path: String,
        /// What is wrong.
        fault: PartFault,
    },
    /// The URDD of a part, or of the combined robot, cannot be generated.
    #[error("{}{error}", About(id))]
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

struct About<'a>(&'a Option<String>);

impl fmt::Display for About<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(id) => write!(f, "part `{}`: ", escape::line(id)),
            None => Ok(()),
        }
    }
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
    /// The source does not exist, or is not a possible part.
    #[error(
        "there is no such URDD or URDF: {0}; a source is a folder or zip archive of a URDD, or a URDF or xacro file, relative to the recipe"
    )]
    Missing(String),
    /// The source is outside the folders from which a recipe may use parts.
    #[error(
        "this is {}, outside of {}, the folder of the recipe; to use parts from there, add --allow-folder {}",
        escape::line(found),
        escape::line(folder),
        escape::shell(allow)
    )]
    Outside {
        /// The file or folder, with symbolic links resolved.
        found: String,
        /// The folder from which parts may be used.
        folder: String,
        /// The folder to allow.
        allow: String,
    },
    /// A legacy module references a part that is not in a sibling folder.
    #[error(
        "a legacy module names a part by a folder beside its own, but this is not the name of a folder: correct it, or write a recipe"
    )]
    NotBeside,
    /// A xacro file that is named by the recipe, not by the user.
    #[error(
        "the recipe names a xacro file, which runs as a program; if you trust it, allow it with --xacro"
    )]
    Xacro,
    /// A file of the URDD cannot be read.
    #[error("{}: {reason}", escape::line(file))]
    Unreadable {
        /// The file, relative to the URDD's root.
        file: String,
        /// Why.
        reason: String,
    },
    /// The URDD contains no URDF.
    #[error(
        "this URDD carries no URDF, but parts are combined as URDFs; give the URDF itself as the source"
    )]
    NoUrdf,
    /// It is not a combined URDD from before version 1.
    #[error(
        "this URDD has no combined_robot_module, adjusted_robot_module or creator_module, which describe how it was combined"
    )]
    NotComposed,
    /// Nothing in its composition can be expressed as a recipe.
    #[error("a recipe cannot express how it was combined: {}", .0.join("; "))]
    SaysNothing(Vec<String>),
    /// The part has validation errors.
    #[error(
        "it does not pass `urdd validate`: {}; correct it, or use it anyway: --force", codes.join(", ")
    )]
    Fails {
        /// The codes of the rules that found errors, with the number of findings.
        codes: Vec<String>,
    },
}

impl PartFault {
    pub(super) fn unreadable(file: &str, reason: impl ToString) -> Self {
        PartFault::Unreadable { file: file.to_owned(), reason: reason.to_string() }
    }
}
