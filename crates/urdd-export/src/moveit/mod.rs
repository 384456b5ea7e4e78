//! A configuration package of MoveIt 2: groups, limits, solvers, planners, controllers, a launch file, and our URDF.
//!
//! The forms are those of MoveIt's own packages and of its Setup Assistant. The text of the export is the SRDF.

mod config;
mod controllers;
mod hardware;
mod mock;
mod package;
mod planning;
mod semantic;

use super::error::{ExportError, Note};
use super::names::check_package;
use super::options::MoveitOptions;
use super::output::Export;
use super::subject::Subject;
use super::urdf;
use super::xacro;
use config::Config;

const REPLACED: &str = "the hardware of the source's `<ros2_control>` is not in the package: `mock_components/GenericSystem` is in its place, with the same command interfaces; to drive the robot, put the source's into the URDF of `config`";

pub(super) fn export(subject: &Subject, options: &MoveitOptions) -> Result<Export, ExportError> {
    check_package(&options.package)?;
    let mut notes = Vec::new();
    let setup = subject.setup(&mut notes)?;
    let config = Config::new(subject, options, &setup)?;
    let shapes = subject.shapes_by_link()?;
    let (mut robot, meshes) = urdf::robot(subject, &options.model.meshes, shapes, &mut notes)?;
    robot.push(mock::hardware(&config));
    if config.hardware.is_of_source {
        notes.push(Note::Robot(REPLACED));
    }
    let controllers = controllers::controllers(&config);
    notes.extend(controllers::notes(&config, &controllers));
    let text = semantic::srdf(&config, &mut notes)?;
    let what = format!("Collision geometry: {}.", subject.shapes);
    let name = &config.name;
    let robot = robot.document_with(&subject.comments(what, &notes)?, xacro::text);
    let mut files = vec![(format!("config/{name}.urdf"), robot)];
    files.extend(planning::files(&config)?);
    files.extend(controllers::files(&config, &controllers)?);
    files.extend(package::files(&config, &controllers));
    let mut files: Vec<(String, Vec<u8>)> =
        files.into_iter().map(|(path, text)| (path, text.into_bytes())).collect();
    // Meshes are named by package: the folder of the package is where the export is.
    let prefix = format!("package://{}/", options.package);
    files.extend(meshes.into_iter().map(|(path, bytes)| {
        let inside = path.strip_prefix(&prefix).map(str::to_owned);
        (inside.unwrap_or(path), bytes)
    }));
    files.sort();
    Ok(Export { path: Some(format!("config/{name}.srdf")), ..Export::of(text, files, notes) })
}
