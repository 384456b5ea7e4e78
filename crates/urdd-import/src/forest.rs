//! The trees in a graph of bodies and joints.

/// A body in a tree.
#[derive(Debug, Clone, Copy)]
pub struct Branch {
    /// The body.
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

    /// How many joints a body has.
    pub fn joints(&self, body: usize) -> usize {
        self.around[body].len()
    }

    /// Whether a body is the child of a joint.
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
