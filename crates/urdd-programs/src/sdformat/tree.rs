//! The releases that are told apart, and the links and joints of a robot as libsdformat makes them: fixed joints are left out, and their links become part of
//! the link above; links without mass are left out, with all below.

use urdd_format::short::Short;

use crate::number::Pose;
use crate::prelude::*;
use crate::sdformat::inertia::{Inertia, inertia_of, pose};
use crate::urdfdom::Model;

/// The least mass of a link, kg.
const MIN_MASS: f64 = 1e-6;

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Release {
    /// 12.3.0.
    Twelve,
    /// 14.1 and later. It reads mimics, and what it writes is SDF 1.11, whose names have no `::`. As in 12.7, links and
    /// joints that are merged stay as frames, which need names and a link; and a link without mass that is merged does not
    /// take those below with it.
    Fourteen,
}

impl Release {
    /// A name as it is read.
    pub fn read(self, text: &str) -> &str {
        let text = text.trim_matches(is_space);
        match text {
            _ if self == Release::Fourteen => text,
            _ if text.eq_ignore_ascii_case("true") => "1",
            _ if text.eq_ignore_ascii_case("false") => "0",
            _ => text,
        }
    }

    /// Whether a name is one that SDF keeps for itself.
    pub fn keeps(self, name: &str) -> bool {
        self == Release::Fourteen && name.contains("::")
    }
}

/// A link, and the joint above it.
pub struct Body<'t> {
    pub name: &'t str,
    pub node: Node<'t>,
    /// How many visuals and collisions are read.
    pub kept: [usize; 2],
    pub inertia: Option<Inertia>,
    pub joint: Option<Joint<'t>>,
    /// The link that has its parts: another one, if it is merged.
    pub owner: usize,
    /// Whether it is a link in the end.
    pub is_made: bool,
    children: Vec<usize>,
}

/// The last joint that has a link as its child.
pub struct Joint<'t> {
    pub name: &'t str,
    pub node: Node<'t>,
    pub kind: &'t str,
    parent: usize,
    origin: Pose,
    /// Whether it is left out, if it is not below `world`.
    is_merged: bool,
}

impl Joint<'_> {
    /// Whether SDF does not have its type.
    pub fn has_no_type(&self) -> bool {
        matches!(self.kind, "floating" | "planar")
    }
}

pub struct Tree<'t> {
    pub bodies: Vec<Body<'t>>,
    pub of_name: HashMap<&'t str, usize>,
    /// Where two links without mass become one, if any do.
    pub without_mass: Option<usize>,
    pub release: Release,
}

impl<'t> Tree<'t> {
    pub fn new(model: &Model<'t>, kept_joints: &HashSet<&str>, release: Release) -> Tree<'t> {
        let mut tree =
            Tree { bodies: Vec::new(), of_name: HashMap::new(), without_mass: None, release };
        for (&name, link) in &model.links {
            tree.of_name.insert(name, tree.bodies.len());
            tree.bodies.push(Body {
                name,
                node: link.node,
                kept: link.kept.map(|(count, _)| count),
                inertia: inertia_of(link.node),
                joint: None,
                owner: tree.bodies.len(),
                is_made: false,
                children: Vec::new(),
            });
        }
        for (&name, joint) in &model.joints {
            let ends = [joint.parent, joint.child].map(|link| tree.of_name.get(link).copied());
            let [Some(parent), Some(child)] = ends else { continue };
            tree.bodies[parent].children.push(child);
            tree.bodies[child].joint = Some(Joint {
                name,
                node: joint.node,
                kind: joint.kind,
                parent,
                origin: pose(joint.node).unwrap_or_default(),
                is_merged: joint.kind == "fixed" && !kept_joints.contains(name),
            });
        }
        tree
    }

    /// Merges, leaves out, and tells it.
    pub fn build(&mut self, effects: &mut Effects) -> Reading<()> {
        let Some(root) = self.bodies.iter().position(|body| body.joint.is_none()) else {
            return Ok(());
        };
        let (order, times) = self.reached(root, effects)?;
        self.merge(&order, &times);
        self.make(root, effects)?;
        self.tell(root, &order, effects);
        Ok(())
    }

    /// The links below the root, each after those below it, and by how many joints each is reached.
    fn reached(&self, root: usize, effects: &mut Effects) -> Reading<(Vec<usize>, Vec<usize>)> {
        let mut order = Vec::new();
        let mut times = vec![0; self.bodies.len()];
        let mut is_open = vec![false; self.bodies.len()];
        let mut stack = vec![(root, 0)];
        is_open[root] = true;
        while let Some((body, next)) = stack.pop() {
            let Some(&child) = self.bodies[body].children.get(next) else {
                is_open[body] = false;
                order.push(body);
                continue;
            };
            stack.push((body, next + 1));
            times[child] += 1;
            if is_open[child] {
                let child = &self.bodies[child];
                let at = child.joint.as_ref().map_or(child.node, |joint| joint.node);
                return effects.crash(at, Fault::Tree("the joints form a loop"));
            }
            if times[child] == 1 {
                is_open[child] = true;
                stack.push((child, 0));
            }
        }
        Ok((order, times))
    }

    /// The link that a link is merged into.
    fn merged_into(&self, body: usize) -> Option<usize> {
        let joint = self.bodies[body].joint.as_ref().filter(|joint| joint.is_merged)?;
        (self.bodies[joint.parent].name != "world").then_some(joint.parent)
    }

    fn merge(&mut self, order: &[usize], times: &[usize]) {
        for &body in order {
            let Some(parent) = self.merged_into(body) else { continue };
            let one = &self.bodies[body];
            let (Some(inertia), Some(origin)) =
                (one.inertia, one.joint.as_ref().map(|joint| joint.origin))
            else {
                continue;
            };
            let inertial = one.node.child("inertial").unwrap_or(one.node).start();
            let sum = self.bodies[parent].inertia.get_or_insert_default();
            for _ in 0..times[body].min(2) {
                sum.add(&inertia, &origin);
                if sum.mass == 0.0 {
                    self.without_mass.get_or_insert(inertial);
                }
            }
        }
        for &body in order.iter().rev() {
            if let Some(parent) = self.merged_into(body) {
                self.bodies[body].owner = self.bodies[parent].owner;
            }
        }
    }

    /// The link that spoils the inertia of a link: itself, or the first of those merged into it that has one of no body.
    pub fn spoiler(&self, owner: usize) -> Node<'t> {
        let merged = (0..self.bodies.len()).filter(|body| self.bodies[*body].owner == owner);
        let mut nodes = std::iter::once(owner).chain(merged).map(|body| self.bodies[body].node);
        let spoils = |node: &Node<'t>| inertia_of(*node).is_some_and(|inertia| !inertia.is_valid());
        nodes.find(spoils).unwrap_or(self.bodies[owner].node)
    }

    /// The links that are part of another one, with the joint of each: frames, from 12.7 on.
    pub fn frames(&self) -> impl Iterator<Item = (&Body<'t>, &Joint<'t>)> {
        let is_kept = self.release == Release::Fourteen;
        let all = self.bodies.iter().enumerate().filter(move |_| is_kept);
        let merged = all.filter(|(index, body)| body.owner != *index);
        merged.filter_map(|(_, body)| Some((body, body.joint.as_ref()?)))
    }

    fn has_mass(&self, body: usize) -> bool {
        let body = &self.bodies[body];
        let mass = body.inertia.map_or(0.0, |inertia| inertia.mass);
        let is_some = match self.release {
            Release::Twelve => mass.abs() > MIN_MASS,
            Release::Fourteen => mass > 0.0,
        };
        body.name == "world" || mass.is_nan() || is_some
    }

    /// Whether a link is left out, with all below.
    fn is_left_out(&self, body: usize) -> bool {
        let is_merged = self.bodies[body].joint.as_ref().is_some_and(|joint| joint.is_merged);
        !(self.has_mass(body) || is_merged && self.release == Release::Fourteen)
    }

    /// Makes links from the root down. A link may be reached twice, and is then refused if it is made.
    fn make(&mut self, root: usize, effects: &mut Effects) -> Reading<()> {
        let mut times = vec![0_u8; self.bodies.len()];
        let mut open = vec![root];
        while let Some(body) = open.pop() {
            if times[body] == 2 || self.is_left_out(body) {
                continue;
            }
            times[body] += 1;
            let is_world = body == root && self.bodies[body].name == "world";
            if self.merged_into(body).is_none() && !is_world && self.has_mass(body) {
                let one = &mut self.bodies[body];
                one.is_made = true;
                if times[body] == 2 {
                    return effects
                        .refuse(one.node, Fault::Tree("the link is the child of two joints"));
                }
            }
            open.extend(self.bodies[body].children.iter().rev());
        }
        if !self.bodies.iter().any(|body| body.is_made) {
            let node = self.bodies[root].node;
            return effects.refuse(node.child("inertial").unwrap_or(node), without_mass(node));
        }
        self.joints_of_no_type(effects)?;
        // The last joint of a link may be one in a loop that the root does not reach.
        for joint in
            self.bodies.iter().filter(|body| body.is_made).filter_map(|body| body.joint.as_ref())
        {
            let parent = &self.bodies[joint.parent];
            if parent.name != "world" && !self.bodies[parent.owner].is_made {
                let at = joint.node.child("parent").unwrap_or(joint.node);
                return effects.refuse(at, Fault::Tree("the link above is left out"));
            }
        }
        for (body, joint) in self.frames() {
            if !self.bodies[body.owner].is_made {
                return effects.refuse(joint.node, MASSLESS_WITH_OTHERS);
            }
        }
        Ok(())
    }

    /// SDF has no floating and planar joints, and the pose of the link below is in the frame of such a joint. It is one
    /// if another link has its name.
    fn joints_of_no_type(&self, effects: &mut Effects) -> Reading<()> {
        for body in self.bodies.iter().filter(|body| body.is_made) {
            let Some(joint) = body.joint.as_ref().filter(|joint| joint.has_no_type()) else {
                continue;
            };
            let kind = joint.node.attribute("type");
            let at = kind.map_or(joint.node.start(), |kind| kind.range.start);
            let fault = Fault::value("type", joint.kind);
            let link = self.of_name.get(joint.name).map(|&index| &self.bodies[index]);
            if !link.is_some_and(|link| link.is_made && link.name != body.name) {
                return effects.refuse(at, fault);
            }
            effects.drop(at, Part::of("joint", joint.name), fault);
        }
        Ok(())
    }

    /// Says which links and joints are gone, and why.
    fn tell(&self, root: usize, order: &[usize], effects: &mut Effects) {
        let mut is_reached = vec![false; self.bodies.len()];
        let mut is_gone = vec![false; self.bodies.len()];
        for &index in order.iter().rev() {
            let body = &self.bodies[index];
            is_reached[index] = true;
            if index == root && body.name == "world" {
                let fault = Fault::Way("the link `world` is the world, and not part of a robot");
                // Without anything in it, nothing is lost.
                match body.node.children().next() {
                    None => effects.read_as(body.node, "link/world", fault, "the world"),
                    Some(_) => effects.drop(body.node, "link/world", fault),
                }
                continue;
            }
            let above = body.joint.as_ref().is_some_and(|joint| is_gone[joint.parent]);
            is_gone[index] = above || self.is_left_out(index);
            if self.merged_into(index).is_some() {
                self.tell_merged(index, effects);
            } else if above {
                let fault = Fault::Way("a link above it has no mass, and is left out");
                self.drop_link(index, &fault, effects);
            } else if is_gone[index] {
                self.drop_link(index, &without_mass(body.node), effects);
            }
        }
        for index in (0..self.bodies.len()).filter(|index| !is_reached[*index]) {
            let fault = Fault::Tree("the link is in a loop, which the root does not reach");
            self.drop_link(index, &fault, effects);
        }
    }

    fn drop_link(&self, index: usize, fault: &Fault, effects: &mut Effects) {
        let body = &self.bodies[index];
        effects.drop(body.node, Part::of("link", body.name), fault.clone());
        if let Some(joint) = &body.joint {
            let fault = Fault::Way("the link below is left out");
            effects.drop(joint.node, Part::of("joint", joint.name), fault);
        }
    }

    fn tell_merged(&self, index: usize, effects: &mut Effects) {
        let body = &self.bodies[index];
        let Some(joint) = &body.joint else { return };
        let fault = Fault::Way("a fixed joint is left out, and joins two links to one");
        effects.drop(joint.node, Part::of("joint", joint.name), fault.clone());
        let owner = Short::of(self.bodies[body.owner].name);
        let makes = format!("a part of `{owner}`");
        effects.read_as(body.node, Part::of("link", body.name), fault, makes);
    }
}

/// Why a link has no mass.
fn without_mass(link: Node<'_>) -> Fault {
    match link.child("inertial") {
        None => Fault::MissingElement("inertial"),
        Some(_) => MASSLESS,
    }
}
