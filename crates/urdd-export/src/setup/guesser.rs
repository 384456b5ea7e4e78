//! What is known while guessing, and what all guesses ask: chains of joints, and what words in names say of them.

use nalgebra::Isometry3;

use super::{EndEffector, Group, Guess, Members};
use crate::Structure;

/// The longest finger, m.
pub(super) const FINGER: f64 = 0.25;

pub(super) struct Guesser<'a> {
    pub structure: &'a Structure,
    pub poses: &'a [Isometry3<f64>],
    pub chains: Chains,
    pub groups: Vec<Guess<Group>>,
    pub ends: Vec<Guess<EndEffector>>,
    pub tools: Vec<usize>,
    /// Why the robot moves about, if it does.
    pub mobile: Option<&'static str>,
}

impl Guesser<'_> {
    pub fn is_horizontal(&self, joint: usize) -> bool {
        let child = self.structure.tree.joint_links[joint].1;
        let axis = self.poses[child].rotation
            * nalgebra::Vector3::from(self.structure.view.joints[joint].axis);
        axis.z.abs() < 0.5 * axis.norm()
    }

    /// Whether chains that begin at one place are the fingers of a hand: several, short, and no legs.
    pub fn are_fingers(&self, chains: &[usize]) -> bool {
        let is_finger = |chain: &usize| {
            self.chains.all[*chain].reach <= FINGER
                && !matches!(
                    self.part_of(*chain),
                    Some(Part::Leg | Part::Head | Part::Torso | Part::Arm)
                )
        };
        chains.len() > 1 && chains.iter().all(is_finger)
    }

    /// The link from which all fingers begin, if it is one.
    pub fn palm(&self, fingers: &[usize]) -> Option<usize> {
        let base = self.chains.all[*fingers.first()?].base;
        let all = fingers.iter().all(|finger| self.chains.all[*finger].base == base);
        all.then_some(base)
    }

    /// The tool frame of an arm: a frame with the name of a tool that is fixed to the palm, or else to the last link,
    /// `tool0` first; without one, the palm or the last link.
    pub fn tool(&self, last: usize, palm: Option<usize>) -> usize {
        let links = &self.structure.view.links;
        let is_frame = |link: &usize| {
            let link = &links[*link];
            link.visual.is_empty() && link.collision.is_empty() && is_tool(&link.name)
        };
        let best = |link: usize| {
            let fixed = self.structure.fixed_to(link);
            let frames: Vec<usize> = fixed[1..].iter().copied().filter(is_frame).collect();
            let tool0 = frames.iter().find(|frame| is_tool0(&links[**frame].name));
            tool0.or(frames.last()).copied()
        };
        palm.and_then(best).or_else(|| best(last)).unwrap_or(palm.unwrap_or(last))
    }

    pub fn moving(&self, joints: &[usize]) -> Members {
        let joints = joints.iter().copied();
        Members::Joints(joints.filter(|joint| self.structure.moves(*joint)).collect())
    }

    /// Adds a group with a name of its own, if it has members. Returns its place.
    pub fn push(&mut self, name: &str, members: Members, passive: bool, why: &str) -> usize {
        let place = self.groups.len();
        if members == Members::Joints(Vec::new()) {
            return place;
        }
        let is_free = |name: &str| self.groups.iter().all(|group| group.value.name != name);
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut names = [name.to_owned()].into_iter().chain(numbered);
        let name = names.find(|name| is_free(name)).unwrap_or_default();
        self.groups.push(Guess { value: Group { name, members, passive }, why: why.to_owned() });
        place
    }

    pub fn names(&self, chain: usize) -> impl Iterator<Item = &str> {
        let joints = self.chains.all[chain].joints.iter();
        joints.map(|joint| self.structure.view.joints[*joint].name.as_str())
    }

    pub fn part_of(&self, chain: usize) -> Option<Part> {
        part(self.names(chain))
    }

    pub fn named(&self, chain: usize, kind: &str) -> String {
        with_side(side(self.names(chain)).as_deref(), kind)
    }
}

pub(super) fn with_side(side: Option<&str>, kind: &str) -> String {
    side.map_or_else(|| kind.to_owned(), |side| format!("{side}_{kind}"))
}

/// Moving joints of one DOF in a row without a branch, or one of several DOFs.
pub(super) struct Chain {
    /// At least one, from the root outwards.
    pub joints: Vec<usize>,
    /// The link to which the first joint is attached.
    pub base: usize,
    /// The link that the last joint moves.
    pub last: usize,
    /// The chains that begin at its end.
    pub children: Vec<usize>,
    /// The farthest origin of a link after the first joint, m from it, in the default configuration.
    pub reach: f64,
}

/// All chains. A chain comes before those that begin at its end.
pub(super) struct Chains {
    pub all: Vec<Chain>,
    /// Those that begin at what is fixed to the root link.
    pub roots: Vec<usize>,
}

impl Chains {
    pub fn new(structure: &Structure, poses: &[Isometry3<f64>]) -> Self {
        let mut all: Vec<Chain> = Vec::new();
        let mut roots = Vec::new();
        let starts = |link: usize, parent: Option<usize>| {
            structure.joints_after(link).into_iter().rev().map(move |joint| (joint, parent))
        };
        let mut open: Vec<_> = starts(structure.tree.root, None).collect();
        while let Some((first, parent)) = open.pop() {
            let mut joints = vec![first];
            let mut last = structure.tree.joint_links[first].1;
            let mut next = structure.joints_after(last);
            let is_simple = |joint: usize| structure.view.joints[joint].num_dofs() == 1;
            while let [joint] = next[..] {
                // A joint of several DOFs is a chain of its own.
                if !is_simple(first) || !is_simple(joint) {
                    break;
                }
                joints.push(joint);
                last = structure.tree.joint_links[joint].1;
                next = structure.joints_after(last);
            }
            let place = all.len();
            match parent {
                Some(parent) => all[parent].children.push(place),
                None => roots.push(place),
            }
            open.extend(starts(last, Some(place)));
            let (base, child) = structure.tree.joint_links[first];
            let origin = poses[child].translation.vector;
            let distance = |link: usize| (poses[link].translation.vector - origin).norm();
            let links = structure.links_after(child).into_iter();
            all.push(Chain {
                joints,
                base,
                last,
                children: Vec::new(),
                reach: links.map(distance).fold(0.0, f64::max),
            });
        }
        Chains { all, roots }
    }

    /// The joints of a chain and of all that begin at its end, in joint order.
    pub fn joints_from(&self, chain: usize) -> Vec<usize> {
        let mut joints = Vec::new();
        let mut open = vec![chain];
        while let Some(chain) = open.pop() {
            joints.extend(&self.all[chain].joints);
            open.extend(&self.all[chain].children);
        }
        joints.sort_unstable();
        joints
    }
}

/// What a name says of a part of a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    Leg,
    Arm,
    Head,
    Torso,
    Hand,
}

const PARTS: &[(Part, &[&str])] = &[
    (Part::Leg, &["leg", "hip", "knee", "ankle", "thigh", "calf", "shank", "foot"]),
    (Part::Arm, &["arm", "shoulder", "elbow"]),
    (Part::Head, &["head", "neck"]),
    (Part::Torso, &["torso", "waist", "trunk", "spine", "lift"]),
    (Part::Hand, &["hand", "finger", "thumb", "knuckle", "gripper"]),
];

const SIDES: &[&str] = &[
    "left", "right", "l", "r", "front", "rear", "hind", "fl", "fr", "rl", "rr", "bl", "br", "lf",
    "rf", "lh", "rh", "hl", "hr",
];

const FINGERS: &[&str] = &["thumb", "index", "middle", "ring", "pinky", "little"];

const TOOLS: &[&str] = &["tool", "tool0", "tcp", "grasp", "grasping", "ee", "eef", "tip", "flange"];

/// The words of a name in lower case: `FL_hipJoint` has fl, hip and joint.
pub fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = '_';
    for c in name.chars() {
        if !c.is_alphanumeric() || (before.is_lowercase() && c.is_uppercase()) {
            words.push(String::new());
        }
        if c.is_alphanumeric()
            && let Some(word) = words.last_mut()
        {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// What most of the names say that say something.
pub fn part<'n>(names: impl Iterator<Item = &'n str>) -> Option<Part> {
    let mut counts = [0; PARTS.len()];
    for name in names {
        let words = words(name);
        for ((_, of_part), count) in PARTS.iter().zip(&mut counts) {
            *count += usize::from(words.iter().any(|word| of_part.contains(&word.as_str())));
        }
    }
    let most = counts.iter().copied().max().filter(|most| *most > 0)?;
    let place = counts.iter().position(|count| *count == most)?;
    Some(PARTS[place].0)
}

/// The sides that all names have in common, such as `front_left`.
pub fn side<'n>(names: impl Iterator<Item = &'n str>) -> Option<String> {
    shared(names, SIDES)
}

/// The finger that all names mean.
pub(super) fn finger<'n>(names: impl Iterator<Item = &'n str>) -> Option<String> {
    shared(names, FINGERS)
}

fn shared<'n>(names: impl Iterator<Item = &'n str>, known: &[&str]) -> Option<String> {
    let mut common: Option<Vec<String>> = None;
    for name in names {
        let own = words(name);
        match &mut common {
            None => {
                let own = own.into_iter().filter(|word| known.contains(&word.as_str()));
                common = Some(own.collect());
            }
            Some(common) => common.retain(|word| own.contains(word)),
        }
    }
    common.filter(|common| !common.is_empty()).map(|common| common.join("_"))
}

pub(super) fn is_hand(name: &str) -> bool {
    words(name).iter().any(|word| word == "hand" || word == "palm")
}

/// Whether a name is that of a tool frame.
pub fn is_tool(name: &str) -> bool {
    words(name).iter().any(|word| TOOLS.contains(&word.as_str()))
}

/// Whether a name is that of the tool frame of ROS-Industrial.
fn is_tool0(name: &str) -> bool {
    words(name).iter().any(|word| word == "tool0")
}

/// Whether a name is that of an inertial measurement unit.
pub fn is_imu(name: &str) -> bool {
    words(name).iter().any(|word| word == "imu")
}
