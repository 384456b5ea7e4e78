//! What actuators give to their joints: the greatest force and speed, gains, damping and armature.

use std::collections::HashMap;

use super::super::features::{self, Tally};
use super::super::model::JointKind;
use super::actuator::{Actuator, Law, TAGS};
use super::at::Fallible;
use super::compiler::Compiler;
use super::defaults::{Defaults, MAIN};
use super::document::Element;
use super::lookup::Lookup;
use super::made::Made;

/// What the actuators of one joint give together.
#[derive(Debug, Clone, Copy)]
struct Given {
    /// None: as much as they like.
    effort: Option<f64>,
    /// None: no servo of speed has a limit.
    velocity: Option<f64>,
    gains: Option<[f64; 2]>,
}

/// Gives joints what their actuators say.
pub fn drive<'d>(
    root: &'d Element,
    defaults: &'d Defaults<'d>,
    compiler: &Compiler,
    lookup: &Lookup<'_>,
    made: &mut Made,
    tally: &mut Tally,
) -> Fallible<()> {
    let mut driven: Vec<(&Element, Actuator, (usize, usize))> = Vec::new();
    for element in root.sections("actuator") {
        let class = match element.text("class") {
            Some(class) => defaults.class(class, element.place)?,
            None => MAIN,
        };
        let actuator = Actuator::of(element, &defaults.applied(element, class, &TAGS)?)?;
        let Some(name) = element.text("joint").or(element.text("jointinparent")) else {
            tally.count(features::OTHER_ACTUATORS);
            continue;
        };
        for suffix in lookup.replicas(element, &[Some(name)])? {
            let joint = lookup.joint(element, name, suffix)?;
            let Some(at) = made.joints.get(&joint).copied() else { continue };
            if made.bodies[at.0].joints[at.1].kind == JointKind::Ball {
                tally.count(features::OTHER_ACTUATORS);
                continue;
            }
            driven.push((element, actuator.clone(), at));
        }
    }
    for (_, actuator, (body, joint)) in &driven {
        let joint = &mut made.bodies[*body].joints[*joint];
        joint.damping += actuator.gear.powi(2) * actuator.joint_damping;
        let armature = actuator.gear.powi(2) * actuator.armature;
        if armature != 0.0 {
            joint.armature = Some(joint.armature.unwrap_or(0.0) + armature);
        }
    }
    let mut given: HashMap<(usize, usize), Given> = HashMap::new();
    for (element, actuator, at) in &driven {
        let [effort, velocity] =
            [actuator.effort(element, compiler)?, actuator.velocity(element, compiler)?];
        let gains = gains(actuator);
        if actuator.law == Law::Servo && actuator.damping < 0.0 {
            tally.unread("ratios of damping (dampratio) of actuators");
        }
        match actuator.law {
            Law::Other => tally.count(features::OTHER_ACTUATORS),
            Law::Gain => tally.count(features::MOTORS),
            Law::Servo => tally.count(features::GAINS),
        }
        if actuator.has_state {
            tally.unread("filters and integrators of actuators");
        }
        let entry =
            given.entry(*at).or_insert(Given { effort: Some(0.0), velocity: None, gains: None });
        entry.effort = entry.effort.zip(effort).map(|(a, b)| a + b);
        entry.velocity = match (entry.velocity, velocity) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
        if let Some([kp, kv]) = gains {
            let [a, b] = entry.gains.unwrap_or_default();
            entry.gains = Some([a + kp, b + kv]);
        }
    }
    for ((body, joint), given) in given {
        let joint = &mut made.bodies[body].joints[joint];
        joint.effort = match (joint.effort, given.effort) {
            (Some(of_joint), Some(of_actuators)) => Some(of_joint.min(of_actuators)),
            (a, b) => a.or(b),
        };
        joint.velocity = given.velocity;
        if let Some([kp, kv]) = given.gains {
            (joint.kp, joint.kv) = (Some(kp), Some(kv));
        }
    }
    Ok(())
}

/// Stiffness and damping at the joint, if the actuator is a servo.
fn gains(actuator: &Actuator) -> Option<[f64; 2]> {
    let square = actuator.gear.powi(2);
    let gains = [actuator.stiffness * square, actuator.damping.max(0.0) * square];
    (actuator.law == Law::Servo).then_some(gains)
}
