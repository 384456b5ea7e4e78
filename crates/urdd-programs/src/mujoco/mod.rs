//! MuJoCo 4.0.0 and 3.3.7: `MjModel.from_xml_path`. It loads a file or refuses it whole, drops visuals without reading
//! them, fixes the base to the world, and fuses links that do not move into the body above.

mod joint;
mod link;
mod reader;

use crate::number::Pose;
use crate::prelude::*;
use joint::Joint;
use reader::{Body, LEAST, LEAST_EIGENVALUE, MujocoReader, Release, Settings};

pub const FOUR: About = About {
    id: "mujoco",
    name: "MuJoCo 4",
    family: "MuJoCo",
    version: "4.0.0",
    settings: &[],
    is_asked: true,
    is_for: None,
    names: Names::Exact,
    never: &[NEVER_READ, FURTHER],
    read: |file, effects| read(file, effects, Release::Four),
};

pub const THREE: About = About {
    id: "mujoco33",
    name: "MuJoCo 3.3",
    version: "3.3.7",
    settings: &["mujoco3.3"],
    is_asked: false,
    never: &[NEVER_READ, FURTHER, "mimic"],
    read: |file, effects| read(file, effects, Release::Three),
    ..FOUR
};

/// Only visuals can lose a shape, as a collision without one is refused.
const NEVER_READ: &str = "safety_controller calibration velocity version quat_xyzw texture visual material color \
    geometry box cylinder sphere capsule mesh";

struct Link<'t> {
    node: Node<'t>,
    name: &'t str,
    /// The joint above it: which of all, and its element.
    above: Option<(usize, Node<'t>)>,
    parent: Option<usize>,
    children: Vec<usize>,
}

fn read(file: &File, effects: &mut Effects, release: Release) -> Reading<()> {
    let tree = effects.parsed(file.document.within(tinyxml::MAX_DEPTH))?;
    let root = tree.tops().next();
    let is_mjcf = |root: &Node<'_>| root.name().eq_ignore_ascii_case("mujoco");
    if root.as_ref().is_some_and(|root| is_mjcf(root) && root.child("link").is_none()) {
        return Ok(());
    }
    let Some(robot) = root.filter(|root| root.name().eq_ignore_ascii_case("robot")) else {
        return effects.refuse(root.map_or(0, Node::start), Fault::NotRobot);
    };
    let settings = Settings::default();
    let mut reader = MujocoReader { release, file, effects, settings, geoms: HashSet::new() };
    reader.robot(robot)
}

impl MujocoReader<'_> {
    fn robot(&mut self, robot: Node<'_>) -> Reading<()> {
        self.readable(robot, "robot", robot.value("name").unwrap_or_default());
        self.settings(robot)?;
        self.materials(robot);
        let mut links = self.links(robot)?;
        // Links and joints are read one by one, whatever they are together.
        let _ = self.tree(robot, &mut links);
        let bodies: Vec<Option<Body>> =
            links.iter().map(|link| self.link(link.node, link.name).ok()).collect();
        let mut names = HashSet::new();
        let joints: Vec<Option<Joint<'_>>> =
            robot.named("joint").map(|node| self.joint(node, &mut names).ok()).collect();
        self.effects.are_read(0)?;
        let (bodies, joints) = (bodies.into_iter().flatten(), joints.into_iter().flatten());
        let (bodies, joints): (Vec<Body>, Vec<Joint<'_>>) = (bodies.collect(), joints.collect());
        self.mimics(&joints);
        self.bodies(&links, &bodies, &joints);
        self.effects.are_read(0)
    }

    /// Materials, wherever they are; of each name the first that has a colour.
    fn materials(&mut self, robot: Node<'_>) {
        let mut known = HashSet::new();
        let mut open = vec![robot];
        while let Some(node) = open.pop() {
            if let Some(name) =
                node.value("name").filter(|name| node.name() == "material" && !known.contains(name))
                && let Ok(Some(color)) = self.only(node, "color")
            {
                let _ = self.color(color);
                known.insert(name);
            }
            let before = open.len();
            open.extend(node.children());
            open[before..].reverse();
        }
    }

    fn links<'t>(&mut self, robot: Node<'t>) -> Reading<Vec<Link<'t>>> {
        let mut names = HashSet::new();
        let mut links = Vec::new();
        for node in robot.named("link") {
            let name = self.text(node, "name")?;
            if !names.insert(name) {
                return self.effects.refuse(node, Fault::not_unique("link", name));
            }
            self.readable(node, "link", name);
            links.push(Link { node, name, above: None, parent: None, children: Vec::new() });
        }
        Ok(links)
    }

    /// Says of a name whether Python can read it.
    fn readable(&mut self, node: Node<'_>, kind: &'static str, name: &str) {
        if name.contains('\u{fffd}') && std::str::from_utf8(self.file.bytes).is_err() {
            let fault = Fault::name(kind, name, "it is not UTF-8: Python cannot list names");
            self.effects.read_as(node, "robot/?", fault, "names that Python cannot read");
        }
    }

    fn tree<'t>(&mut self, robot: Node<'t>, links: &mut [Link<'t>]) -> Reading<()> {
        let index: HashMap<&str, usize> =
            links.iter().enumerate().map(|(index, link)| (link.name, index)).collect();
        for (number, joint) in robot.named("joint").enumerate() {
            let mut ends = [0; 2];
            for (name, end) in ["parent", "child"].into_iter().zip(&mut ends) {
                let node = self.needed(joint, name)?;
                let link = self.text(node, "link")?;
                *end = match index.get(link) {
                    Some(&link) => link,
                    None => return self.effects.refuse(node, Fault::unknown("link", link)),
                };
            }
            let [parent, child] = ends;
            if links[child].above.is_some() {
                return self.effects.refuse(joint, TWO_PARENTS);
            }
            (links[child].above, links[child].parent) = (Some((number, joint)), Some(parent));
            links[parent].children.push(child);
        }
        let reached = order(links);
        if reached.len() == links.len() {
            return Ok(());
        }
        let reached: HashSet<usize> = reached.into_iter().collect();
        let looped = (0..links.len()).find(|link| !reached.contains(link));
        let at = looped.and_then(|link| links[link].above).map_or(robot, |(_, joint)| joint);
        self.effects.refuse(at, Fault::Tree("the joints make a loop"))
    }

    /// What is asked of bodies when all are known.
    fn bodies(&mut self, links: &[Link<'_>], bodies: &[Body], joints: &[Joint<'_>]) {
        let moving = |link: &Link<'_>| {
            link.above.and_then(|(joint, _)| joints.get(joint)).filter(|joint| joint.moves())
        };
        let mut is_static = vec![false; links.len()];
        for index in order(links) {
            let link = &links[index];
            let on_static = link.parent.is_none_or(|parent| is_static[parent]);
            let Some(joint) = moving(link) else {
                is_static[index] = link.name == "world" || on_static;
                self.unmoved(link, is_static[index]);
                self.finite_inertial(link, is_static[index]);
                continue;
            };
            if link.name == "world" {
                self.effects.refuse_mendable(joint.node, Fault::world());
            }
            if joint.kind == "floating" && !on_static {
                let fault = Fault::Tree("a floating joint is below a joint that moves");
                self.effects.refuse_mendable(joint.node, fault);
            }
            self.finite_inertial(link, false);
            let inertial = link.node.child("inertial").unwrap_or(link.node);
            let Ok(sum) = self.fused(index, inertial, links, bodies, joints) else { continue };
            if link::is_light(&sum) {
                let fault = Fault::Inertia("a link that a joint moves has no mass, or no inertia");
                self.effects.refuse_mendable(inertial, fault);
            }
        }
    }

    /// A link that no joint moves.
    fn unmoved(&mut self, link: &Link<'_>, is_static: bool) {
        if link.name == "world" {
            let fault = Fault::Way("`world` is MuJoCo's own world");
            self.effects.read_as(link.node, "link/world", fault, "the world");
        } else if let Some(inertial) = link.node.child("inertial").filter(|_| is_static) {
            let fault = Fault::Way("a link that no joint moves is a part of the world");
            self.effects.drop(inertial, Part::of("link", link.name).inside("inertial"), fault);
        }
        if let Some((_, joint)) = link.above.filter(|_| !self.settings.keeps_fixed) {
            let part = Part::of("joint", joint.value("name").unwrap_or_default());
            let fault = Fault::Way("links that are fixed to each other become one body");
            self.effects.read_as(joint, part, fault, "one body");
        }
    }

    fn finite_inertial(&mut self, link: &Link<'_>, is_static: bool) {
        let Some(inertial) = link.node.child("inertial").filter(|_| !is_static) else { return };
        for (name, attributes) in [("origin", &["xyz", "rpy"][..]), ("mass", &["value"])] {
            if let Some(node) = inertial.child(name) {
                self.finite(node, attributes);
            }
        }
    }

    /// A body with all that is fixed to it.
    fn fused(
        &mut self,
        index: usize,
        inertial: Node<'_>,
        links: &[Link<'_>],
        bodies: &[Body],
        joints: &[Joint<'_>],
    ) -> Reading<Body> {
        let mut sum = bodies[index].clone();
        let mut open = vec![(index, Pose::default())];
        while let Some((index, at)) = open.pop() {
            for &child in links[index].children.iter().rev() {
                let joint = links[child].above.and_then(|(joint, _)| joints.get(joint));
                let Some(joint) = joint.filter(|joint| !joint.moves()) else { continue };
                let at = at.then(&joint.pose);
                open.push((child, at));
                if bodies[child].mass >= LEAST {
                    sum = sum.with(&bodies[child].placed(&at), self.release.epsilon());
                    if sum.moments[2] < LEAST_EIGENVALUE {
                        let why = "masses that are fixed together have no inertia about a line";
                        return self.effects.refuse(inertial, Fault::Inertia(why));
                    }
                }
            }
        }
        Ok(sum)
    }
}

/// Links from the roots downwards.
fn order(links: &[Link<'_>]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..links.len()).filter(|&link| links[link].parent.is_none()).collect();
    let mut at = 0;
    while let Some(&link) = order.get(at) {
        order.extend(&links[link].children);
        at += 1;
    }
    order
}
