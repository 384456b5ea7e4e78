//! The kinematic tree of a robot's joints.

use super::robot::Robot;

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
