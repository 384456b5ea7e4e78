//! `urdd_export`: each format is read by a second reader written here, and compared with the URDD.
//! `tests/figures/exports` tests what the target programs read from the files.

use urdd_export::{Choices, Export, ExportError, Format};
use urdd_robot::Robot;

mod carried;
mod choices;
mod command;
mod drake;
mod fitted_spheres;
mod mjcf;
mod mjcf_actuators;
mod moveit;
pub(crate) mod names;
mod pairs;
mod robot_file;
mod sdf;
mod setup;
mod spheres;
mod srdf;
mod srdf_import;
mod states;
pub(crate) mod texts;
mod urdf;

/// Exports a robot with what a person chose, which fits the format.
fn export(robot: &Robot, format: Format, choices: &Choices) -> Result<Export, ExportError> {
    urdd_export::export(robot, &choices.options(format).expect("options of the format"))
}
