//! What drives a joint, and what it has inside: gains, forces, speeds, damping, friction.

use super::super::features::{self, Tally};
use super::super::model::{Actuator, Joint};
use super::joint::Motion;
use super::scene::{Scene, number, word};

/// Forces of this or more are none.
const NONE: f64 = 1e30;

/// Adds them to a joint.
pub fn drive(
    scene: &Scene<'_>,
    prim: usize,
    motion: &Motion,
    joint: &mut Joint,
    tally: &mut Tally,
) {
    let of = scene.prim(prim);
    let (metre, kilogram) = (scene.metre, scene.kilogram);
    // A unit of the joint, in rad or m; a unit of force, and of inertia, in SI.
    let (unit, force, inertia) = match motion.is_slide() {
        true => (metre, kilogram * metre, kilogram),
        false => (1f64.to_radians(), kilogram * metre * metre, kilogram * metre * metre),
    };
    let value = |names: &[&str]| names.iter().find_map(|name| number(of, name));
    let positive = |value: Option<f64>| value.filter(|value| *value > 0.0 && *value < NONE);
    joint.velocity = positive(value(&["newton:velocityLimit", "physxJoint:maxJointVelocity"]))
        .map(|speed| speed * unit);
    joint.armature = positive(value(&["newton:armature", "physxJoint:armature", "mjc:armature"]))
        .map(|armature| armature * inertia);
    // MuJoCo's is of radians. What both say is the same.
    let radian = if motion.is_slide() { force / metre } else { force };
    let damping = positive(value(&["newton:damping"])).map(|damping| damping * force / unit);
    let of_mujoco = || positive(value(&["mjc:damping"])).map(|damping| damping * radian);
    joint.damping = damping.or_else(of_mujoco).unwrap_or(0.0);
    joint.friction = positive(value(&["newton:friction", "mjc:frictionloss"]))
        .map_or(0.0, |friction| friction * force);
    if positive(value(&["mjc:stiffness"])).is_some() {
        tally.count(features::SPRINGS);
    }
    let limits = [value(&["newton:effortLimit", "urdf:limit:effort", "mjc:actuatorfrcrange:max"])];
    joint.effort = positive(limits[0]).map(|effort| effort * force);
    let instance = motion.instance;
    if !of.has(&format!("PhysicsDriveAPI:{instance}")) {
        return;
    }
    let own = |name: &str| number(of, &format!("drive:{instance}:physics:{name}"));
    if let Some(most) = positive(own("maxForce")) {
        joint.effort = Some(most * force);
        tally.count(features::MOTORS);
    }
    let [stiffness, damping] = ["stiffness", "damping"].map(|name| positive(own(name)));
    if stiffness.is_none() && damping.is_none() {
        return;
    }
    if word(of, &format!("drive:{instance}:physics:type")) == Some("acceleration") {
        tally.count(features::MORE_GAINS);
        tally.remark(
            scene.place(prim),
            format!("the gains of joint `{}` are left out: they are of accelerations", joint.name),
        );
        return;
    }
    tally.count(features::GAINS);
    joint.kp = stiffness.map(|gain| gain * force / unit);
    joint.kv = damping.map(|gain| gain * force / unit);
    joint.actuator = Actuator { is_of_speed: stiffness.is_none(), ..Actuator::default() };
}
