//! Joints of an SDF as joints of a body, as what closes a chain, and gearboxes as equations between the joints on the way from
//! a link to two others.
//!
//! Facts: SDFormat's `joint.sdf` and `gearbox.cpp` of Gazebo's ODE. Seen from the reference body, the child has turned about
//! the second axis by minus the ratio times the angle that the parent has turned about the first, from the pose of the file.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use urdd_directory::account::{Account, AccountError, Charged};
use urdd_format::loops::LoopKind;
use urdd_format::short::Short;
use urdd_kinematics::rotation::from_z;

use super::libsdformat::REFUSED;
use super::scene::{Axis, Frames, Joint, NodeKind, Scene, SdfJointKind, WORLD};
use crate::fault::SdfFault;
use crate::features::{self, Tally};
use crate::graph::{limits, say_closed};
use crate::model::{Body, Closing, Coupled, End, Joint as Moving, JointKind, Mimic};
use crate::place::{Fallible, Placing, at};

/// A joint and its links; the number of links means the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outside {
    pub joint: usize,
    pub parent: usize,
    pub child: usize,
}

/// The joints of a body by which a joint moves it. `body` is the node of the body's link; none of the world.
pub fn moving(
    scene: &Scene,
    frames: &Frames,
    joint: &Joint,
    body: Option<usize>,
    is_turned: bool,
    tally: &mut Tally,
) -> Fallible<Vec<Moving>> {
    let node = &scene.nodes[joint.node];
    let frame = match body {
        Some(body) => frames.relative(joint.node, body),
        None => frames.poses[joint.node],
    };
    let sign = if is_turned { -1.0 } else { 1.0 };
    let base = |name: String, kind| Moving::new(name, kind, frame, node.place);
    let kind = match joint.kind {
        SdfJointKind::Slide => JointKind::Slide,
        SdfJointKind::Ball => JointKind::Ball,
        _ => JointKind::Hinge,
    };
    let mut moves = Vec::new();
    for (which, axis) in joint.axes.iter().enumerate() {
        let mut made = base(name_of(joint, node.name.as_str(), which), kind);
        made.axis = direction(scene, frames, joint.node, axis)? * sign;
        made.range = match joint.kind {
            SdfJointKind::Continuous => {
                if axis.range.iter().any(|limit| limit.is_finite()) {
                    let text = format!(
                        "the limits of joint `{}` are left out: a continuous joint has none",
                        node.name
                    );
                    tally.remark(axis.place, text);
                }
                None
            }
            _ => limits(axis.range, kind, (node.name.as_str(), axis.place), tally),
        };
        (made.effort, made.velocity) = (axis.effort, axis.velocity);
        (made.damping, made.friction) = (axis.damping, axis.friction);
        made.mimic = mimic(scene, joint.node, axis, tally)?;
        tally.count(made.feature());
        moves.push(made);
    }
    match joint.kind {
        SdfJointKind::Ball => {
            tally.count(features::BALLS);
            moves.push(base(node.name.clone(), kind));
        }
        SdfJointKind::Screw(pitch) => moves.extend(thread(&moves, pitch, tally)),
        _ => {}
    }
    if is_turned {
        moves.reverse();
    }
    Ok(moves)
}

/// The slide of a screw, which follows its hinge.
fn thread(hinge: &[Moving], pitch: f64, tally: &mut Tally) -> Option<Moving> {
    let hinge = hinge.first()?;
    tally.count(features::SCREWS);
    let multiplier = pitch / std::f64::consts::TAU;
    let range = hinge.range.map(|range| range.map(|angle| angle * multiplier));
    Some(Moving {
        name: format!("{}/thread", hinge.name),
        kind: JointKind::Slide,
        range: range.map(|[left, right]| [left.min(right), left.max(right)]),
        effort: None,
        velocity: None,
        damping: 0.0,
        friction: 0.0,
        mimic: Some(Mimic { joint: hinge.name.clone(), multiplier, offset: 0.0 }),
        ..hinge.clone()
    })
}

/// The name of what moves about an axis of a joint.
fn name_of(joint: &Joint, name: &str, which: usize) -> String {
    match (joint.kind, which) {
        (SdfJointKind::Two, 0) => format!("{name}/axis"),
        (SdfJointKind::Two, _) => format!("{name}/axis2"),
        _ => name.to_owned(),
    }
}

/// The direction of an axis in the joint's frame.
pub fn direction(
    scene: &Scene,
    frames: &Frames,
    joint: usize,
    axis: &Axis,
) -> Fallible<Vector3<f64>> {
    let Some(name) = &axis.expressed_in else { return Ok(axis.xyz) };
    let frame = Frames::named(scene, joint, "expressed_in", name)?;
    let turn: UnitQuaternion<f64> = frames.relative(frame, joint).rotation;
    let is_still = turn == UnitQuaternion::identity();
    Ok(if is_still { axis.xyz } else { clean(turn * axis.xyz) })
}

/// A direction without components that rounding alone made.
fn clean(direction: Vector3<f64>) -> Vector3<f64> {
    direction.map(|value| if value.abs() < 1e-15 { 0.0 } else { value })
}

fn mimic(scene: &Scene, joint: usize, axis: &Axis, tally: &mut Tally) -> Fallible<Option<Mimic>> {
    let Some(mimic) = &axis.mimic else { return Ok(None) };
    let found = Frames::named(scene, joint, "mimic", &mimic.joint)?;
    let NodeKind::Joint(index) = scene.nodes[found].kind else {
        let (element, name) = ("mimic".to_owned(), mimic.joint.clone());
        let model = scene.scopes[scene.nodes[joint].scope].name.clone();
        return Err(at(mimic.place, SdfFault::Unknown { element, name, model }));
    };
    tally.count(features::MIMICS);
    let leader = &scene.joints[index];
    let name = name_of(leader, &scene.nodes[found].name, usize::from(mimic.is_second));
    Ok(Some(Mimic {
        joint: name,
        multiplier: mimic.multiplier,
        offset: mimic.offset - mimic.multiplier * mimic.reference,
    }))
}

/// Whether a body needs links between its joints.
pub fn needs_links(moves: &Charged<Moving>) -> bool {
    moves.len() > 1 || moves.last().is_some_and(|last| last.frame != Isometry3::identity())
}

/// A joint that was turned round is said.
pub fn say_turned(scene: &Scene, joint: &Joint, tally: &mut Tally) {
    let node = &scene.nodes[joint.node];
    let words = match joint.kind {
        SdfJointKind::Ball => "the values of this ball are those of the opposite rotation",
        _ => "its values keep their meaning",
    };
    let text = format!("joint `{}` leads to its parent here: {words}", node.name);
    tally.say(features::TURNED, node.place, text);
}

/// The axes of a universal joint are at a right angle within this.
const RIGHT: f64 = 1e-9;

/// What holds two bodies together. `at` has the body of each link, and of the world behind them. `None`, with a remark, where
/// it is of a kind that no loop has.
pub fn closing(
    scene: &Scene,
    frames: &Frames,
    outside: Outside,
    at: &[Option<usize>],
    tally: &mut Tally,
) -> Fallible<Option<Closing>> {
    let Outside { joint, parent, child } = outside;
    let joint = &scene.joints[joint];
    let node = &scene.nodes[joint.node];
    let [of_parent, of_child] = [parent, child].map(|link| {
        scene.links.get(link).map_or(WORLD, |link| scene.nodes[link.node].name.as_str())
    });
    if parent == child {
        let text = format!("{REFUSED}joint `{}` has `{of_child}` at both ends", node.name);
        tally.remark(node.place, text);
    }
    let mut axes = Vec::new();
    for axis in &joint.axes {
        axes.push(direction(scene, frames, joint.node, axis)?);
    }
    let kind = match (joint.kind, &axes[..]) {
        (SdfJointKind::Fixed, _) => Some(LoopKind::Fixed),
        (SdfJointKind::Hinge | SdfJointKind::Continuous, [_]) => Some(LoopKind::Revolute),
        (SdfJointKind::Slide, [_]) => Some(LoopKind::Prismatic),
        (SdfJointKind::Ball, _) => Some(LoopKind::Spherical),
        (SdfJointKind::Two, [a, b]) => {
            (a.normalize().dot(&b.normalize()).abs() <= RIGHT).then_some(LoopKind::Universal)
        }
        _ => None,
    };
    let bodies = at.get(parent).copied().flatten().zip(at.get(child).copied().flatten());
    let Some((kind, (a, b))) = kind.zip(bodies).filter(|(_, (a, b))| a != b) else {
        let text = format!(
            "the joint `{}` between `{of_parent}` and `{of_child}` is left out: it closes a chain",
            node.name
        );
        tally.say(features::OPEN, node.place, text);
        return Ok(None);
    };
    let ranges = joint.axes.iter().map(|axis| axis.range);
    say_closed(ranges, (&node.name, node.place), tally);
    let end = |link: usize, body: usize, axis: Option<&Vector3<f64>>| {
        let frame = match scene.links.get(link) {
            Some(link) => frames.relative(joint.node, link.node),
            None => frames.poses[joint.node],
        };
        let frame = axis.map_or(frame, |axis| frame * from_z(axis));
        End { body, frame }
    };
    let ends = [end(parent, a, axes.first()), end(child, b, axes.last())];
    Ok(Some(Closing { name: Some(node.name.clone()), kind, ends, place: node.place }))
}

/// Axes are parallel within this.
const PARALLEL: f64 = 1e-9;
/// Bodies between two links; what has more is left out.
const LONGEST: usize = 1000;
/// What each of these costs.
const STEP: usize = 20;

/// The equation of a gearbox. `at` has the body of each link, and of the world behind them; `poses` are those of the bodies.
/// `None`, with a remark, where joints turn about other axes.
pub fn gearbox(
    scene: &Scene,
    frames: &Frames,
    outside: Outside,
    at: &[Option<usize>],
    (bodies, poses): (&Charged<Body>, &[Isometry3<f64>]),
    account: &Account,
    tally: &mut Tally,
) -> Fallible<Option<Coupled>> {
    let joint = &scene.joints[outside.joint];
    let node = &scene.nodes[joint.node];
    let SdfJointKind::Gearbox(ratio) = joint.kind else { return Ok(None) };
    let mut axes = Vec::new();
    for axis in &joint.axes {
        let direction = direction(scene, frames, joint.node, axis)?;
        axes.push(frames.poses[joint.node].rotation * direction);
    }
    let body = |link: usize| at.get(link).copied().flatten();
    let mut lost = |why: &str| {
        let text =
            format!("the gearbox `{}` is lost, and its joints turn on their own: {why}", node.name);
        tally.say(features::LOST_GEARBOXES, node.place, text);
        Ok(None)
    };
    if outside.parent == outside.child {
        return lost("it has the same link at both ends");
    }
    let named = joint.reference.as_deref().unwrap_or(WORLD);
    let reference = match named {
        WORLD => body(scene.links.len()),
        name => {
            let found = scene.find(node.scope, name);
            found.and_then(|node| frames.links[node]).and_then(body)
        }
    };
    if reference.is_none() {
        let named = Short::of(named);
        return lost(&format!("there is no link `{named}`, its reference body, in the robot"));
    }
    let ends = (|| {
        Some((reference?, body(outside.parent)?, body(outside.child)?, axes.first()?, axes.last()?))
    })();
    let sum = || {
        let Some((reference, parent, child, first, second)) = ends else { return Ok(None) };
        let mut terms = BTreeMap::new();
        let all = (bodies, poses, account);
        let is_known = turned(all, [reference, parent], first, ratio, &mut terms)?
            && turned(all, [reference, child], second, 1.0, &mut terms)?;
        terms.retain(|_, factor| *factor != 0.0);
        let terms: Vec<_> =
            terms.into_iter().map(|(name, of)| (name.to_owned(), vec![of])).collect();
        Ok((is_known && !terms.is_empty()).then_some(terms))
    };
    let terms: Result<_, AccountError> = sum();
    let Some(terms) = terms.at(node.place)? else {
        return lost(
            "between its links and the reference body there is nothing that turns about its axes alone",
        );
    };
    if joint.reference.is_none() {
        let text = format!(
            "the gearbox `{}` names no `gearbox_reference_body`: the world is taken",
            node.name
        );
        tally.remark(node.place, text);
    }
    if ratio == 0.0 {
        let text = format!(
            "the `gearbox_ratio` of `{}` is 0: its child does not turn, seen from the reference body",
            node.name
        );
        tally.remark(node.place, text);
    }
    tally.count(features::GEARBOXES);
    Ok(Some(Coupled { name: Some(node.name.clone()), constant: 0.0, terms }))
}

/// Adds the angle by which a body has turned about an axis, seen from another, times a factor. `false` if something between
/// the two turns about another axis.
fn turned<'b>(
    (bodies, poses, account): (&'b Charged<Body>, &[Isometry3<f64>], &Account),
    [from, to]: [usize; 2],
    axis: &Vector3<f64>,
    factor: f64,
    terms: &mut BTreeMap<&'b str, f64>,
) -> Result<bool, AccountError> {
    let Some(axis) = axis.try_normalize(0.0) else { return Ok(false) };
    let (mut from, mut to) = (from, to);
    let mut steps = 0;
    // A parent is before its children.
    while from != to {
        steps += 1;
        if steps > LONGEST {
            return Ok(false);
        }
        account.charge(STEP)?;
        let (body, sign) = if to > from { (to, factor) } else { (from, -factor) };
        for joint in bodies[body].joints.walk(account)? {
            let own = poses[body].rotation * joint.frame.rotation * joint.axis;
            match joint.kind {
                JointKind::Slide => {}
                JointKind::Ball | JointKind::Planar | JointKind::Floating => return Ok(false),
                JointKind::Hinge => {
                    let along = own.try_normalize(0.0).map(|own| own.dot(&axis));
                    let Some(along) = along.filter(|along| along.abs() >= 1.0 - PARALLEL) else {
                        return Ok(false);
                    };
                    *terms.entry(joint.name.as_str()).or_default() += sign * along.signum();
                }
            }
        }
        let Some(parent) = bodies[body].parent else { return Ok(false) };
        if to > from {
            to = parent
        } else {
            from = parent
        };
    }
    Ok(true)
}
