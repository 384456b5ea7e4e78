//! Gearboxes: equations between the joints on the way from a link to two others.
//!
//! Facts: SDFormat's `joint.sdf` and `gearbox.cpp` of Gazebo's ODE. Seen from the reference body, the child has turned about
//! the second axis by minus the ratio times the angle that the parent has turned about the first, from the pose of the file.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Vector3};

use super::super::features::{self, Tally};
use super::super::model::{Body, Coupled, JointKind};
use super::super::refusal::Fallible;
use super::moving::direction;
use super::poses::Frames;
use super::scene::{Scene, SdfJointKind, WORLD};
use super::spanning::Outside;
use urdd_format::short::Short;

/// Axes are parallel within this.
const PARALLEL: f64 = 1e-9;
/// Bodies between two links; what has more is left out.
const LONGEST: usize = 1000;

/// The equation of a gearbox. `at` has the body of each link, and of the world behind them; `poses` are those of the bodies.
/// `None`, with a remark, where joints turn about other axes.
pub fn gearbox(
    scene: &Scene,
    frames: &Frames,
    outside: Outside,
    at: &[Option<usize>],
    (bodies, poses): (&[Body], &[Isometry3<f64>]),
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
        tally.count(features::LOST_GEARBOXES);
        let text =
            format!("the gearbox `{}` is lost, and its joints turn on their own: {why}", node.name);
        tally.remark(node.place, text);
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
    let sum = || {
        let (reference, parent, child) = (reference?, body(outside.parent)?, body(outside.child)?);
        let mut terms = BTreeMap::new();
        let (first, second) = (axes.first()?, axes.last()?);
        turned(bodies, poses, [reference, parent], first, ratio, &mut terms)?;
        turned(bodies, poses, [reference, child], second, 1.0, &mut terms)?;
        terms.retain(|_, factor| *factor != 0.0);
        let terms: Vec<_> =
            terms.into_iter().map(|(name, of)| (name.to_owned(), vec![of])).collect();
        (!terms.is_empty()).then_some(terms)
    };
    let Some(terms) = sum() else {
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

/// Adds the angle by which a body has turned about an axis, seen from another, times a factor. `None` if something between
/// the two turns about another axis.
fn turned<'b>(
    bodies: &'b [Body],
    poses: &[Isometry3<f64>],
    [from, to]: [usize; 2],
    axis: &Vector3<f64>,
    factor: f64,
    terms: &mut BTreeMap<&'b str, f64>,
) -> Option<()> {
    let axis = axis.try_normalize(0.0)?;
    let (mut from, mut to) = (from, to);
    let mut steps = 0;
    // A parent is before its children.
    while from != to {
        steps += 1;
        if steps > LONGEST {
            return None;
        }
        let (body, sign) = if to > from { (to, factor) } else { (from, -factor) };
        for joint in &*bodies[body].joints {
            let own = poses[body].rotation * joint.frame.rotation * joint.axis;
            match joint.kind {
                JointKind::Slide => {}
                JointKind::Ball | JointKind::Planar | JointKind::Floating => return None,
                JointKind::Hinge => {
                    let along = own.try_normalize(0.0)?.dot(&axis);
                    if along.abs() < 1.0 - PARALLEL {
                        return None;
                    }
                    *terms.entry(joint.name.as_str()).or_default() += sign * along.signum();
                }
            }
        }
        let parent = bodies[body].parent?;
        if to > from {
            to = parent
        } else {
            from = parent
        };
    }
    Some(())
}
