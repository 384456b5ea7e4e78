//! The tree in the graph of links and joints.

use std::collections::HashSet;

use super::super::features::{self, Tally};
use super::super::forest::{Branch, Forest};
use super::super::refusal::Fallible;
use super::poses::Frames;
use super::scene::{Scene, SdfJointKind, WORLD};

/// A joint and its links; the number of links means the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outside {
    pub joint: usize,
    pub parent: usize,
    pub child: usize,
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
            tally.count(features::DETACHED);
            let text = format!("no joint holds link `{}`: it is fixed to the root", node.name);
            tally.remark(node.place, text);
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
