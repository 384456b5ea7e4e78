//! `ResourceManager`: loads the hardware, and asks it for the interfaces that are written.

use super::parser::{Component, Hardware, Interface, MOCK, NO_LEADER, Release, param};
use crate::prelude::*;

pub fn load(all: &[Hardware<'_>], release: Release, effects: &mut Effects) -> Reading<()> {
    let mut names = HashSet::new();
    let mut interfaces = HashSet::new();
    for hardware in all {
        let is_known = is_known(hardware);
        // Humble compares names only where it loads.
        if (is_known || release == Release::Four) && names.contains(hardware.name) {
            let fault = Fault::not_unique("`<ros2_control>`", hardware.name);
            return effects.refuse(at(hardware, "name"), fault);
        }
        if is_known {
            plugin(hardware, release, effects)?;
            names.insert(hardware.name);
            export(hardware, &mut interfaces, effects);
        }
    }
    all.iter().try_for_each(|hardware| validate(hardware, &interfaces, effects))
}

fn is_known(hardware: &Hardware<'_>) -> bool {
    ["system", "sensor", "actuator"].contains(&hardware.kind)
}

fn at(hardware: &Hardware<'_>, name: &str) -> usize {
    hardware.node.attribute(name).map_or(hardware.node.start(), |one| one.range.start)
}

/// The plugin is supposed to be installed.
fn plugin(hardware: &Hardware<'_>, release: Release, effects: &mut Effects) -> Reading<()> {
    let Some((node, name)) = hardware.plugin else {
        return effects.refuse(hardware.node, Fault::MissingElement("hardware"));
    };
    if name.is_empty() {
        return effects.refuse(node, Fault::Empty("plugin"));
    }
    if name.trim_matches(is_space) != name {
        let fault = Fault::Control(
            "white space around the name of the plugin counts as a part of it",
            "write the name without it",
        );
        return effects.refuse(node, fault);
    }
    if name == MOCK {
        initial_values(hardware, effects)?;
        if release == Release::Two {
            followers(hardware, effects)?;
        }
    }
    Ok(())
}

/// In Humble, `<param name="mimic">` says what a joint follows.
fn followers(hardware: &Hardware<'_>, effects: &mut Effects) -> Reading<()> {
    for joint in hardware.joints() {
        let Some((mimic, leader)) = param(joint.node, "mimic") else { continue };
        if !hardware.has_joint(leader) {
            return effects.refuse(mimic, NO_LEADER);
        }
    }
    Ok(())
}

fn initial_values(hardware: &Hardware<'_>, effects: &mut Effects) -> Reading<()> {
    let interfaces = hardware.components.iter().flat_map(|one| &one.interfaces);
    let is_double = |one: &&Interface<'_>| {
        let is_state = !one.is_command();
        is_state && one.node.value("data_type").is_none_or(|kind| kind == "double")
    };
    match interfaces.filter(is_double).find_map(|one| one.not_a_number("initial_value")) {
        Some((param, fault)) => effects.refuse(param, fault),
        None => Ok(()),
    }
}

/// A `sensor` gives no commands.
fn is_exported(hardware: &Hardware<'_>, interface: &Interface<'_>) -> bool {
    is_known(hardware) && !(hardware.kind == "sensor" && interface.is_command())
}

fn interfaces<'h, 't>(
    hardware: &'h Hardware<'t>,
) -> impl Iterator<Item = (&'h Component<'t>, &'h Interface<'t>)> {
    let all = hardware.components.iter();
    all.flat_map(|component| component.interfaces.iter().map(move |one| (component, one)))
}

type Key<'t> = (bool, &'t str, &'t str);

fn key<'t>(component: &Component<'t>, interface: &Interface<'t>) -> Key<'t> {
    (interface.is_command(), component.name, interface.name)
}

/// Of interfaces of one name, the first counts.
fn export<'t>(hardware: &Hardware<'t>, known: &mut HashSet<Key<'t>>, effects: &mut Effects) {
    const REPEATED: Fault = Fault::Control(
        "another interface of this joint, sensor or GPIO has the same name",
        "keep one, in one `<ros2_control>`",
    );
    for (component, interface) in interfaces(hardware) {
        if is_exported(hardware, interface) && !known.insert(key(component, interface)) {
            effects.drop(interface.node, interface.part(component), REPEATED);
        }
    }
}

/// Each interface has to be there in the end.
fn validate(
    hardware: &Hardware<'_>,
    known: &HashSet<Key<'_>>,
    effects: &mut Effects,
) -> Reading<()> {
    const NO_COMMANDS: Fault =
        Fault::Control("hardware of the type `sensor` has no commands", "write the type `system`");
    let missing =
        interfaces(hardware).find(|(one, interface)| !known.contains(&key(one, interface)));
    let expected = "`system`, `sensor` or `actuator`";
    let kind = || Fault::value_but("type", hardware.kind, expected);
    match missing {
        Some((_, interface)) if is_known(hardware) => effects.refuse(interface.node, NO_COMMANDS),
        Some(_) => effects.refuse(at(hardware, "type"), kind()),
        None if is_known(hardware) => Ok(()),
        None => {
            effects.drop(at(hardware, "type"), Part::of("hardware", hardware.name), kind());
            Ok(())
        }
    }
}
