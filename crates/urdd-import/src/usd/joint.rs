//! The joints of UsdPhysics, and the tree in the graph of bodies and joints: which bodies are the robot, which is its root,
//! which joints close chains.

use std::collections::{HashMap, HashSet};

use nalgebra::{Isometry3, Translation3, Vector3};
use urdd_usd::Prim;

use super::scene::{Scene, flag, number, triple, turn, word};
use crate::fault::UsdFault;
use crate::features::{self, Tally};
use crate::graph::{Branch, Forest};
use crate::model::JointKind;
use crate::place::{Fallible, Placing, at};

/// The motions of a generic joint, in the order in which they follow each other.
pub const MOTIONS: [&str; 6] = ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"];
/// The axes of these.
const AXES: [Vector3<f64>; 3] =
    [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 1.0, 0.0), Vector3::new(0.0, 0.0, 1.0)];

#[derive(Debug)]
pub struct UsdJoint {
    pub prim: usize,
    pub motions: Vec<Motion>,
    /// What the motions are together, if that is one joint.
    pub whole: Option<JointKind>,
    /// The ends: body 0, and body 1, which moves.
    pub ends: [JointEnd; 2],
    /// Whether it closes a chain that the articulation leaves open.
    pub is_excluded: bool,
    /// Whether it moves in all ways.
    pub is_free: bool,
    /// Whether it is one of MuJoCo, which follows another one between its bodies, and does not close a chain.
    pub is_mujocos: bool,
}

/// Where a joint is in a body.
#[derive(Debug, Clone, Copy)]
pub struct JointEnd {
    /// The prim of the body; none of the world.
    pub body: Option<usize>,
    /// In m.
    pub frame: Isometry3<f64>,
}

/// A motion along or about an axis of the frame of a joint.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Its index in [`MOTIONS`].
    pub which: usize,
    pub axis: Vector3<f64>,
    /// Limits, rad or m; infinite where there are none.
    pub range: [f64; 2],
    /// The name of its drive and its state.
    pub instance: &'static str,
}

impl Motion {
    pub fn is_slide(&self) -> bool {
        self.which < 3
    }
}

pub fn is_joint(prim: &Prim) -> bool {
    prim.type_name.starts_with("Physics") && prim.type_name.ends_with("Joint")
}

/// The joints of a stage that hold bodies.
pub fn joints(scene: &Scene<'_>, tally: &mut Tally) -> Fallible<Vec<UsdJoint>> {
    let mut all = Vec::new();
    for (at, prim) in scene.stage.prims.iter().enumerate() {
        if !is_joint(prim) {
            continue;
        }
        let is_lost = |end| Ok(!prim.targets(end).is_empty() && scene.target(at, end)?.is_none());
        if !flag(prim, "physics:jointEnabled", true)
            || &*prim.type_name == "PhysicsDistanceJoint"
            || is_lost("physics:body0")?
            || is_lost("physics:body1")?
        {
            tally.count(features::DISTANCES);
            continue;
        }
        let (motions, whole) = motions(scene, prim, tally);
        let ends = [end(scene, at, 0)?, end(scene, at, 1)?];
        if ends[0].body == ends[1].body {
            continue;
        }
        let is_excluded = flag(prim, "physics:excludeFromArticulation", false);
        let is_free = motions.len() == 6;
        let is_mujocos = prim.has("MjcJointAPI");
        all.push(UsdJoint { prim: at, motions, whole, ends, is_excluded, is_free, is_mujocos });
    }
    Ok(all)
}

/// The frame of a joint in the body of one of its ends.
fn end(scene: &Scene<'_>, joint: usize, which: usize) -> Fallible<JointEnd> {
    let prim = scene.prim(joint);
    let place = triple(prim, &format!("physics:localPos{which}")).unwrap_or_default();
    let rotation = turn(prim, &format!("physics:localRot{which}")).unwrap_or_default();
    let frame = |scale: Vector3<f64>| {
        let place = place.component_mul(&scale) * scene.metre;
        Isometry3::from_parts(Translation3::from(place), rotation)
    };
    let Some(target) = scene.target(joint, &format!("physics:body{which}"))? else {
        return Ok(JointEnd { body: None, frame: frame(Vector3::repeat(1.0)) });
    };
    let (own, scale) = scene.frame(target)?;
    let frame = frame(scale);
    Ok(match scene.body[target] {
        Some(body) if body == target => JointEnd { body: Some(body), frame },
        Some(body) => {
            JointEnd { body: Some(body), frame: scene.frame(body)?.0.inverse() * own * frame }
        }
        None => JointEnd { body: None, frame: own * frame },
    })
}

/// What a joint leaves free, and what that is if it is one joint.
fn motions(scene: &Scene<'_>, prim: &Prim, tally: &mut Tally) -> (Vec<Motion>, Option<JointKind>) {
    let axis = match word(prim, "physics:axis") {
        Some("Y") => 1,
        Some("Z") => 2,
        _ => 0,
    };
    let range = |lower: &str, upper: &str, unit: f64| {
        let of = |name: &str, none: f64| number(prim, name).map_or(none, |value| value * unit);
        [of(lower, f64::NEG_INFINITY), of(upper, f64::INFINITY)]
    };
    let unit = |which: usize| if which < 3 { scene.metre } else { 1f64.to_radians() };
    let single = |which: usize, instance| {
        let range = range("physics:lowerLimit", "physics:upperLimit", unit(which));
        let is_locked = range[0] > range[1];
        let motion = Motion { which, axis: AXES[axis], range, instance };
        if is_locked { Vec::new() } else { vec![motion] }
    };
    match &*prim.type_name {
        "PhysicsRevoluteJoint" => (single(3 + axis, "angular"), None),
        "PhysicsPrismaticJoint" => (single(axis, "linear"), None),
        "PhysicsSphericalJoint" => {
            let limits = ["physics:coneAngle0Limit", "physics:coneAngle1Limit"];
            if limits.iter().any(|name| number(prim, name).is_some_and(|limit| limit >= 0.0)) {
                tally.count(features::BALL_RANGES);
            }
            let each = (3..6).map(free);
            (each.collect(), Some(JointKind::Ball))
        }
        "PhysicsJoint" => {
            let mut all = Vec::new();
            for (which, name) in MOTIONS.into_iter().enumerate() {
                let range = match prim.has(&format!("PhysicsLimitAPI:{name}")) {
                    true => {
                        let [low, high] =
                            ["low", "high"].map(|end| format!("limit:{name}:physics:{end}"));
                        range(&low, &high, unit(which))
                    }
                    false => [f64::NEG_INFINITY, f64::INFINITY],
                };
                // Where the lower limit is above the upper one, it is locked; of equal ones, too.
                if range[0] < range[1] {
                    all.push(Motion { range, ..free(which) });
                }
            }
            if prim.has("PhysicsLimitAPI:distance") {
                tally.count(features::DISTANCES);
            }
            let is_limited =
                all.iter().any(|motion| motion.range.iter().any(|limit| limit.is_finite()));
            // What is driven or limited along one axis stays a joint of its own.
            let is_plain = !is_limited
                && !prim.schemas.iter().any(|schema| schema.starts_with("PhysicsDriveAPI:"));
            let normal = match &all[..] {
                [one, other, hinge] if other.is_slide() && !hinge.is_slide() => {
                    one.axis.cross(&other.axis).dot(&hinge.axis)
                }
                _ => 0.0,
            };
            let whole = match all.len() {
                3 if all.iter().all(|motion| !motion.is_slide()) => {
                    if is_limited {
                        tally.count(features::BALL_RANGES);
                    }
                    Some(JointKind::Ball)
                }
                3 if is_plain && normal != 0.0 => Some(JointKind::Planar),
                6 if is_plain => Some(JointKind::Floating),
                _ => None,
            };
            (all, whole)
        }
        _ => (Vec::new(), None),
    }
}

fn free(which: usize) -> Motion {
    let range = [f64::NEG_INFINITY, f64::INFINITY];
    Motion { which, axis: AXES[which % 3], range, instance: MOTIONS[which] }
}

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
        let name = scene.name(bodies[left])?;
        let text = format!("body `{name}` is left out: no joint connects it with the robot");
        tally.say(features::DETACHED_BODIES, scene.place(bodies[left]), text);
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
            let by_path = scene.stage.find(name, &scene.account).at(Default::default())?;
            let mut found = by_path.and_then(|prim| index.get(&prim).copied());
            for (at, body) in bodies.iter().enumerate() {
                if found.is_none() && scene.name(*body)? == name {
                    found = Some(at);
                }
            }
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
