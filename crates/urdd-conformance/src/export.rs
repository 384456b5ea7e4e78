//! Writes the whole suite into a folder, for programs in any language.

use std::path::Path;

use rayon::prelude::*;

use crate::case::{Case, CaseKind};
use crate::catalogue::{self, items};
use crate::data::{Data, ROBOTS, VALID, VECTORS};
use crate::refused::{self, REFUSED};
use crate::running::{Result, RunError, Workplace};
use crate::suite::Suite;
use crate::tree::{Tree, TreeError, remove_folder, write_file};
use crate::valid;
use urdd_directory::cancellation::Cancellation;

/// Description of the suite.
const README: &str = "README.md";

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
pub fn export(suite: &Suite, folder: &Path) -> Result<Exported> {
    let place = Workplace::new(Some(folder))?;
    let (folder, data) = (place.path(), &suite.data);
    let robots = folder.join(ROBOTS);
    valid::write_robots(data, &robots)?;
    Tree::of(data.below(VECTORS), "").write(&folder.join(VECTORS))?;
    refused::tree(&refused::all(suite)?).write(&folder.join(REFUSED))?;
    let never = Cancellation::default();
    let (names, valid) = (valid::robots(data), folder.join(VALID));
    let other_bytes = write_valid(data, &names, &robots, &valid, &never)?;
    let left_out = write_cases(suite, folder)?;

    let mut items = items(suite)?;
    items.retain(|item| !left_out.contains(&item.id));
    let valid = items.iter().filter(|item| item.kind == CaseKind::Valid).count();
    let cases = items.len() - valid;
    let exported = Exported { valid, cases, left_out: left_out.clone(), other_bytes };
    for (name, text) in catalogue::files(&items, &left_out) {
        let path = folder.join(name);
        let text = text.map_err(|error| TreeError::Write(path.clone(), error.into()))?;
        write_file(&path, (text + "\n").as_bytes())?;
    }
    if let Some(readme) = data.file(README) {
        write_file(&folder.join(README), readme)?;
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
) -> Result<Vec<String>> {
    let mut other_bytes = Vec::new();
    for robot in names {
        let target = folder.join(robot);
        valid::make(robot, robots, &target, cancellation)
            .map_err(|error| RunError::Generate(robot.clone(), Box::new(error)))?;
        let made = Tree::read(&target, &target)?;
        if valid::kept(&made) != valid::carried(data, robot) {
            other_bytes.push(robot.clone());
        }
    }
    Ok(other_bytes)
}

/// Writes every case. Returns those that this operating system cannot represent.
fn write_cases(suite: &Suite, folder: &Path) -> Result<Vec<String>> {
    let write = |case: &Case| -> Result<Option<String>> {
        let case_folder = folder.join(case.folder());
        match case.write(&suite.tree(case)?, &case_folder.join(case.urdd())) {
            Ok(()) => Ok(None),
            Err(TreeError::Unsupported(_)) => {
                remove_folder(&case_folder)?;
                Ok(Some(case.id()))
            }
            Err(error) => Err(error.into()),
        }
    };
    let cases: Vec<&Case> = suite.all_cases().collect();
    cases.par_iter().filter_map(|case| write(case).transpose()).collect()
}
