//! gz_ros2_control: a plugin of a model in Gazebo, which has a controller manager with a resource manager of its own.

use super::parser::{Hardware, IN_GAZEBO, Interface, MOCK, controls};
use crate::prelude::*;
use crate::sdformat::HARMONIC;

/// The classes of the library, the second from before it had its name.
const CLASSES: [&str; 2] =
    ["gz_ros2_control::GazeboSimROS2ControlPlugin", "ign_ros2_control::IgnitionROS2ControlPlugin"];
/// Hardware of others that Gazebo does not have.
const OTHERS: [&str; 3] =
    [MOCK, "fake_components/GenericSystem", "gazebo_ros2_control/GazeboSystem"];

/// Whether a robot has its plugin or its hardware.
pub fn is_for(file: &File<'_>) -> bool {
    let hardware = controls(file).flat_map(|one| one.named("hardware"));
    let mut plugins = hardware.filter_map(|one| one.child("plugin")?.text());
    let is_own = |name: &str| IN_GAZEBO.contains(&name.trim_matches(is_space));
    plugins.any(is_own) || (controls(file).next().is_some() && system(file).is_some())
}

/// The first `<plugin>` of its library.
fn system<'t>(file: &'t File<'_>) -> Option<Node<'t>> {
    let tree = file.document.within(tinyxml::MAX_DEPTH).ok()?;
    let robot = tree.tops().find(|top| top.name() == "robot")?;
    let mut plugins = robot.named("gazebo").flat_map(|gazebo| gazebo.named("plugin"));
    plugins.find(|plugin| {
        let file = plugin.value("filename").unwrap_or_default();
        let name = file.rsplit('/').next().unwrap_or_default();
        let name = name.strip_suffix(".so").unwrap_or(name);
        let name = name.strip_prefix("lib").unwrap_or(name);
        matches!(name, "gz_ros2_control-system" | "ign_ros2_control-system")
    })
}

pub fn load(file: &File<'_>, all: &[Hardware<'_>], effects: &mut Effects) -> Reading<()> {
    start(file, all, effects)?;
    let lost = lost_joints(file);
    for hardware in all {
        let part = Part::of("hardware", hardware.name);
        match hardware.plugin {
            None => effects.drop(hardware.node, part, Fault::MissingElement("hardware")),
            Some((node, "")) => effects.drop(node, part, Fault::Empty("plugin")),
            // A robot that is a mock here, or real, often has the plugin of Gazebo too.
            Some((node, plugin)) if OTHERS.contains(&plugin) => {
                effects.drop(node, part, Fault::Way("the plugin is not one of Gazebo"));
            }
            Some((_, plugin)) if IN_GAZEBO.contains(&plugin) => {
                initialize(hardware, &lost, effects)?;
            }
            // Others may have made their own.
            Some(_) => {}
        }
    }
    Ok(())
}

/// The plugin of the model, which Gazebo makes by its name.
fn start(file: &File<'_>, all: &[Hardware<'_>], effects: &mut Effects) -> Reading<()> {
    let Some(plugin) = system(file) else {
        let fault = Fault::Control(
            "no `<plugin>` in `<gazebo>` has the file `gz_ros2_control-system`",
            "add it, with the name `gz_ros2_control::GazeboSimROS2ControlPlugin`",
        );
        let first = all.iter().find_map(|hardware| hardware.plugin);
        return effects.refuse(first.map_or(0, |(node, _)| node.start()), fault);
    };
    let name = plugin.attribute("name");
    if let Some(name) = name.filter(|name| !CLASSES.contains(&&*name.value)) {
        let expected = "`gz_ros2_control::GazeboSimROS2ControlPlugin`";
        return effects.refuse(name, Fault::value_but("name", &name.value, expected));
    }
    let parameters = plugin.child("parameters");
    let text = parameters.and_then(|one| one.text()).unwrap_or_default();
    if text.trim_matches(is_space).is_empty() {
        return match parameters {
            Some(empty) => effects.refuse(empty, Fault::Empty("parameters")),
            None => effects.refuse(plugin, Fault::MissingElement("parameters")),
        };
    }
    Ok(())
}

/// The joints that Gazebo leaves out.
fn lost_joints(file: &File<'_>) -> HashSet<String> {
    let mut gazebo = Effects::default();
    // What it refuses, its own line says.
    let _ = (HARMONIC.read)(file, &mut gazebo);
    let lost = gazebo.into_kept().into_iter();
    lost.map(|effect| effect.part.to_string()).filter(|part| part.starts_with("joint/")).collect()
}

/// `GazeboSimSystem::initSim`.
fn initialize(
    hardware: &Hardware<'_>,
    lost: &HashSet<String>,
    effects: &mut Effects,
) -> Reading<()> {
    const NO_JOINT: Fault =
        Fault::Control("hardware of Gazebo has no joint", "add its joints, or remove it");
    const NOT_THERE: Fault = Fault::Control(
        "Gazebo does not have this joint",
        "remove it here, or let Gazebo keep the joint",
    );
    const UNKNOWN: Fault = Fault::Control(
        "joints in Gazebo have `position`, `velocity` and `effort` alone",
        "remove the interface, or write one of these",
    );
    if hardware.joints().next().is_none() {
        return effects.refuse(hardware.node, NO_JOINT);
    }
    for joint in hardware.joints() {
        let part = Part::of("joint", joint.name);
        if lost.contains(&*part) {
            effects.drop(joint.node, part, NOT_THERE);
            continue;
        }
        let is_known = |one: &Interface<'_>| ["position", "velocity", "effort"].contains(&one.name);
        for interface in &joint.interfaces {
            if !is_known(interface) {
                effects.drop(interface.node, interface.part(joint), UNKNOWN);
            } else if let Some((param, fault)) =
                interface.not_a_number("initial_value").filter(|_| !interface.is_command())
            {
                return effects.refuse(param, fault);
            }
        }
    }
    Ok(())
}
