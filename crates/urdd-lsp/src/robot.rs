//! The robot that a URDF describes: where its links are, and its mesh files.

use std::path::Path;

use nalgebra::Isometry3;

use urdd_document::robot::{Robot, of_urdf};
use urdd_document::tree::Tree;
use urdd_lint::pose::at_default;
use urdd_source::{Settings, SourceMeshes};

pub struct RobotModel {
    pub source: SourceMeshes,
    /// Its links and joints, with URDF's defaults.
    pub robot: Robot,
    /// Its tree; `None` if the joints form none.
    pub tree: Option<Tree>,
    /// The pose of each link in the root link's frame, in the default configuration; empty without a tree.
    pub poses: Vec<Isometry3<f64>>,
}

impl RobotModel {
    /// The robot of a URDF; `None` if it describes none.
    pub fn new(text: &str, name: &str, folder: &Path, settings: &Settings) -> Option<Self> {
        let source = SourceMeshes::of_text(text, name, folder, settings).ok()?;
        let robot = of_urdf(&source.robot);
        let tree = Tree::new(&robot);
        let poses = tree.as_ref().map(|tree| at_default(&robot, tree));
        Some(RobotModel { source, robot, tree, poses: poses.unwrap_or_default() })
    }
}
