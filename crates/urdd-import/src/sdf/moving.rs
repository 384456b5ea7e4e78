//! Joints of an SDF as joints of a body.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use super::super::features::{self, Tally};
use super::super::limits::limits;
use super::super::model::{Joint as Moving, JointKind, Mimic};
use super::super::place::Place;
use super::super::refusal::{Fallible, at};
use super::fault::SdfFault;
use super::poses::Frames;
use super::scene::{Axis, Joint, NodeKind, Scene, SdfJointKind};

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
pub fn needs_links(moves: &[Moving]) -> bool {
    moves.len() > 1 || moves.last().is_some_and(|last| last.frame != Isometry3::identity())
}

/// A joint that was turned round is said.
pub fn say_turned(scene: &Scene, joint: &Joint, tally: &mut Tally) {
    let node = &scene.nodes[joint.node];
    let place: Place = node.place;
    tally.count(features::TURNED);
    let words = match joint.kind {
        SdfJointKind::Ball => "the values of this ball are those of the opposite rotation",
        _ => "its values keep their meaning",
    };
    tally.remark(place, format!("joint `{}` leads to its parent here: {words}", node.name));
}
