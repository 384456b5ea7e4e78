//! Robots for tests.

use tempfile::TempDir;
use urdd_export::{Export, Format, Options, export};
use urdd_robot::Robot;

/// A robot of this URDF.
pub fn robot(urdf: &str) -> (TempDir, Robot) {
    let folder = TempDir::new().expect("a folder");
    let source = folder.path().join("robot.urdf");
    std::fs::write(&source, urdf).expect("a URDF");
    let path = folder.path().join("robot");
    urdd_generate::generate(&source, &path, &Default::default(), &()).expect("a URDD");
    let robot = Robot::open(&path).expect("a robot");
    (folder, robot)
}

pub fn exported(robot: &Robot, format: Format) -> Export {
    export(robot, format, &Options { samples: 100, ..Options::default() }).expect("an export")
}

/// A URDF of these links and joints.
pub fn urdf(parts: &str) -> String {
    format!("<robot name=\"r\">{parts}</robot>")
}
