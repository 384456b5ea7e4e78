//! What actuators give to their joints: the greatest force and speed, gains, damping and armature.

use std::cell::LazyCell;
use std::collections::HashMap;

use super::super::features::{self, Tally};
use super::super::model::{self, Body, Joint, JointKind};
use super::super::refusal::Fallible;
use super::actuator::{Actuator, Law, TAGS, greatest, within};
use super::body::Made;
use super::compiler::{Compiler, Compilers};
use super::defaults::{Defaults, MAIN};
use super::element::Element;
use super::lookup::Lookup;
use super::moved::Moved;

/// What the actuators of one joint give together.
#[derive(Debug, Clone)]
struct JointDrive {
    /// None: as much as they like.
    force: Option<[f64; 2]>,
    /// None: no servo of speed has a limit.
    velocity: Option<f64>,
    gains: Option<[f64; 2]>,
    /// What the first says of itself, and how many there are.
    first: model::Actuator,
    number: usize,
}

/// What passing a body costs.
const BODY: usize = 50;

/// An actuator of a joint.
pub struct Driven<'d> {
    /// What says it, and what a replica adds to its name.
    pub element: &'d Element,
    pub suffix: &'d str,
    pub actuator: Actuator,
    /// How its model is read.
    pub compiler: &'d Compiler,
    /// The joint: its body, and its place there.
    pub joint: (usize, usize),
}

/// Gives joints what their actuators say.
pub fn drive<'d>(
    root: &'d Element,
    defaults: &'d Defaults<'d>,
    compilers: &Compilers,
    lookup: &Lookup<'_>,
    made: &mut Made,
    tally: &mut Tally,
) -> Fallible<()> {
    let mut driven: Vec<Driven<'_>> = Vec::new();
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
            let (actuator, compiler) = (actuator.clone(), compilers.at(element.place));
            driven.push(Driven { element, suffix, actuator, compiler, joint: at });
        }
    }
    let charge = |element: &Element, cost: usize| lookup.charge(element, cost);
    give_all(&driven, &mut made.bodies, made.is_floating, &charge, tally)
}

/// Gives joints what these actuators say. `charge` pays for work that one makes.
pub fn give_all(
    driven: &[Driven<'_>],
    bodies: &mut [Body],
    is_floating: bool,
    charge: &dyn Fn(&Element, usize) -> Fallible<()>,
    tally: &mut Tally,
) -> Fallible<()> {
    for Driven { actuator, joint: (body, joint), .. } in driven {
        let joint = &mut bodies[*body].joints[*joint];
        joint.damping += actuator.gear.powi(2) * actuator.joint_damping;
        let armature = actuator.gear.powi(2) * actuator.armature;
        if armature != 0.0 {
            joint.armature = Some(joint.armature.unwrap_or(0.0) + armature);
        }
    }
    let at_rest = &*bodies;
    let moved = LazyCell::new(|| Moved::of(at_rest, is_floating));
    let mut given: HashMap<(usize, usize), JointDrive> = HashMap::new();
    for Driven { element, suffix, actuator, compiler, joint: at } in driven {
        say(actuator, tally);
        let of = &at_rest[at.0].joints[at.1];
        let force = actuator.force(element, compiler)?;
        let told = actuator.told(element, compiler, of.range)?;
        let is_of_speed = actuator.is_of_speed();
        let velocity = told.filter(|_| is_of_speed).map(greatest).filter(|most| *most > 0.0);
        if actuator.law == Law::Servo && actuator.is_ratio() {
            charge(element, BODY * at_rest.len())?;
        }
        let gains = gains(actuator, || moved.by(*at));
        let Some(entry) = given.get_mut(at) else {
            let name = element.text("name").map(|name| format!("{name}{suffix}"));
            let name = name.filter(|name| *name != of.name);
            let first = model::Actuator { name, is_of_speed, control: told, force: None };
            given.insert(*at, JointDrive { force, velocity, gains, first, number: 1 });
            continue;
        };
        entry.number += 1;
        entry.force = entry.force.zip(force).map(|([a, b], [c, d])| [a + c, b + d]);
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
        give(&mut bodies[body].joints[joint], given, tally);
    }
    let follows =
        |joint: &&Joint| joint.mimic.is_some() && (joint.kp.is_some() || joint.armature.is_some());
    for _ in bodies.iter().flat_map(|body| &body.joints).filter(follows) {
        tally.count(features::MORE_GAINS);
    }
    Ok(())
}

/// Counts an actuator, and what of it is lost.
fn say(actuator: &Actuator, tally: &mut Tally) {
    match actuator.law {
        Law::Other => tally.count(features::OTHER_ACTUATORS),
        Law::Gain => tally.count(features::MOTORS),
        Law::Servo => tally.count(features::GAINS),
    }
    if actuator.law == Law::Servo && actuator.damping < 0.0 && !actuator.is_ratio() {
        tally.unread("dampings of actuators that push");
    }
    if actuator.law == Law::Servo && actuator.constant != 0.0 {
        tally.unread("forces of actuators that are always there");
    }
    if actuator.has_state {
        tally.unread("filters and integrators of actuators");
    }
}

fn give(joint: &mut Joint, given: JointDrive, tally: &mut Tally) {
    // The joint clamps the sum.
    let force = within(joint.actuator.force, given.force);
    let is_lost = given.first.name.is_some() || given.first.control.is_some();
    if given.number > 1 && is_lost {
        tally.count(features::MORE_GAINS);
    }
    joint.actuator = match given.number {
        1 => given.first,
        _ => model::Actuator::default(),
    };
    joint.actuator.force = force;
    joint.effort = force.map(greatest);
    joint.velocity = given.velocity.or(joint.velocity);
    if let Some([kp, kv]) = given.gains {
        (joint.kp, joint.kv) = (Some(kp), Some(kv));
    }
}

/// Stiffness and damping at the joint, if the actuator is a servo. `moved` is what the joint moves.
fn gains(actuator: &Actuator, moved: impl FnOnce() -> f64) -> Option<[f64; 2]> {
    let square = actuator.gear.powi(2);
    let kp = actuator.stiffness * square;
    let kv = match actuator.is_ratio() {
        true => -2.0 * actuator.damping * (kp.max(0.0) * moved()).sqrt(),
        false => actuator.damping.max(0.0) * square,
    };
    (actuator.law == Law::Servo).then_some([kp, kv])
}
