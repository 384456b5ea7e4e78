//! The tree in the graph of links and joints, and bodies made of it.

use std::collections::HashSet;

use nalgebra::Isometry3;
use urdd_directory::account::{Account, Charged};

use super::moving::{Outside, closing, gearbox, moving, needs_links, say_turned};
use super::scene::{Frames, Placeable, Scene, SdfJointKind, WORLD, snapped};
use crate::features::{self, Tally};
use crate::graph::{Branch, Forest};
use crate::model::{Body, Closing, Coupled, Shape};
use crate::place::{Fallible, Place, Placing};

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
        if let Some(coupled) =
            gearbox(&scene, frames, outside, &at, (&made, &poses), account, tally)?
        {
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
    let bodies = made.walk(account).at(Place::default())?;
    let mut taken: HashSet<String> = bodies.map(|body| body.name.clone()).collect();
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

fn placed(scene: &Scene, frames: &Frames, link: usize, placeable: Placeable) -> Fallible<Shape> {
    let Placeable { mut shape, relative_to } = placeable;
    if let Some(name) = relative_to {
        let node = scene.links[link].node;
        let base = Frames::named(scene, node, "relative_to", &name)?;
        shape.pose = frames.relative(base, node) * shape.pose;
    }
    Ok(shape)
}

/// What the joints of a scene are.
#[derive(Debug)]
pub struct Tree {
    /// Links; the number of links means the world.
    pub branches: Vec<Branch>,
    /// Those that close chains.
    pub outside: Vec<Outside>,
    pub gearboxes: Vec<Outside>,
}

/// The branches of a scene, and the joints that are none: each link once, and the world if a joint holds on to it.
///
/// Joints are taken in the order of the file, those first that are the first to hold their child, so that few are turned
/// round.
///
/// # Errors
/// If a joint names what is not there.
pub fn branches(scene: &Scene, frames: &Frames, tally: &mut Tally) -> Fallible<Tree> {
    let world = scene.links.len();
    let mut forest = Forest::new(world + 1);
    let [first, further, gearboxes] = ends(scene, frames)?;
    let mut outside: Vec<Outside> = first.into_iter().chain(further).collect();
    outside.retain(|end| !forest.join(end.joint, end.parent, end.child));
    outside.sort_unstable_by_key(|end| end.joint);
    let firsts: Vec<usize> = (0..world).filter(|link| !forest.is_child(*link)).collect();
    let canonical = frames.links[0].unwrap_or_default();
    let root = if forest.joints(world) > 0 {
        world
    } else if !forest.is_child(canonical) {
        canonical
    } else {
        let main = forest.set(canonical);
        firsts.iter().copied().find(|link| forest.set(*link) == main).unwrap_or(canonical)
    };
    let (mut branches, mut grown) = (Vec::new(), HashSet::new());
    for link in std::iter::once(root).chain(firsts) {
        if !grown.insert(forest.set(link)) {
            continue;
        }
        if !branches.is_empty() {
            let node = &scene.nodes[scene.links[link].node];
            let text = format!("no joint holds link `{}`: it is fixed to the root", node.name);
            tally.say(features::DETACHED, node.place, text);
        }
        forest.grow(Branch { body: link, joint: None, is_turned: false }, &mut branches);
    }
    Ok(Tree { branches, outside, gearboxes })
}

/// The joints that are the first to hold their child, the others, and gearboxes, which hold none.
fn ends(scene: &Scene, frames: &Frames) -> Fallible<[Vec<Outside>; 3]> {
    let world = scene.links.len();
    let (mut first, mut further, mut gearboxes) = (Vec::new(), Vec::new(), Vec::new());
    let mut is_held = vec![false; world];
    for (index, joint) in scene.joints.iter().enumerate() {
        let parent = match joint.parent.as_str() {
            WORLD => Some(world),
            name => frames.links[Frames::named(scene, joint.node, "parent", name)?],
        };
        let Some((parent, child)) = parent.zip(frames.links[joint.node]) else { continue };
        let end = Outside { joint: index, parent, child };
        if matches!(joint.kind, SdfJointKind::Gearbox(_)) {
            gearboxes.push(end);
        } else if std::mem::replace(&mut is_held[child], true) {
            further.push(end);
        } else {
            first.push(end);
        }
    }
    Ok([first, further, gearboxes])
}
