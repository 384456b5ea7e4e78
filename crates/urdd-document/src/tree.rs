//! The kinematic tree of a robot's joints, its rigid groups (links connected by fixed joints), and its mimic joints,
//! resolved through chains of mimics (SPEC 5.10).
//! A robot with these, each computed on first use.

use std::sync::OnceLock;

use crate::robot::Robot;
use urdd_format::urdf::JointType;

/// A kinematic tree.
#[derive(Debug, Clone)]
pub struct Tree {
    /// The root link.
    pub root: usize,
    /// Parent joint of each link.
    pub parent_joint: Vec<Option<usize>>,
    /// Parent link of each link.
    pub parent_link: Vec<Option<usize>>,
    /// Child joints of each link, ascending.
    pub child_joints: Vec<Vec<usize>>,
    /// Parent and child link of each joint.
    pub joint_links: Vec<(usize, usize)>,
    /// Depth of each link: its distance from the root in joints.
    pub depth: Vec<usize>,
    /// Breadth-first order of the links: by depth, then ascending by index.
    pub order: Vec<usize>,
}

impl Tree {
    /// The tree of a robot. `None` if a joint names an unknown link, a link has two parents, or not all links descend
    /// from one root.
    pub fn new(robot: &Robot) -> Option<Tree> {
        let links = robot.links.len();
        let mut tree = Tree {
            root: 0,
            parent_joint: vec![None; links],
            parent_link: vec![None; links],
            child_joints: vec![Vec::new(); links],
            joint_links: Vec::with_capacity(robot.joints.len()),
            depth: vec![0; links],
            order: Vec::with_capacity(links),
        };
        for (index, joint) in robot.joints.iter().enumerate() {
            let (parent, child) = (robot.link(&joint.parent)?, robot.link(&joint.child)?);
            if tree.parent_joint[child].replace(index).is_some() {
                return None;
            }
            tree.parent_link[child] = Some(parent);
            tree.child_joints[parent].push(index);
            tree.joint_links.push((parent, child));
        }
        tree.root = (0..links).find(|link| tree.parent_joint[*link].is_none())?;
        let mut level = vec![tree.root];
        while !level.is_empty() {
            level.sort_unstable();
            let mut next = Vec::new();
            for &link in &level {
                for &joint in &tree.child_joints[link] {
                    let child = tree.joint_links[joint].1;
                    tree.depth[child] = tree.depth[link] + 1;
                    next.push(child);
                }
            }
            tree.order.append(&mut level);
            level = next;
        }
        (tree.order.len() == links).then_some(tree)
    }

    /// The links of each depth, ascending.
    pub fn levels(&self) -> Vec<Vec<usize>> {
        let mut levels: Vec<Vec<usize>> = Vec::new();
        for &link in &self.order {
            match levels.get_mut(self.depth[link]) {
                Some(level) => level.push(link),
                None => levels.push(vec![link]),
            }
        }
        levels
    }

    /// The links from the root to a link, inclusive.
    pub fn path(&self, link: usize) -> Vec<usize> {
        let mut path: Vec<usize> =
            std::iter::successors(Some(link), |link| self.parent_link[*link]).collect();
        path.reverse();
        path
    }
}

/// Links that never move relative to each other.
#[derive(Debug, Clone)]
pub struct RigidGroup {
    /// Its links, parents before their children.
    pub links: Vec<usize>,
    /// The joint that moves it; `None` for the root's group.
    pub moved_by: Option<usize>,
}

/// The rigid groups of a robot, from the root downwards.
#[derive(Debug, Clone)]
pub struct RigidGroups {
    /// The groups.
    pub groups: Vec<RigidGroup>,
    /// Group of each link.
    pub of_link: Vec<usize>,
}

impl RigidGroups {
    /// The groups of a robot.
    pub fn new(robot: &Robot, tree: &Tree) -> Self {
        let mut groups: Vec<RigidGroup> = Vec::new();
        let mut of_link = vec![0; robot.links.len()];
        for &link in &tree.order {
            let joint = tree.parent_joint[link];
            let fixed =
                joint.is_some_and(|joint| robot.joints[joint].joint_type == JointType::Fixed);
            match tree.parent_link[link] {
                Some(parent) if fixed => {
                    of_link[link] = of_link[parent];
                    groups[of_link[parent]].links.push(link);
                }
                _ => {
                    of_link[link] = groups.len();
                    groups.push(RigidGroup { links: vec![link], moved_by: joint });
                }
            }
        }
        RigidGroups { groups, of_link }
    }
}

/// A resolved mimic joint: `multiplier * position of driver + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolved {
    /// The joint at the end of the chain: fixed, or with its own DOFs.
    pub driver: usize,
    /// Factor.
    pub multiplier: f64,
    /// Offset.
    pub offset: f64,
}

/// The mimic joints of a robot.
#[derive(Debug, Clone)]
pub struct Mimics {
    /// Resolved mimic of each joint; `None` for joints that are not mimic joints.
    pub by_joint: Vec<Option<Resolved>>,
}

impl Mimics {
    /// Resolves every mimic. `None` if one names an unknown joint, or they form a cycle.
    pub fn resolve(robot: &Robot) -> Option<Mimics> {
        let joints = robot.joints.len();
        let mut by_joint: Vec<Option<Resolved>> = vec![None; joints];
        let mut done = vec![false; joints];
        for start in 0..joints {
            let mut chain = Vec::new();
            let mut joint = start;
            while !done[joint] {
                let Some(mimic) = robot.joints[joint].active_mimic() else {
                    done[joint] = true;
                    break;
                };
                chain.push(joint);
                if chain.len() > joints {
                    return None;
                }
                joint = robot.joint(&mimic.joint)?;
            }
            // From the end of the chain backwards: each joint follows the one just resolved.
            for &follower in chain.iter().rev() {
                let mimic = robot.joints[follower].active_mimic()?;
                let next = robot.joint(&mimic.joint)?;
                by_joint[follower] = Some(match by_joint[next] {
                    None => Resolved {
                        driver: next,
                        multiplier: mimic.multiplier,
                        offset: mimic.offset,
                    },
                    Some(resolved) => Resolved {
                        driver: resolved.driver,
                        multiplier: mimic.multiplier * resolved.multiplier,
                        offset: mimic.multiplier * resolved.offset + mimic.offset,
                    },
                });
                done[follower] = true;
            }
        }
        Some(Mimics { by_joint })
    }
}

/// A robot, its tree, its rigid groups and its mimics.
#[derive(Default)]
pub struct Mechanism {
    robot: Robot,
    tree: OnceLock<Option<Tree>>,
    mimics: OnceLock<Option<Mimics>>,
    rigid_groups: OnceLock<Option<RigidGroups>>,
}

impl Mechanism {
    /// That of a robot.
    pub fn new(robot: Robot) -> Self {
        Mechanism { robot, ..Mechanism::default() }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The kinematic tree; `None` if the joints do not form a tree.
    pub fn tree(&self) -> Option<&Tree> {
        self.tree.get_or_init(|| Tree::new(&self.robot)).as_ref()
    }

    /// The rigid groups; `None` if the joints do not form a tree.
    pub fn rigid_groups(&self) -> Option<&RigidGroups> {
        let make = || Some(RigidGroups::new(&self.robot, self.tree()?));
        self.rigid_groups.get_or_init(make).as_ref()
    }

    /// The resolved mimic joints; `None` if they cannot be resolved.
    pub fn mimics(&self) -> Option<&Mimics> {
        self.mimics.get_or_init(|| Mimics::resolve(&self.robot)).as_ref()
    }
}
