//! What drives a joint, and what it has inside; actuators of MuJoCo's schema and of Newton's are read as those of an MJCF.

use std::collections::HashMap;

use urdd_directory::account::{Account, Charged};
use urdd_usd::{Prim, Value};

use super::joint::Motion;
use super::scene::{Scene, number, word};
use crate::features::{self, Tally};
use crate::mjcf::{Actuator, Compiler, Driven, Element, give_all};
use crate::model::{self, Body, Joint, JointKind};
use crate::place::{Fallible, Placing};

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
    let effort = value(&["newton:effortLimit", "urdf:limit:effort", "mjc:actuatorfrcrange:max"]);
    joint.effort = positive(effort).map(|effort| effort * force);
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
        let text =
            format!("the gains of joint `{}` are left out: they are of accelerations", joint.name);
        tally.say(features::MORE_GAINS, scene.place(prim), text);
        return;
    }
    tally.count(features::GAINS);
    joint.kp = stiffness.map(|gain| gain * force / unit);
    joint.kv = damping.map(|gain| gain * force / unit);
    joint.actuator =
        model::Actuator { is_of_speed: stiffness.is_none(), ..model::Actuator::default() };
}

/// An actuator as an element, as bytes.
const ELEMENT: usize = 1000;
/// Attributes with one word or number, and with several numbers: of an MJCF, and of the schema.
const WORDS: [(&str, &str); 5] = [
    ("gaintype", "gainType"),
    ("biastype", "biasType"),
    ("dyntype", "dynType"),
    ("forcelimited", "forceLimited"),
    ("ctrllimited", "ctrlLimited"),
];
const LISTS: [(&str, &str); 3] = [("gainprm", "gainPrm"), ("biasprm", "biasPrm"), ("gear", "gear")];
const RANGES: [(&str, &str); 2] = [("forcerange", "forceRange"), ("ctrlrange", "ctrlRange")];

/// Gives joints what these actuators say. `of_joint` has the joints of the robot by their prims.
pub fn give(
    scene: &Scene<'_>,
    of_joint: &HashMap<usize, (usize, usize)>,
    bodies: &mut Charged<Body>,
    is_floating: bool,
    account: &Account,
    tally: &mut Tally,
) -> Fallible<()> {
    let mut found: Vec<(Element, (usize, usize))> = Vec::new();
    // MuJoCo's numbers are in SI.
    let is_si = scene.metre == 1.0 && scene.kilogram == 1.0;
    for (index, prim) in scene.stage.prims.iter().enumerate() {
        let target = match &*prim.type_name {
            "MjcActuator" => "mjc:target",
            "NewtonActuator" => "newton:targets",
            _ => continue,
        };
        let joint = scene.target(prim, target).and_then(|target| of_joint.get(&target));
        let is_one = |(body, joint): &&(usize, usize)| {
            let joint = &bodies[*body].joints[*joint];
            // Of a joint with a drive, the drive counts.
            matches!(joint.kind, JointKind::Hinge | JointKind::Slide)
                && joint.kp.or(joint.kv).is_none()
        };
        let Some(joint) = joint.filter(is_one).filter(|_| is_si) else {
            tally.count(features::OTHER_ACTUATORS);
            continue;
        };
        account.charge(ELEMENT).at(scene.place(index))?;
        let range = bodies[joint.0].joints[joint.1].range;
        let attributes = match target {
            "mjc:target" => Some(of_mujoco(prim, range)),
            _ => of_newton(prim),
        };
        let Some(mut attributes) = attributes else {
            tally.count(features::OTHER_ACTUATORS);
            continue;
        };
        attributes.push(("name".to_owned(), scene.name(index).to_owned()));
        let element = Element::new("general".to_owned(), attributes, scene.place(index));
        found.push((element, *joint));
    }
    let compiler = Compiler::new();
    let mut driven = Vec::new();
    for (element, joint) in &found {
        let Ok(actuator) = Actuator::of(element, &[]) else {
            tally.count(features::OTHER_ACTUATORS);
            continue;
        };
        let of = &mut bodies[joint.0].joints[joint.1];
        of.actuator.force = of.effort.map(|most| [-most, most]);
        driven.push(Driven { element, suffix: "", actuator, compiler: &compiler, joint: *joint });
    }
    give_all(&driven, bodies, is_floating, account, tally)
}

type Attributes = Vec<(String, String)>;

/// The attributes of a `<general>` of an MJCF, by MuJoCo's schema. `range` is that of the joint.
fn of_mujoco(prim: &Prim, range: Option<[f64; 2]>) -> Attributes {
    let mut attributes = Attributes::new();
    let mut set = |name: &str, value: Option<String>| {
        attributes.extend(value.map(|value| (name.to_owned(), value)));
    };
    for (name, own) in WORDS {
        set(name, word(prim, &format!("mjc:{own}")).map(str::to_owned));
    }
    for (name, own) in LISTS {
        set(name, prim.value(&format!("mjc:{own}")).and_then(Value::numbers).map(text));
    }
    for (name, own) in RANGES {
        let ends = ["min", "max"].map(|end| number(prim, &format!("mjc:{own}:{end}")));
        let is_said = ends.iter().any(Option::is_some);
        set(name, is_said.then(|| text(&ends.map(Option::unwrap_or_default))));
    }
    // Of a servo of position, which alone has it, control is told in the units of the joint.
    let first = |name: &str, place: usize| prim.value(name)?.numbers()?.get(place).copied();
    let is_servo = word(prim, "mjc:biasType") == Some("affine")
        && first("mjc:biasPrm", 1) == first("mjc:gainPrm", 0).map(|gain| -gain);
    let part = number(prim, "mjc:inheritRange").filter(|part| *part > 0.0 && is_servo);
    if let (Some(part), Some([least, most])) = (part, range) {
        let (middle, half) = ((least + most) / 2.0, (most - least) / 2.0 * part);
        attributes.retain(|(name, _)| !name.starts_with("ctrl"));
        attributes.push(("ctrlrange".to_owned(), text(&[middle - half, middle + half])));
    }
    attributes
}

/// The same, of a spring and a damper of Newton's schema; other laws have none.
fn of_newton(prim: &Prim) -> Option<Attributes> {
    let gain = |name: &str| number(prim, name).filter(|gain| *gain > 0.0).unwrap_or(0.0);
    let [stiffness, damping] = ["newton:kp", "newton:kd"].map(gain);
    let control = if stiffness > 0.0 { stiffness } else { damping };
    let is_servo = prim.has("NewtonPDControlAPI") && control > 0.0;
    let constant = number(prim, "newton:constEffort").unwrap_or(0.0);
    let most = number(prim, "newton:maxEffort").filter(|most| most.is_finite());
    let most = most.filter(|_| prim.has("NewtonMaxEffortClampingAPI"));
    let mut attributes = vec![
        ("biastype", "affine".to_owned()),
        ("gainprm", control.to_string()),
        ("biasprm", text(&[constant, -stiffness, -damping])),
    ];
    attributes.extend(most.map(|most| ("forcerange", text(&[-most, most]))));
    let owned = |(name, value): (&str, String)| (name.to_owned(), value);
    is_servo.then(|| attributes.into_iter().map(owned).collect())
}

fn text(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}
