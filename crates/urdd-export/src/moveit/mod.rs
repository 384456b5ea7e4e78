//! A configuration package of MoveIt 2: groups, limits, solvers, planners, controllers, a launch file, and our URDF.
//!
//! The forms are those of MoveIt's own packages and of its Setup Assistant. The text of the export is the SRDF.

mod config;
mod controllers;
mod package;
mod planning;
mod semantic;

use config::Config;

use crate::names::check_package;
use crate::{Export, ExportError, Note, Subject, urdf, xacro};
use urdd_xml::number::number;
use urdd_xml::writer::Element;

const REPLACED: &str = "the hardware of the source's `<ros2_control>` is not in the package: `mock_components/GenericSystem` is in its place, with the same command interfaces; to drive the robot, put the source's into the URDF of `config`";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let package = subject.options.package.as_deref().unwrap_or_default();
    check_package(package)?;
    let mut notes = Vec::new();
    let setup = subject.setup(&mut notes)?;
    let config = Config::new(subject, package, &setup)?;
    let shapes = subject.shapes_by_link()?;
    let (mut robot, meshes) = urdf::robot(subject, shapes, &mut notes)?;
    robot.push(mock_hardware(&config));
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
    let prefix = format!("package://{package}/");
    files.extend(meshes.into_iter().map(|(path, bytes)| {
        let inside = path.strip_prefix(&prefix).map(str::to_owned);
        (inside.unwrap_or(path), bytes)
    }));
    files.sort();
    Ok(Export { path: Some(format!("config/{name}.srdf")), ..Export::of(text, files, notes) })
}

/// Simulated hardware that does what it is told, for the launch file. A joint that takes velocities tells them, and stays
/// where it is: `calculate_dynamics` takes joints for others whose names have theirs in them.
fn mock_hardware(config: &Config) -> Element {
    let plugin = Element::text("plugin", "mock_components/GenericSystem");
    let mut hardware = Element::new("ros2_control")
        .with("name", "mock_hardware")
        .with("type", "system")
        .holding(Element::new("hardware").holding(plugin));
    let configuration = config.configurations.first();
    let configuration = configuration.map_or(&config.default, |named| &named.configuration);
    for joint in config.controlled().into_iter().flat_map(|(_, joints)| joints) {
        let mut element = Element::new("joint").with("name", config.joint(joint));
        for command in config.hardware.commands(joint) {
            element.push(Element::new("command_interface").with("name", command.word()));
        }
        let initial = number(config.position(configuration, joint));
        let initial = Element::text("param", &initial).with("name", "initial_value");
        element.push(Element::new("state_interface").with("name", "position").holding(initial));
        element.push(Element::new("state_interface").with("name", "velocity"));
        hardware.push(element);
    }
    hardware
}
