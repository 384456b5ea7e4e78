//! Valid URDDs: those that `urdd generate` makes of our robots. The repository keeps `urdd.json` and
//! the documents that are not large; sizes and hashes of everything else are in `urdd.json`.

use std::path::Path;

use super::data::{self, ROBOTS, VALID};
use super::tree::{FilePath, Node, Tree, TreeError};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_generate::{GenerateError, Settings, generate};

/// Sampled configurations of the distance statistics: few, so that making them takes seconds.
pub const NUM_SAMPLES: u32 = 20;
/// Documents up to this size are kept as bytes.
pub const LARGEST_KEPT: usize = 64 * 1024;

/// Names of our robots, sorted.
pub fn robots() -> Vec<String> {
    let of_urdf = |(path, _): (&'static str, _)| path.strip_suffix(".urdf");
    let names = data::below(ROBOTS).filter_map(of_urdf);
    let names = names.filter(|name| !name.contains('/'));
    names.map(str::to_owned).collect()
}

/// The id of the valid URDD of a robot, and its folder in the suite.
pub fn id(robot: &str) -> String {
    format!("{VALID}/{robot}")
}

/// Writes the robots into a folder: the URDFs, and what they name.
///
/// # Errors
/// Where something cannot be written.
pub fn write_robots(folder: &Path) -> Result<(), TreeError> {
    let mut tree = Tree::carried(ROBOTS);
    // Scripts that make them are of no use there.
    let scripts = FilePath::from("make");
    tree.nodes.retain(|path, _| !path.is_within(&scripts));
    tree.write(folder)
}

/// Makes the valid URDD of a robot in the folder `target`; the robots are in the folder `robots`.
///
/// # Errors
/// Where the URDD cannot be written, and where it is asked to stop.
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

/// The part of a URDD that is kept.
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

/// What is kept of the valid URDD of a robot.
pub fn carried(robot: &str) -> Tree {
    Tree::carried(&id(robot))
}
