//! The tree in the graph of bodies and joints: which bodies are the robot, which is its root, which joints close chains.

use std::collections::{HashMap, HashSet};

use super::super::features::{self, Tally};
use super::super::forest::{Branch, Forest};
use super::super::refusal::{Fallible, at};
use super::fault::UsdFault;
use super::joint::UsdJoint;
use super::scene::{Scene, flag};

/// The tree.
#[derive(Debug)]
pub struct Graph {
    /// The prims that are bodies.
    pub bodies: Vec<usize>,
    /// The bodies by their places; the number of bodies means the world.
    pub branches: Vec<Branch>,
    /// Further joints between a joint's bodies that follow it, by that joint.
    pub further: HashMap<usize, Vec<usize>>,
    /// The joints that close chains.
    pub outside: Vec<usize>,
    pub is_floating: bool,
}

/// The tree of the robot: the bodies that joints connect with an articulation, or with most joints.
pub fn graph(
    scene: &Scene<'_>,
    joints: &[UsdJoint],
    wanted: Option<&str>,
    tally: &mut Tally,
) -> Fallible<Graph> {
    let bodies: Vec<usize> =
        (0..scene.body.len()).filter(|at| scene.body[*at] == Some(*at)).collect();
    let index: HashMap<usize, usize> =
        bodies.iter().enumerate().map(|(at, body)| (*body, at)).collect();
    if bodies.is_empty() {
        return Err(at(Default::default(), UsdFault::NoBody));
    }
    let between = |joint: &UsdJoint| {
        let [one, other] =
            joint.ends.map(|end| end.body.and_then(|body| index.get(&body).copied()));
        one.zip(other)
    };
    let mut forest = Forest::new(bodies.len());
    // Those first that are the first to hold their body 1; those that an articulation leaves open last,
    // but before joints that hold nothing.
    let mut is_held = vec![false; bodies.len()];
    let mut order: Vec<(u8, usize)> = Vec::new();
    for (at, joint) in joints.iter().enumerate() {
        let Some((_, child)) = between(joint) else { continue };
        let was_held = std::mem::replace(&mut is_held[child], true);
        let rank = match (joint.is_free, joint.is_excluded) {
            (true, _) => 3,
            (_, true) => 2,
            _ => u8::from(was_held),
        };
        order.push((rank, at));
    }
    order.sort_unstable();
    // Whether a joint holds a body of the set in the world.
    let mut is_anchored = vec![false; bodies.len()];
    for joint in joints.iter().filter(|joint| !joint.is_free && !joint.is_excluded) {
        let [one, other] = joint.ends.map(|end| end.body);
        if let (Some(body), None) = (one.or(other), one.and(other)) {
            is_anchored[index[&body]] = true;
        }
    }
    let (mut outside, mut doubled) = (Vec::new(), Vec::new());
    let mut direct: HashMap<(usize, usize), usize> = HashMap::new();
    for (_, at) in order {
        let Some((parent, child)) = between(&joints[at]) else { continue };
        let both = [forest.set(parent), forest.set(child)];
        // What closes a chain does not make one robot of two that are held.
        let is_apart = joints[at].is_excluded && both.iter().all(|set| is_anchored[*set]);
        if !is_apart && forest.join(at, parent, child) {
            is_anchored[forest.set(parent)] = both.iter().any(|set| is_anchored[*set]);
            direct.insert((parent, child), at);
        } else if let Some(first) = direct.get(&(parent, child)) {
            doubled.push((*first, at, child));
        } else if !joints[at].is_free {
            outside.push(at);
        }
    }
    // What is said of an articulation is said of all bodies that its joints connect.
    let said = (0..bodies.len()).filter(|body| scene.adds_mobility[bodies[*body]]);
    let adding: HashSet<usize> = said.map(|body| forest.set(body)).collect();
    // Whether a joint follows another one of its two bodies, which are of this set.
    let adds = |at: usize, set: usize| {
        !joints[at].is_excluded && (joints[at].is_mujocos || adding.contains(&set))
    };
    let mut further: HashMap<usize, Vec<usize>> = HashMap::new();
    for (first, at, child) in doubled {
        match adds(at, forest.set(child)) {
            true => further.entry(first).or_default().push(at),
            false if !joints[at].is_free => outside.push(at),
            false => {}
        }
    }
    outside.sort_unstable();
    let main = main_set(scene, joints, &bodies, &index, wanted, &mut forest)?;
    let is_main: Vec<bool> = (0..bodies.len()).map(|body| forest.set(body) == main.set).collect();
    for left in (0..bodies.len()).filter(|body| !is_main[*body]) {
        tally.count(features::DETACHED_BODIES);
        let text = format!(
            "body `{}` is left out: no joint connects it with the robot",
            scene.name(bodies[left])
        );
        tally.remark(scene.place(bodies[left]), text);
    }
    let is_of_main = |joint: &usize| {
        joints[*joint].ends.iter().any(|end| end.body.is_some_and(|body| is_main[index[&body]]))
    };
    outside.retain(is_of_main);
    let mut branches = Vec::new();
    let mut first = Branch { body: main.root, joint: None, is_turned: false };
    if let Some(joint) = main.moves {
        branches.push(Branch { body: bodies.len(), ..first });
        first.joint = Some((0, joint));
        first.is_turned = joints[joint].ends[0].body.is_some();
    }
    forest.grow(first, &mut branches);
    let to_world = |at: &usize| adds(*at, main.set);
    match main.moves.filter(to_world) {
        Some(first) => {
            let (others, closing): (Vec<_>, Vec<_>) = main.others.into_iter().partition(to_world);
            outside.extend(closing);
            further.insert(first, others);
        }
        None => outside.extend(main.others),
    }
    let is_floating = !main.is_fixed && main.moves.is_none();
    Ok(Graph { bodies, branches, further, outside, is_floating })
}

/// The bodies that are the robot.
struct Main {
    set: usize,
    root: usize,
    is_fixed: bool,
    /// The joint by which the root moves in the world, if it is neither free nor fixed.
    moves: Option<usize>,
    /// Further joints to the world.
    others: Vec<usize>,
}

fn main_set(
    scene: &Scene<'_>,
    joints: &[UsdJoint],
    bodies: &[usize],
    index: &HashMap<usize, usize>,
    wanted: Option<&str>,
    forest: &mut Forest,
) -> Fallible<Main> {
    let wanted = match wanted {
        None => None,
        Some(name) => {
            let is_it = |body: &usize| scene.name(*body) == name || scene.stage.path(*body) == name;
            let found = bodies.iter().position(is_it);
            let missing = || at(Default::default(), UsdFault::NoSuchBody(name.to_owned()));
            Some(found.ok_or_else(missing)?)
        }
    };
    let mut scores: HashMap<usize, (bool, usize, usize)> = HashMap::new();
    for (at, body) in bodies.iter().enumerate() {
        let score = scores.entry(forest.set(at)).or_default();
        score.0 |= scene.is_articulated[*body];
        score.1 += forest.joints(at);
        score.2 += 1;
    }
    for joint in
        joints.iter().filter(|joint| scene.prim(joint.prim).has("PhysicsArticulationRootAPI"))
    {
        for body in joint.ends.iter().filter_map(|end| end.body) {
            scores.entry(forest.set(index[&body])).or_default().0 = true;
        }
    }
    let best = |at: usize, forest: &mut Forest| scores[&forest.set(at)];
    let mut chosen = 0;
    for at in 1..bodies.len() {
        if best(at, forest) > best(chosen, forest) {
            chosen = at;
        }
    }
    let set = forest.set(wanted.unwrap_or(chosen));
    // Joints to the world: fixed ones first, then the first.
    let mut to_world: Vec<(bool, usize, usize)> = Vec::new();
    for (at, joint) in joints.iter().enumerate().filter(|(_, joint)| !joint.is_free) {
        let [one, other] = joint.ends.map(|end| end.body);
        let (Some(body), None) = (one.xor(other), one.and(other)) else { continue };
        let body = index[&body];
        if forest.set(body) == set && wanted.is_none_or(|wanted| wanted == body) {
            to_world.push((!joint.motions.is_empty(), at, body));
        }
    }
    to_world.sort_unstable();
    let kinematic = |at: &usize| flag(scene.prim(bodies[*at]), "physics:kinematicEnabled", false);
    let of_set: Vec<usize> = (0..bodies.len()).filter(|at| forest.set(*at) == set).collect();
    if let Some((moves, joint, root)) = to_world.first().copied() {
        let others = to_world[1..].iter().map(|(_, joint, _)| *joint).collect();
        return Ok(Main { set, root, is_fixed: !moves, moves: moves.then_some(joint), others });
    }
    let marked =
        of_set.iter().find(|at| scene.prim(bodies[**at]).has("PhysicsArticulationRootAPI"));
    let first = of_set.iter().find(|at| !forest.is_child(**at));
    let still = of_set.iter().find(|at| kinematic(at));
    let root = wanted.or(still.or(marked).or(first).copied()).unwrap_or(chosen);
    Ok(Main { set, root, is_fixed: still == Some(&root), moves: None, others: Vec::new() })
}
