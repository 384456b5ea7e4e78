//! What SDF and USD share: the trees in a graph of bodies and joints, limits of which one is not said, and cones.

use urdd_geometry::Mesh;

use crate::features::{self, Tally};
use crate::model::JointKind;
use crate::place::Place;

/// A body in a tree.
#[derive(Debug, Clone, Copy)]
pub struct Branch {
    pub body: usize,
    /// The place of the branch before it, and the joint between the two; none of a root.
    pub joint: Option<(usize, usize)>,
    /// Whether the joint leads from this body to the one before it.
    pub is_turned: bool,
}

/// Bodies with joints that hold them together without a circle.
pub struct Forest {
    /// Of each body, another one that it is held together with; of the first of a set, itself.
    sets: Vec<usize>,
    /// The joints of each body: what it is held together with, the joint, and whether the body is its child.
    around: Vec<Vec<(usize, usize, bool)>>,
}

impl Forest {
    /// Each of so many bodies by itself.
    pub fn new(count: usize) -> Self {
        Forest { sets: (0..count).collect(), around: vec![Vec::new(); count] }
    }

    /// The first of the bodies that a body is held together with.
    pub fn set(&mut self, mut body: usize) -> usize {
        while self.sets[body] != body {
            self.sets[body] = self.sets[self.sets[body]];
            body = self.sets[body];
        }
        body
    }

    /// Holds two bodies together by a joint; false if they were before.
    pub fn join(&mut self, joint: usize, parent: usize, child: usize) -> bool {
        let (left, right) = (self.set(parent), self.set(child));
        if left == right {
            return false;
        }
        self.sets[left.max(right)] = left.min(right);
        self.around[parent].push((child, joint, false));
        self.around[child].push((parent, joint, true));
        true
    }

    pub fn joints(&self, body: usize) -> usize {
        self.around[body].len()
    }

    pub fn is_child(&self, body: usize) -> bool {
        self.around[body].iter().any(|(_, _, is_child)| *is_child)
    }

    /// Adds a branch and those behind it, by the order of joints; a parent stands before its children.
    pub fn grow(&mut self, root: Branch, branches: &mut Vec<Branch>) {
        let mut open = vec![root];
        while let Some(branch) = open.pop() {
            let (place, came) = (branches.len(), branch.joint.map(|(_, joint)| joint));
            branches.push(branch);
            let around = &mut self.around[branch.body];
            around.sort_unstable_by_key(|(_, joint, _)| *joint);
            let on = around.iter().rev().filter(|(_, joint, _)| Some(*joint) != came);
            open.extend(on.map(|&(body, joint, is_child)| Branch {
                body,
                joint: Some((place, joint)),
                is_turned: is_child,
            }));
        }
    }
}

/// How far the other limit is from one that stands alone, rad and m.
const FAR: [f64; 2] = [4.0 * std::f64::consts::PI, 10.0];

/// The limits of a joint, where infinite ones are none; `None` without any.
pub fn limits(
    [lower, upper]: [f64; 2],
    kind: JointKind,
    (joint, place): (&str, Place),
    tally: &mut Tally,
) -> Option<[f64; 2]> {
    let far = FAR[usize::from(kind == JointKind::Slide)];
    let (range, missing) = match (lower.is_finite(), upper.is_finite()) {
        (true, true) => return Some([lower, upper]),
        (false, false) => return None,
        (true, false) => ([lower, far.max(lower + far)], "upper"),
        (false, true) => ([(-far).min(upper - far), upper], "lower"),
    };
    let text = format!("joint `{joint}` has no {missing} limit: it is written with {range:?}");
    tally.say(features::ONE_SIDED, place, text);
    Some(range)
}

/// Says that a joint closes a chain, in which its limits are left out.
pub fn say_closed(
    ranges: impl IntoIterator<Item = [f64; 2]>,
    (joint, place): (&str, Place),
    tally: &mut Tally,
) {
    tally.count(features::CLOSED);
    if ranges.into_iter().flatten().any(f64::is_finite) {
        let text = format!(
            "the limits of joint `{joint}` are left out: it closes a chain, and moves as the others let it"
        );
        tally.remark(place, text);
    }
}

const SIDES: u32 = 64;

/// A cone of radius 1 and length 1 along z, about the middle of its length, its tip at the top.
pub fn cone() -> Mesh {
    let rim = (0..SIDES).map(|side| {
        let angle = std::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
        [angle.cos(), angle.sin(), -0.5]
    });
    let vertices: Vec<[f64; 3]> = rim.chain([[0.0, 0.0, 0.5], [0.0, 0.0, -0.5]]).collect();
    let (tip, middle) = (SIDES, SIDES + 1);
    let triangles = (0..SIDES).flat_map(|side| {
        let next = (side + 1) % SIDES;
        [[side, next, tip], [next, side, middle]]
    });
    let mut mesh = Mesh { vertices, triangles: triangles.collect() };
    mesh.round_to_f32();
    mesh
}
