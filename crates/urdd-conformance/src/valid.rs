//! Valid URDDs: those that `urdd generate` writes for the suite's robots. The repository stores `urdd.json` and small
//! documents; `urdd.json` has the sizes and hashes of all other files.

use std::path::Path;

use crate::data::{Data, ROBOTS, VALID};
use crate::tree::{FilePath, Node, Tree, TreeError};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_generate::{GenerateError, Settings, generate};

/// Number of sampled configurations for the distance statistics: small, so that generating takes seconds.
pub const NUM_SAMPLES: u32 = 20;
/// Size limit of stored documents, bytes.
pub const LARGEST_KEPT: usize = 64 * 1024;

/// Names of the suite's robots, sorted.
pub fn robots(data: &Data) -> Vec<String> {
    let names = data.below(ROBOTS).filter_map(|(path, _)| path.strip_suffix(".urdf"));
    names.filter(|name| !name.contains('/')).map(str::to_owned).collect()
}

/// The id of a robot's valid URDD, which is also its folder in the suite.
pub fn id(robot: &str) -> String {
    format!("{VALID}/{robot}")
}

/// Writes the robots into a folder: the URDFs and the files that they name.
///
/// # Errors
/// If a file cannot be written.
pub fn write_robots(data: &Data, folder: &Path) -> Result<(), TreeError> {
    let mut tree = Tree::of(data.below(ROBOTS), "");
    // Leave out the scripts that generate the robots.
    let scripts = FilePath::from("make");
    tree.nodes.retain(|path, _| !path.is_within(&scripts));
    tree.write(folder)
}

/// Generates the valid URDD of a robot in the folder `target`. The robots are in the folder `robots`.
///
/// # Errors
/// If the URDD cannot be written, or the run is cancelled.
pub fn make(
    robot: &str,
    robots: &Path,
    target: &Path,
    cancellation: &Cancellation,
) -> Result<(), GenerateError> {
    let settings = Settings {
        num_samples: NUM_SAMPLES,
        cancellation: cancellation.clone(),
        ..Settings::default()
    };
    let source = robots.join(format!("{robot}.urdf"));
    generate(&source, target, &settings, &()).map(|_| ())
}

/// The part of a URDD that the repository stores.
pub fn kept(urdd: &Tree) -> Tree {
    let is_kept = |path: &FilePath, node: &Node| {
        let path = path.as_str().unwrap_or_default();
        let small = matches!(node, Node::File(bytes) if bytes.len() <= LARGEST_KEPT);
        path == ROOT_METADATA || small && path.ends_with("/module.json")
    };
    let mut kept = urdd.clone();
    kept.nodes.retain(|path, node| is_kept(path, node));
    kept
}

/// The stored part of a robot's valid URDD.
pub fn carried(data: &Data, robot: &str) -> Tree {
    Tree::of(data.below(&id(robot)), "")
}
