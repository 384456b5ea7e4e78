//! A joint, how elements are chosen, and which links and joints are written.

use crate::number::python;
use crate::prelude::*;

pub struct Joint<'t> {
    pub node: Node<'t>,
    pub name: &'t str,
    pub kind: &'t str,
    pub parent: &'t str,
    pub child: &'t str,
}

/// The last element of a name, which is the one that counts.
pub fn last<'t>(node: Node<'t>, name: &str) -> Option<Node<'t>> {
    node.named(name).last()
}

/// Links in a row, at which Python's stack ends.
const MAX_LINKS: usize = 495;

/// Finds the links that are written, and says which links and joints are not.
pub fn find<'t>(
    robot: Node<'t>,
    first: Node<'t>,
    links: &HashMap<&'t str, Node<'t>>,
    joints: &[Joint<'t>],
    effects: &mut Effects,
) -> Reading<Vec<Node<'t>>> {
    let mut below: HashMap<&str, Vec<&Joint<'t>>> = HashMap::new();
    let mut children = HashSet::new();
    for joint in joints {
        below.entry(joint.parent).or_default().push(joint);
        children.insert(joint.child);
    }
    let root = match joints {
        [] => first.value("name"),
        _ => joints.iter().map(|joint| joint.parent).find(|parent| !children.contains(parent)),
    };
    let Some(root) = root else {
        return effects.refuse(robot, NO_ROOT);
    };
    let driven = driven(joints);
    let mut tree = Tree { links, below, driven, merged: HashSet::new(), bodies: HashSet::new() };
    let kept = tree.walk(root, effects)?;
    let names: HashSet<&str> = kept.iter().copied().collect();
    for link in robot.named("link") {
        let name = link.value("name").unwrap_or_default();
        if !names.contains(name) && !tree.merged.contains(name) {
            let fault = Fault::Tree("the link is not below the root");
            effects.drop(link, Part::of("link", name), fault);
        }
    }
    tree.joints(joints, effects);
    Ok(kept.into_iter().filter_map(|name| links.get(name).copied()).collect())
}

/// The children of fixed joints that others mimic.
fn driven<'t>(joints: &[Joint<'t>]) -> HashSet<&'t str> {
    let mimicked: HashSet<&str> = joints
        .iter()
        .filter_map(|joint| last(joint.node, "mimic").and_then(|mimic| mimic.value("joint")))
        .collect();
    let fixed = joints.iter().filter(|joint| joint.kind == "fixed");
    fixed.filter(|joint| mimicked.contains(joint.name)).map(|joint| joint.child).collect()
}

struct Tree<'t, 'a> {
    links: &'a HashMap<&'t str, Node<'t>>,
    below: HashMap<&'t str, Vec<&'a Joint<'t>>>,
    driven: HashSet<&'t str>,
    /// Links whose inertia goes to the link above.
    merged: HashSet<&'t str>,
    /// Links that are rigid bodies.
    bodies: HashSet<&'t str>,
}

impl<'t> Tree<'t, '_> {
    /// Goes through the links from the root, each once.
    fn walk(&mut self, root: &'t str, effects: &mut Effects) -> Reading<Vec<&'t str>> {
        let mut kept = Vec::new();
        // The links from the root to this one, and how many of the joints below each were followed.
        let mut path = Vec::new();
        let mut on_path = HashSet::new();
        let mut seen = HashSet::from([root]);
        self.enter(root, None, effects);
        kept.push(root);
        path.push((root, 0));
        on_path.insert(root);
        while let Some((link, next)) = path.last_mut() {
            let Some(&joint) = self.below.get(*link).and_then(|joints| joints.get(*next)) else {
                on_path.remove(*link);
                path.pop();
                continue;
            };
            *next += 1;
            if on_path.contains(joint.child) {
                return effects.refuse(joint.node, Fault::Tree("the joints make a loop"));
            }
            if self.merged.contains(joint.child) || !seen.insert(joint.child) {
                continue;
            }
            if path.len() >= MAX_LINKS {
                return effects.refuse(joint.node, Fault::Tree("too many links are in a row"));
            }
            self.enter(joint.child, Some(joint), effects);
            kept.push(joint.child);
            path.push((joint.child, 0));
            on_path.insert(joint.child);
        }
        Ok(kept)
    }

    fn enter(&mut self, name: &'t str, above: Option<&Joint<'t>>, effects: &mut Effects) {
        let Some(&link) = self.links.get(name) else { return };
        let is_empty = has_no_inertia(link) && !has_shape(link);
        let is_fixed =
            above.is_none_or(|joint| joint.kind == "fixed" && !self.driven.contains(name));
        let part = Part::of("link", name);
        if !is_empty || !is_fixed {
            self.bodies.insert(name);
        } else if let Some(inertial) = last(link, "inertial") {
            let fault = Fault::Way("the link has no mass, no shape, and a fixed joint above it");
            effects.drop(inertial, part.inside("inertial"), fault);
        }
        if !has_no_inertia(link) || !has_shape(link) {
            return;
        }
        let mut fixed = self
            .below
            .get(name)
            .into_iter()
            .flatten()
            .filter(|joint| joint.kind == "fixed" && !self.driven.contains(joint.child));
        let is_inertia = |joint: &&&Joint<'t>| {
            let child = self.links.get(joint.child);
            child.is_some_and(|child| !has_no_inertia(*child) && !has_shape(*child))
        };
        if let Some(joint) = fixed.find(is_inertia) {
            self.merged.insert(joint.child);
            // The inertia is the same there.
            let fault = match self.below.contains_key(joint.child) {
                false => Fault::Way("its inertia goes to the link above, to which it is fixed"),
                true => MERGED,
            };
            let at = self.links.get(joint.child).copied().unwrap_or(joint.node);
            effects.drop(at, Part::of("link", joint.child), fault.clone());
            effects.read_as(at, part.inside("inertial"), fault, "that of the link below");
        }
    }

    /// Says which joints and mimics are not written.
    fn joints(&self, joints: &[Joint<'t>], effects: &mut Effects) {
        let is_written =
            |joint: &Joint<'_>| joint.kind != "floating" && self.bodies.contains(joint.child);
        let written: HashSet<&str> =
            joints.iter().filter(|joint| is_written(joint)).map(|joint| joint.name).collect();
        for joint in joints {
            let part = Part::of("joint", joint.name);
            if !is_written(joint) {
                let fault = match joint.kind {
                    "floating" => Fault::Way("a floating joint is written as none"),
                    _ => Fault::Way("the link below the joint is not a body"),
                };
                effects.drop(joint.node, part, fault);
                continue;
            }
            if !self.bodies.contains(joint.parent) {
                let fault = Fault::Way("the link above the joint is not a body");
                effects.read_as(joint.node, part.inside("parent"), fault, "the next body above");
            }
            let Some(mimic) = last(joint.node, "mimic") else { continue };
            let name = mimic.value("joint").unwrap_or_default();
            if !written.contains(name) {
                let fault = Fault::Way("the joint that it follows is not written");
                effects.drop(mimic, part.inside("mimic"), fault);
            }
        }
    }
}

fn has_shape(link: Node<'_>) -> bool {
    link.child("visual").is_some() || link.child("collision").is_some()
}

/// No mass, or one that is not above 0 and no moments either.
fn has_no_inertia(link: Node<'_>) -> bool {
    let number = |node: Node<'_>, name| node.value(name).and_then(python).unwrap_or(0.0);
    let Some(inertial) = last(link, "inertial") else { return true };
    let Some(mass) = last(inertial, "mass") else { return true };
    if number(mass, "value") > 0.0 {
        return false;
    }
    let inertia = last(inertial, "inertia");
    inertia.is_none_or(|inertia| {
        ["ixx", "iyy", "izz"].into_iter().all(|name| number(inertia, name) == 0.0)
    })
}
