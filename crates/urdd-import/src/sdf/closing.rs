//! Joints that close a chain.

use nalgebra::Vector3;

use super::super::features::{self, Tally};
use super::super::limits::say_closed;
use super::super::model::{Closing, End};
use super::super::refusal::Fallible;
use super::libsdformat::REFUSED;
use super::moving::direction;
use super::poses::Frames;
use super::scene::{Scene, SdfJointKind, WORLD};
use super::spanning::Outside;
use urdd_format::loops::LoopKind;
use urdd_kinematics::rotation::from_z;

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
        tally.count(features::OPEN);
        let text = format!(
            "the joint `{}` between `{of_parent}` and `{of_child}` is left out: it closes a chain",
            node.name
        );
        tally.remark(node.place, text);
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
