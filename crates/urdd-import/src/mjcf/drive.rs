//! What actuators give to their joints: the greatest force and speed, gains, damping and armature; and the mass that an
//! actuator feels, which MuJoCo makes ratios of damping with.

use std::cell::OnceCell;
use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3, Vector6};
use urdd_directory::account::{Account, AccountError, Charged};

use super::body::{Lookup, Made};
use super::compiler::{Compiler, Compilers};
use super::joint::{Actuator, Law, TAGS, greatest, within};
use super::reading::{Defaults, Element, MAIN};
use crate::features::{self, Tally};
use crate::mass::turned;
use crate::model::{self, Body, Inertial, Joint, JointKind};
use crate::place::{Fallible, Place, Placing};

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

pub struct Driven<'d> {
    /// What says it, and what a replica adds to its name.
    pub element: &'d Element,
    pub suffix: &'d str,
    pub actuator: Actuator,
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
    give_all(&driven, &mut made.bodies, made.is_floating, lookup.account(), tally)
}

/// Gives joints what these actuators say.
pub fn give_all(
    driven: &[Driven<'_>],
    bodies: &mut Charged<Body>,
    is_floating: bool,
    account: &Account,
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
    let moved = OnceCell::new();
    let mut given: HashMap<(usize, usize), JointDrive> = HashMap::new();
    for Driven { element, suffix, actuator, compiler, joint: at } in driven {
        say(actuator, tally);
        let of = &at_rest[at.0].joints[at.1];
        let force = actuator.force(element, compiler)?;
        let told = actuator.told(element, compiler, of.range)?;
        let is_of_speed = actuator.is_of_speed();
        let velocity = told.filter(|_| is_of_speed).map(greatest).filter(|most| *most > 0.0);
        if actuator.law == Law::Servo && actuator.is_ratio() {
            account.charge(BODY * at_rest.len()).at(element.place)?;
            if moved.get().is_none() {
                let made = Moved::of(at_rest, is_floating, account).at(element.place)?;
                let _ = moved.set(made);
            }
        }
        let gains = gains(actuator, || moved.get().map_or(0.0, |moved: &Moved| moved.by(*at)));
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
    let mut following = 0;
    for body in bodies.walk(account).at(Place::default())? {
        following += body.joints.walk(account).at(body.place)?.filter(follows).count();
    }
    tally.add(features::MORE_GAINS, following);
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

/// What the joints of a robot move, where all are at their references. Six numbers are a turn and a shift in the frame of
/// the first body, or a torque about its origin and a force.
pub struct Moved {
    freedoms: Vec<Freedom>,
    /// The last freedom of each joint.
    of: HashMap<(usize, usize), usize>,
}

struct Freedom {
    /// The next one on the way to the base.
    above: Option<usize>,
    axis: Vector6<f64>,
    /// The inertia of what hangs on it, while all freedoms further out are free.
    inertia: Matrix6<f64>,
    /// What a unit of acceleration along its axis takes, and the part of it along the axis, with that of its motor.
    force: Vector6<f64>,
    mass: f64,
}

impl Moved {
    pub fn of(
        bodies: &Charged<Body>,
        is_floating: bool,
        account: &Account,
    ) -> Result<Self, AccountError> {
        let mut moved = Moved { freedoms: Vec::new(), of: HashMap::new() };
        let mut known: Vec<(Isometry3<f64>, Option<usize>)> = Vec::new();
        for (index, Body { parent, pose, joints, inertial, .. }) in
            bodies.walk(account)?.enumerate()
        {
            let above = parent.and_then(|parent| known.get(parent).copied());
            let (above, mut last) = above.unwrap_or_default();
            let pose = above * pose;
            if parent.is_none() && is_floating {
                let all = Matrix6::<f64>::identity();
                last = moved.push(last, all.column_iter().map(|axis| axis.into_owned()), 0.0);
            }
            for (number, joint) in joints.walk(account)?.enumerate() {
                let armature = joint.armature.unwrap_or(0.0);
                last = moved.push(last, axes(joint, &pose).into_iter(), armature);
                moved.of.extend(last.map(|last| ((index, number), last)));
            }
            if let (Some(last), Some(inertial)) = (last, inertial) {
                moved.freedoms[last].inertia += rigid(inertial, &pose);
            }
            known.push((pose, last));
        }
        moved.pass_on();
        Ok(moved)
    }

    /// Adds freedoms behind one, and returns the last.
    fn push(
        &mut self,
        mut above: Option<usize>,
        axes: impl Iterator<Item = Vector6<f64>>,
        armature: f64,
    ) -> Option<usize> {
        for axis in axes {
            let (inertia, force) = (Matrix6::zeros(), Vector6::zeros());
            self.freedoms.push(Freedom { above, axis, inertia, force, mass: armature });
            above = Some(self.freedoms.len() - 1);
        }
        above
    }

    /// Adds to each freedom what those further out do not take: the articulated inertias of Featherstone's algorithm.
    fn pass_on(&mut self) {
        for index in (0..self.freedoms.len()).rev() {
            let of = &mut self.freedoms[index];
            of.force = of.inertia * of.axis;
            of.mass += of.axis.dot(&of.force);
            let mut passed = of.inertia;
            if of.mass > 0.0 {
                passed -= of.force * of.force.transpose() / of.mass;
            } else {
                // Nothing moves along it.
                (of.force, of.mass) = (Vector6::zeros(), f64::INFINITY);
            }
            if let Some(above) = of.above {
                self.freedoms[above].inertia += passed;
            }
        }
    }

    /// The inertia about the axis of a joint, kg m², or the mass along it, kg, that a force at it feels while all other
    /// joints are free; 0 if there is none.
    pub fn by(&self, joint: (usize, usize)) -> f64 {
        let mut next = self.of.get(&joint).copied();
        let (mut forces, mut felt) = (Vec::new(), Vector6::zeros());
        while let Some(of) = next.map(|index| &self.freedoms[index]) {
            let force = if forces.is_empty() { 1.0 } else { -of.axis.dot(&felt) };
            felt += of.force * (force / of.mass);
            forces.push((of, force));
            next = of.above;
        }
        let (mut motion, mut speed) = (Vector6::zeros(), 0.0);
        for (of, force) in forces.into_iter().rev() {
            speed = (force - of.force.dot(&motion)) / of.mass;
            motion += of.axis * speed;
        }
        if speed > 0.0 { speed.recip() } else { 0.0 }
    }
}

/// The axes of a joint of a body that is at a pose.
fn axes(joint: &Joint, pose: &Isometry3<f64>) -> Vec<Vector6<f64>> {
    let frame = pose * joint.frame;
    let axis = frame.rotation * joint.axis.try_normalize(0.0).unwrap_or_default();
    let six = |turn: Vector3<f64>, shift: Vector3<f64>| {
        Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z)
    };
    let about = |axis: Vector3<f64>| six(axis, frame.translation.vector.cross(&axis));
    match joint.kind {
        JointKind::Hinge => vec![about(axis)],
        JointKind::Slide => vec![six(Vector3::zeros(), axis)],
        JointKind::Ball => [Vector3::x(), Vector3::y(), Vector3::z()].map(about).into(),
        // MJCF has neither.
        JointKind::Planar | JointKind::Floating => Vec::new(),
    }
}

/// The inertia of a body that is at a pose.
fn rigid(inertial: &Inertial, pose: &Isometry3<f64>) -> Matrix6<f64> {
    let arm = (pose * inertial.centre).coords.cross_matrix();
    let moments = turned(&inertial.inertia, &pose.rotation);
    let mut all = Matrix6::zeros();
    let parts: [(_, Matrix3<f64>); 4] = [
        ((0, 0), moments + arm * arm.transpose() * inertial.mass),
        ((0, 3), arm * inertial.mass),
        ((3, 0), arm.transpose() * inertial.mass),
        ((3, 3), Matrix3::identity() * inertial.mass),
    ];
    for (at, part) in parts {
        all.fixed_view_mut::<3, 3>(at.0, at.1).copy_from(&part);
    }
    all
}
