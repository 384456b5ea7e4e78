//! Makes bodies of a scene.

use std::collections::HashSet;

use nalgebra::Isometry3;
use urdd_directory::account::{Account, Charged};

use super::super::features::{self, Tally};
use super::super::model::{Body, Closing, Coupled, Shape};
use super::super::place::Place;
use super::super::refusal::{Fallible, Placing};
use super::closing::closing;
use super::gearbox::gearbox;
use super::moving::{moving, needs_links, say_turned};
use super::poses::{Frames, snapped};
use super::scene::{Placeable, Scene, SdfJointKind, WORLD};
use super::spanning::{Tree, branches};

/// The bodies of a scene, and whether they are held by the world.
pub struct Bodies {
    pub bodies: Charged<Body>,
    pub is_held: bool,
    /// What closes chains.
    pub closings: Charged<Closing>,
    /// What gearboxes say.
    pub couplings: Charged<Coupled>,
}

/// Makes bodies: of the world if a joint holds on to it, of links, and of frames.
pub fn bodies(
    mut scene: Scene,
    frames: &Frames,
    tally: &mut Tally,
    account: &Account,
) -> Fallible<Bodies> {
    let Tree { branches: tree, outside, gearboxes } = branches(&scene, frames, tally)?;
    let world = scene.links.len();
    let mut at = vec![None; world + 1];
    let mut made: Charged<Body> = Charged::default();
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for branch in &tree {
        at[branch.body] = Some(made.len());
        let node = scene.links.get(branch.body).map(|link| link.node);
        let pose = node.map_or_else(Isometry3::identity, |node| frames.poses[node]);
        let parent = match branch.joint {
            Some((before, _)) => Some(before),
            None => (!made.is_empty()).then_some(0),
        };
        let (name, place) = match node {
            Some(node) => (scene.nodes[node].name.clone(), scene.nodes[node].place),
            None => (WORLD.to_owned(), Place::default()),
        };
        let inside = parent.map(|parent| snapped(poses[parent].inv_mul(&pose)));
        let mut body = Body::new(name, parent, inside.unwrap_or_default(), place);
        body.is_frame = node.is_none();
        if let Some((_, joint)) = branch.joint {
            let joint = &scene.joints[joint];
            for moving in moving(&scene, frames, joint, node, branch.is_turned, tally)? {
                body.joints.push(moving, account).at(place)?;
            }
            if joint.kind == SdfJointKind::Fixed {
                body.fixed_by = Some(scene.nodes[joint.node].name.clone());
            } else if branch.is_turned {
                say_turned(&scene, joint, tally);
            }
            if needs_links(&body.joints) {
                tally.count(features::MORE_JOINTS);
            }
        }
        poses.push(pose);
        made.push(body, account).at(place)?;
    }
    let mut closings = Charged::default();
    for outside in outside {
        if let Some(closing) = closing(&scene, frames, outside, &at, tally)? {
            let place = closing.place;
            closings.push(closing, account).at(place)?;
        }
    }
    let mut couplings = Charged::default();
    for outside in gearboxes {
        let place = scene.nodes[scene.joints[outside.joint].node].place;
        if let Some(coupled) = gearbox(&scene, frames, outside, &at, (&made, &poses), tally)? {
            couplings.push(coupled, account).at(place)?;
        }
    }
    for (link, index) in at.iter().enumerate().take(world) {
        let Some(index) = *index else { continue };
        let shapes = std::mem::take(&mut scene.links[link].shapes);
        for shape in shapes {
            let shape = placed(&scene, frames, link, shape)?;
            let place = shape.place;
            made[index].shapes.push(shape, account).at(place)?;
        }
        made[index].inertial = Some(scene.links[link].inertial);
    }
    let mut taken: HashSet<String> = made.iter().map(|body| body.name.clone()).collect();
    for frame in &scene.frames {
        let node = &scene.nodes[*frame];
        let parent = frames.links[*frame].and_then(|link| at[link]).unwrap_or_default();
        let pose = snapped(poses[parent].inv_mul(&frames.poses[*frame]));
        let mut name = node.name.clone();
        while !taken.insert(name.clone()) {
            name += "_frame";
        }
        let body = Body::new(name, Some(parent), pose, node.place);
        made.push(Body { is_frame: true, ..body }, account).at(node.place)?;
    }
    Ok(Bodies { is_held: at[world].is_some(), bodies: made, closings, couplings })
}

/// A shape in the frame of its link.
fn placed(scene: &Scene, frames: &Frames, link: usize, placeable: Placeable) -> Fallible<Shape> {
    let Placeable { mut shape, relative_to } = placeable;
    if let Some(name) = relative_to {
        let node = scene.links[link].node;
        let base = Frames::named(scene, node, "relative_to", &name)?;
        shape.pose = frames.relative(base, node) * shape.pose;
    }
    Ok(shape)
}
