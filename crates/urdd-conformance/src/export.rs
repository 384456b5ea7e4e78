//! Writes the whole suite into a folder, for programs in any language.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::case::Kind;
use crate::catalogue::{CATALOGUE, Catalogue, items};
use crate::data::{Data, INVALID, ROBOTS, VALID, VECTORS};
use crate::refused::{self, REFUSED};
use crate::suite::{CaseError, Suite};
use crate::tree::{Tree, TreeError};
use crate::valid;
use urdd_directory::cancellation::Cancellation;
use urdd_format::registry::{PROGRAM_VERSION, SPEC_VERSION};
use urdd_generate::GenerateError;

/// Description of the suite.
const README: &str = "README.md";

/// Why the suite could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The folder is not empty.
    #[error("{}: this folder is not empty; give a new one", .0.display())]
    NotEmpty(PathBuf),
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {error}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Reason.
        error: io::Error,
    },
    /// A case or robot cannot be written.
    #[error(transparent)]
    Tree(#[from] TreeError),
    /// A case of the suite is damaged.
    #[error("the suite is damaged: {0}")]
    Case(#[from] CaseError),
    /// A valid URDD cannot be generated.
    #[error("{robot}: {error}")]
    Generate {
        /// The robot.
        robot: String,
        /// Reason.
        error: Box<GenerateError>,
    },
}

/// Counts of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exported {
    /// Number of valid URDDs.
    pub valid: usize,
    /// Number of cases, including near misses.
    pub cases: usize,
    /// Cases that this operating system cannot represent on disk.
    pub left_out: Vec<String>,
    /// Robots whose valid URDD differs in bytes from the one that the suite was checked with: the last digits of
    /// numbers vary between platforms.
    pub other_bytes: Vec<String>,
}

/// Writes the suite into `folder`, which is created if needed.
///
/// # Errors
/// If the folder is not empty, or cannot be written.
pub fn export(suite: &Suite, folder: &Path) -> Result<Exported, ExportError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |error| ExportError::Write { path, error }
    };
    fs::create_dir_all(folder).map_err(failed(folder))?;
    let mut inside = fs::read_dir(folder).map_err(failed(folder))?;
    if inside.next().is_some() {
        return Err(ExportError::NotEmpty(folder.to_owned()));
    }
    let data = &suite.data;
    let robots = folder.join(ROBOTS);
    valid::write_robots(data, &robots)?;
    Tree::of(data.below(VECTORS), "").write(&folder.join(VECTORS))?;
    refused::tree(&refused::all(suite)?).write(&folder.join(REFUSED))?;
    let never = Cancellation::default();
    let (names, valid) = (valid::robots(data), folder.join(VALID));
    let other_bytes = write_valid(data, &names, &robots, &valid, &never)?;
    let left_out = write_cases(suite, folder)?;

    let mut items = items(suite);
    items.retain(|item| !left_out.contains(&item.id));
    let count = |valid: bool| {
        let matching = items.iter().filter(|item| (item.kind == Kind::Valid) == valid);
        matching.count()
    };
    let exported = Exported {
        valid: count(true),
        cases: count(false),
        left_out: left_out.clone(),
        other_bytes,
    };
    let catalogue = Catalogue {
        spec_version: SPEC_VERSION.to_owned(),
        urdd: PROGRAM_VERSION.to_owned(),
        cases: items,
        left_out,
    };
    let path = folder.join(CATALOGUE);
    let text = serde_json::to_string_pretty(&catalogue).map_err(io::Error::from);
    let text = text.map_err(failed(&path))?;
    fs::write(&path, text + "\n").map_err(failed(&path))?;
    if let Some(readme) = data.file(README) {
        let path = folder.join(README);
        fs::write(&path, readme).map_err(failed(&path))?;
    }
    Ok(exported)
}

/// Generates the valid URDDs of these robots, whose URDFs are in the folder `robots`. Returns the robots whose bytes
/// differ from those that the suite was checked with.
pub fn write_valid(
    data: &Data,
    names: &[String],
    robots: &Path,
    folder: &Path,
    cancellation: &Cancellation,
) -> Result<Vec<String>, ExportError> {
    let mut other_bytes = Vec::new();
    for robot in names {
        let target = folder.join(robot);
        valid::make(robot, robots, &target, cancellation).map_err(|error| {
            ExportError::Generate { robot: robot.clone(), error: Box::new(error) }
        })?;
        let made = Tree::read(&target, &target)?;
        if valid::kept(&made) != valid::carried(data, robot) {
            other_bytes.push(robot.clone());
        }
    }
    Ok(other_bytes)
}

/// Writes every case. Returns those that this operating system cannot represent.
fn write_cases(suite: &Suite, folder: &Path) -> Result<Vec<String>, ExportError> {
    let write = |case: &crate::case::Case| -> Result<Option<String>, ExportError> {
        let case_folder = folder.join(INVALID).join(case.id());
        match case.write(&suite.tree(case)?, &case_folder.join(case.urdd())) {
            Ok(()) => Ok(None),
            Err(TreeError::Unsupported(_)) => {
                fs::remove_dir_all(&case_folder)
                    .map_err(|error| ExportError::Write { path: case_folder, error })?;
                Ok(Some(case.id()))
            }
            Err(error) => Err(error.into()),
        }
    };
    let written: Result<Vec<Option<String>>, ExportError> =
        suite.cases.par_iter().map(write).collect();
    Ok(written?.into_iter().flatten().collect())
}
