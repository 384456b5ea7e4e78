//! Robots for tests.

use tempfile::TempDir;
use urdd_export::{Choices, Export, ExportError, Format};
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

/// Exports a robot with what a person chose, which fits the format.
pub fn export(robot: &Robot, format: Format, choices: &Choices) -> Result<Export, ExportError> {
    urdd_export::export(robot, &choices.options(format).expect("options of the format"))
}

pub fn exported(robot: &Robot, format: Format) -> Export {
    export(robot, format, &Choices { samples: 100, ..Choices::default() }).expect("an export")
}

/// A URDF of these links and joints.
pub fn urdf(parts: &str) -> String {
    format!("<robot name=\"r\">{parts}</robot>")
}
