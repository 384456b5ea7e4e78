//! Why robots cannot be put together.

use std::fmt;
use std::path::PathBuf;

use thiserror::Error;

use super::recipe_fault::{Place, RecipeFault};
use crate::GenerateError;
use urdd_directory::position::Position;
use urdd_format::escape;

/// Why robots cannot be put together. Nothing was written then, and what was there before still is.
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
    /// The recipe cannot be followed.
    #[error("{}{}: {fault}", escape::line(file), Place(*at))]
    Recipe {
        /// The file of the recipe.
        file: String,
        /// The place in it; `None` where the recipe came from the command line, or it is about the whole.
        at: Option<Position>,
        /// What is wrong.
        fault: Box<RecipeFault>,
    },
    /// A part cannot be taken up.
    #[error("{}{}: {fault}", About(&(!id.is_empty()).then(|| id.clone())), escape::line(source_path))]
    Part {
        /// The part.
        id: String,
        /// Its source, as the recipe names it.
        source_path: String,
        /// What is wrong.
        fault: PartFault,
    },
    /// The URDD of a part, or that of all, cannot be made.
    #[error("{}{error}", About(id))]
    Generate {
        /// The part; `None` for what was put together.
        id: Option<String>,
        /// Why.
        error: GenerateError,
    },
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
    /// A word for programs: what kind of error it is.
    pub fn code(&self) -> &'static str {
        match self {
            CombineError::Unreadable { .. } => "unreadable",
            CombineError::Unwritable { .. } => "unwritable",
            CombineError::Recipe { .. } => "recipe",
            CombineError::Part {
                fault: PartFault::Fails { .. },
                ..
            } => "part-fails",
            CombineError::Part { .. } => "part",
            CombineError::Generate { error, .. } => error.code(),
        }
    }
}

/// Why a part cannot be taken up.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PartFault {
    /// Nothing there that could be a part.
    #[error(
        "there is no such URDD or URDF: {0}; a source is a folder or zip archive of a URDD, or a URDF or xacro file, relative to the recipe"
    )]
    Missing(String),
    /// It is outside of the folders from which a recipe may take parts.
    #[error(
        "this is {}, outside of {}, the folder of the recipe; to take parts from there too: --allow-folder {}",
        escape::line(found),
        escape::line(folder),
        escape::line(allow)
    )]
    Outside {
        /// The file or folder, links resolved.
        found: String,
        /// The folder that parts are taken from.
        folder: String,
        /// The folder that would have to be allowed.
        allow: String,
    },
    /// A legacy module names a part that is not beside it.
    #[error(
        "a legacy module names the folder of a part beside its own, and this is not the name of one: correct it, or write a recipe"
    )]
    NotBeside,
    /// A xacro file that the user did not name.
    #[error(
        "this is a xacro file, which runs as a program, and the recipe names it; where you trust it, allow that: --xacro"
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
    /// It carries no URDF.
    #[error(
        "this URDD carries no URDF, and parts are put together as URDFs; give the URDF itself as the source"
    )]
    NoUrdf,
    /// It is no URDD of before version 1 that was put together.
    #[error(
        "this URDD has no combined_robot_module, adjusted_robot_module or creator_module, which say how it was put together"
    )]
    NotComposed,
    /// What it says of how it was put together is nothing that a recipe can say.
    #[error("nothing of how it was put together can be said in a recipe: {}", .0.join("; "))]
    SaysNothing(Vec<String>),
    /// It is not valid.
    #[error(
        "it does not pass `urdd validate`: {}; correct it, or take it as it is: --force", codes.join(", ")
    )]
    Fails {
        /// The rules that found errors, and how many findings each.
        codes: Vec<String>,
    },
}
