//! What Jazzy's parser asks of joints: it reads the URDF too, by urdfdom.

use super::parser::{Component, Hardware, IN_GAZEBO, MOCK, NO_LEADER, param};
use crate::prelude::*;
use crate::tree::Tree;
use crate::urdfdom::{self, Model};

const COMMANDED: Fault = Fault::Control(
    "the joint follows another one, and has a command interface",
    "remove the interface, or write `mimic=\"false\"` on this joint",
);
const NO_MIMIC: Fault = Fault::Control(
    "`mimic` is true, and the joint of the robot has no `<mimic>`",
    "write it there, or remove the attribute",
);
const NOT_FOLLOWED: Fault = Fault::Control(
    "`<param name=\"mimic\">` is for ROS humble alone, and the joint of the robot has no `<mimic>`",
    "write it there",
);
const FIXED: Fault = Fault::Control("the joint is fixed", "remove it here");

pub fn check<'t>(tree: &'t Tree<'t>, all: &[Hardware<'_>], effects: &mut Effects) -> Reading<()> {
    let model = model(tree, effects)?;
    for hardware in all {
        for joint in hardware.joints() {
            check_joint(joint, hardware, &model, effects)?;
            limits(joint, effects);
            let plugin = hardware.plugin.map_or("", |(_, plugin)| plugin);
            let has_mimic = || model.joints.get(joint.name)?.node.child("mimic");
            // Other hardware may read it.
            let is_known = plugin == MOCK || IN_GAZEBO.contains(&plugin);
            let mimic = param(joint.node, "mimic").filter(|_| is_known && has_mimic().is_none());
            if let Some((mimic, _)) = mimic {
                effects.drop(mimic, Part::of("joint", joint.name).inside("mimic"), NOT_FOLLOWED);
            }
        }
    }
    Ok(())
}

/// What urdfdom has. Jazzy has its release 4, later ones have 6, which takes more: what 4 refuses, its own line says.
fn model<'t>(tree: &'t Tree<'t>, effects: &mut Effects) -> Reading<Model<'t>> {
    let mut own = Effects::default();
    match urdfdom::model(tree, urdfdom::Release::Six, &mut own) {
        Ok(model) => Ok(model),
        Err(refused) => match own.into_kept().pop() {
            Some(why) => effects.refuse(why.at, why.fault),
            None => Err(refused),
        },
    }
}

fn check_joint(
    joint: &Component<'_>,
    hardware: &Hardware<'_>,
    model: &Model<'_>,
    effects: &mut Effects,
) -> Reading<()> {
    let at = |name| joint.node.attribute(name).map_or(joint.node.start(), |one| one.range.start);
    let Some(own) = model.joints.get(joint.name) else {
        return effects.refuse(at("name"), Fault::unknown("joint", joint.name));
    };
    match own.node.child("mimic") {
        None if joint.mimic == Some(true) => return effects.refuse(at("mimic"), NO_MIMIC),
        Some(mimic) if joint.mimic != Some(false) => {
            if let Some(command) = joint.interfaces.iter().find(|one| one.is_command()) {
                return effects.refuse(command.node, COMMANDED);
            }
            if !hardware.has_joint(mimic.value("joint").unwrap_or_default()) {
                return effects.refuse(joint.node, NO_LEADER);
            }
        }
        _ => {}
    }
    if own.kind == "fixed" {
        return effects.refuse(joint.node, FIXED);
    }
    Ok(())
}

/// Limits of commands that are not numbers are passed over, both of them.
fn limits(joint: &Component<'_>, effects: &mut Effects) {
    const LIMITED: [&str; 5] = ["position", "velocity", "effort", "acceleration", "jerk"];
    let is_limited = |name: &str| LIMITED.contains(&name);
    let interfaces = joint.interfaces.iter().filter(|one| one.is_command() && one.is_limited);
    for interface in interfaces.filter(|one| is_limited(one.name)) {
        for (param, fault) in
            ["min", "max"].into_iter().filter_map(|name| interface.not_a_number(name))
        {
            effects.drop(param, interface.part(joint).inside("limit"), fault);
        }
    }
}
