//! The tree in the graph of links and joints.

use super::super::features::{self, Tally};
use super::super::refusal::Refusal;
use super::super::sets::Sets;
use super::poses::Frames;
use super::scene::{Scene, SdfJointKind, WORLD};

/// A link in the tree, its parent first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Branch {
    /// The link; the number of links means the world.
    pub link: usize,
    /// The link before it, and the joint between the two; none of the root, and of what is only put to the root.
    pub joint: Option<(usize, usize)>,
    /// Whether the link is the joint's parent.
    pub is_turned: bool,
}

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
pub fn branches(scene: &Scene, frames: &Frames, tally: &mut Tally) -> Result<Tree, Refusal> {
    let world = scene.links.len();
    let mut sets = Sets::new(world + 1);
    let mut around: Vec<Vec<(usize, usize, bool)>> = vec![Vec::new(); world + 1];
    let mut is_child = vec![false; world + 1];
    let [first, further, gearboxes] = ends(scene, frames)?;
    let mut left_out = Vec::new();
    for end in first.into_iter().chain(further) {
        let Outside { joint, parent, child } = end;
        if sets.join(parent, child) {
            around[parent].push((child, joint, false));
            around[child].push((parent, joint, true));
            is_child[child] = true;
        } else {
            left_out.push(end);
        }
    }
    around.iter_mut().for_each(|joints| joints.sort_by_key(|(_, joint, _)| *joint));
    left_out.sort_unstable_by_key(|outside| outside.joint);
    let is_held = !around[world].is_empty();
    let canonical = frames.links[0].unwrap_or_default();
    let main = sets.of(if is_held { world } else { canonical });
    let mut starts: Vec<usize> = Vec::new();
    let mut is_started = vec![false; world + 1];
    let mut start = |link: usize, sets: &mut Sets| {
        let set = sets.of(link);
        if !std::mem::replace(&mut is_started[set], true) {
            starts.push(link);
        }
    };
    if is_held {
        start(world, &mut sets);
    } else if !is_child[canonical] {
        start(canonical, &mut sets);
    } else {
        let first = (0..world).find(|link| !is_child[*link] && sets.of(*link) == main);
        start(first.unwrap_or(canonical), &mut sets);
    }
    for link in (0..world).filter(|link| !is_child[*link]) {
        start(link, &mut sets);
    }
    let mut branches: Vec<Branch> = Vec::new();
    for (place, root) in starts.into_iter().enumerate() {
        let mut open = vec![Branch { link: root, joint: None, is_turned: false }];
        if place > 0 {
            let node = &scene.nodes[scene.links[root].node];
            tally.count(features::DETACHED);
            let text = format!("no joint holds link `{}`: it is fixed to the root", node.name);
            tally.remark(node.place, text);
        }
        while let Some(branch) = open.pop() {
            branches.push(branch);
            let came = branch.joint.map(|(_, joint)| joint);
            for (link, joint, is_turned) in around[branch.link].iter().rev().copied() {
                if Some(joint) != came {
                    open.push(Branch { link, joint: Some((branch.link, joint)), is_turned });
                }
            }
        }
    }
    Ok(Tree { branches, outside: left_out, gearboxes })
}

/// The joints that are the first to hold their child, the others, and gearboxes, which hold none.
fn ends(scene: &Scene, frames: &Frames) -> Result<[Vec<Outside>; 3], Refusal> {
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
