//! What files say of a model: links, joints and frames in scopes; then, with names looked up, where the frames are, and which
//! link each moves with.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use nalgebra::{Isometry3, Vector3};
use urdd_xml::writer::Element;

use super::tag::Tag;
use crate::fault::SdfFault;
use crate::model::{Inertial, Shape};
use crate::place::{Fallible, Place, at};

/// The name of the world, as the parent of a joint.
pub const WORLD: &str = "world";

/// A model with all that is nested in it.
#[derive(Debug, Default)]
pub struct Scene {
    pub scopes: Vec<Scope>,
    /// The names of each table of a scope, with their nodes.
    pub tables: Vec<BTreeMap<String, usize>>,
    pub nodes: Vec<Node>,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
    /// The nodes of `<frame>`s.
    pub frames: Vec<usize>,
}

/// What names inside one `<model>` mean.
#[derive(Debug)]
pub struct Scope {
    /// The name of the model, with those that it is nested in.
    pub name: String,
    /// What is put before the names in it: empty, or `A/`. Programs refuse `A::`, or take it for a scope of their own.
    pub prefix: String,
    /// The index of its table; a merged model shares that of its parent.
    pub table: usize,
    /// The node of the model's frame.
    pub model: usize,
    /// The link that the model says its frame is attached to.
    pub canonical: Option<String>,
    /// The scope that it is merged into.
    pub merged_into: Option<usize>,
    pub first_link: Option<usize>,
    pub first_model: Option<usize>,
}

/// Something with a frame.
#[derive(Debug)]
pub struct Node {
    /// The name, with the models that it is in.
    pub name: String,
    pub kind: NodeKind,
    /// The scope in which the names below are looked up.
    pub scope: usize,
    pub pose: Isometry3<f64>,
    pub relative_to: Option<String>,
    /// What a frame is attached to; the child of a joint.
    pub attached_to: Option<String>,
    /// The frame inside a model that is put at its pose.
    pub placement: Option<String>,
    pub place: Place,
}

impl Node {
    /// What a tag says of its frame; it is attached to nothing.
    pub fn of(tag: Tag, name: String, kind: NodeKind, scope: usize) -> Fallible<Self> {
        let (pose, relative_to) = tag.pose()?;
        let (attached_to, placement, place) = (None, None, tag.place());
        Ok(Node { name, kind, scope, pose, relative_to, attached_to, placement, place })
    }
}

/// What a node is, by its index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeKind {
    Link(usize),
    Joint(usize),
    Frame,
    /// The scope inside.
    Model(usize),
}

#[derive(Debug)]
pub struct Link {
    pub node: usize,
    pub inertial: Inertial,
    pub shapes: Vec<Placeable>,
}

/// A shape, and the frame that its pose is relative to, if that is not the link's.
#[derive(Debug)]
pub struct Placeable {
    pub shape: Shape,
    pub relative_to: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SdfJointKind {
    Fixed,
    Hinge,
    Continuous,
    Slide,
    Ball,
    /// Two hinges: `revolute2` and `universal`.
    Two,
    /// The length that it moves for each revolution.
    Screw(f64),
    /// How far the child turns back for what the parent turns, seen from another link.
    Gearbox(f64),
}

#[derive(Debug)]
pub struct Joint {
    pub node: usize,
    pub kind: SdfJointKind,
    pub parent: String,
    pub axes: Vec<Axis>,
    /// The link from which a gearbox sees its two links turn, if it is said.
    pub reference: Option<String>,
}

#[derive(Debug)]
pub struct Axis {
    pub xyz: Vector3<f64>,
    pub expressed_in: Option<String>,
    pub range: [f64; 2],
    pub effort: Option<f64>,
    pub velocity: Option<f64>,
    pub damping: f64,
    pub friction: f64,
    pub mimic: Option<Mimic>,
    pub place: Place,
}

/// `value = multiplier × (leader − reference) + offset`.
#[derive(Debug)]
pub struct Mimic {
    pub joint: String,
    /// Whether it follows the second axis.
    pub is_second: bool,
    pub multiplier: f64,
    pub offset: f64,
    pub reference: f64,
    pub place: Place,
}

impl Scene {
    /// Adds a node under a name of its scope. False if the scope has another of its kind with that name.
    ///
    /// Before SDF 1.7, things of different kinds could share a name. It means the link then, or else the first.
    pub fn add(&mut self, scope: usize, name: &str, node: Node) -> bool {
        let index = self.nodes.len();
        let kind = node.kind;
        self.nodes.push(node);
        match self.tables[self.scopes[scope].table].entry(name.to_owned()) {
            Entry::Vacant(free) => {
                free.insert(index);
            }
            Entry::Occupied(mut taken) => {
                let other = self.nodes[*taken.get()].kind;
                if std::mem::discriminant(&other) == std::mem::discriminant(&kind) {
                    return false;
                }
                if matches!(kind, NodeKind::Link(_)) {
                    taken.insert(index);
                }
            }
        }
        let mut into = Some(scope);
        while let Some(at) = into {
            let scope = &mut self.scopes[at];
            match kind {
                NodeKind::Link(_) => scope.first_link.get_or_insert(index),
                NodeKind::Model(_) => scope.first_model.get_or_insert(index),
                NodeKind::Joint(_) | NodeKind::Frame => break,
            };
            into = scope.merged_into;
        }
        true
    }

    /// The node that a name means in a scope.
    pub fn find(&self, scope: usize, name: &str) -> Option<usize> {
        let (mut scope, mut name) = (self.scopes.get(scope)?, name);
        loop {
            if name == "__model__" {
                return Some(scope.model);
            }
            if let Some(node) = self.tables[scope.table].get(name) {
                return Some(*node);
            }
            let (model, rest) = name.split_once("::")?;
            let node = *self.tables[scope.table].get(model)?;
            let NodeKind::Model(inside) = self.nodes[node].kind else { return None };
            (scope, name) = (&self.scopes[inside], rest);
        }
    }
}

/// An element whose pose refers to another frame than that of its link or joint.
pub struct Posed {
    pub element: Element,
    pub owner: String,
    pub node: usize,
    pub pose: (Isometry3<f64>, String),
    pub place: Place,
}

#[derive(Debug)]
pub struct Frames {
    /// The pose of each node in the frame of the model.
    pub poses: Vec<Isometry3<f64>>,
    /// The link that each node moves with; `None` of a model without links.
    pub links: Vec<Option<usize>>,
}

impl Frames {
    /// Resolves the names of a scene, whose first node is the model's.
    ///
    /// # Errors
    /// If a name has no meaning, or frames refer to each other in a circle.
    pub fn of(scene: &Scene) -> Fallible<Self> {
        let attached = attached(scene)?;
        let bases = bases(scene, &attached)?;
        Ok(Frames { poses: poses(scene, &bases)?, links: links(scene, &attached)? })
    }

    /// The node that a name means, in the scope of another node.
    pub fn named(scene: &Scene, node: usize, element: &str, name: &str) -> Fallible<usize> {
        let (scope, place) = (scene.nodes[node].scope, scene.nodes[node].place);
        match scene.find(scope, name) {
            Some(found) => Ok(found),
            None => {
                let model = scene.scopes[scope].name.clone();
                let (element, name) = (element.to_owned(), name.to_owned());
                Err(at(place, SdfFault::Unknown { element, name, model }))
            }
        }
    }

    /// The pose of a node in the frame of another.
    pub fn relative(&self, node: usize, to: usize) -> Isometry3<f64> {
        snapped(self.poses[to].inv_mul(&self.poses[node]))
    }
}

/// Poses that differ from none by rounding alone are none.
pub fn snapped(pose: Isometry3<f64>) -> Isometry3<f64> {
    const ROUNDING: f64 = 1e-14;
    let mut snapped = pose;
    if pose.rotation.vector().amax() < ROUNDING {
        snapped.rotation = nalgebra::UnitQuaternion::identity();
    }
    if pose.translation.vector.amax() < ROUNDING {
        snapped.translation = nalgebra::Translation3::identity();
    }
    snapped
}

/// What each node is attached to: for a model, the link or model that holds its frame.
fn attached(scene: &Scene) -> Fallible<Vec<Option<usize>>> {
    let each = scene.nodes.iter().enumerate().map(|(index, node)| match node.kind {
        NodeKind::Link(_) => Ok(None),
        NodeKind::Joint(_) => {
            let child = node.attached_to.as_deref().unwrap_or_default();
            Frames::named(scene, index, "child", child).map(Some)
        }
        NodeKind::Frame => match &node.attached_to {
            Some(name) => Frames::named(scene, index, "attached_to", name).map(Some),
            None => Ok(Some(scene.scopes[node.scope].model)),
        },
        NodeKind::Model(inside) => {
            let scope = &scene.scopes[inside];
            let named = scope.canonical.as_deref().and_then(|name| scene.find(inside, name));
            Ok(named.or(scope.first_link).or(scope.first_model))
        }
    });
    each.collect()
}

/// The node that the pose of each is relative to.
fn bases(scene: &Scene, attached: &[Option<usize>]) -> Fallible<Vec<Option<usize>>> {
    let each = scene.nodes.iter().enumerate().map(|(index, node)| {
        if index == 0 {
            return Ok(None);
        }
        if let Some(name) = &node.relative_to {
            return Frames::named(scene, index, "relative_to", name).map(Some);
        }
        Ok(match node.kind {
            NodeKind::Joint(_) => attached[index],
            NodeKind::Frame if node.attached_to.is_some() => attached[index],
            _ => Some(scene.scopes[node.scope].model),
        })
    });
    each.collect()
}

fn circle<T>(scene: &Scene, node: usize) -> Fallible<T> {
    let node = &scene.nodes[node];
    Err(at(node.place, SdfFault::Circle(node.name.clone())))
}

/// A node and those before it up to the first of which something is known, and what that is.
fn chain<T: Copy>(
    scene: &Scene,
    node: usize,
    before: &[Option<usize>],
    known: &[Option<T>],
) -> Fallible<(Vec<usize>, Option<T>)> {
    let (mut chain, mut at) = (Vec::new(), Some(node));
    while let Some(open) = at.filter(|at| known[*at].is_none()) {
        chain.push(open);
        if chain.len() > scene.nodes.len() {
            return circle(scene, node);
        }
        at = before[open];
    }
    Ok((chain, at.and_then(|at| known[at])))
}

fn poses(scene: &Scene, bases: &[Option<usize>]) -> Fallible<Vec<Isometry3<f64>>> {
    let mut own: Vec<Isometry3<f64>> = scene.nodes.iter().map(|node| node.pose).collect();
    own[0] = Isometry3::identity();
    // Models are made before what is in them: the innermost first.
    for model in (1..scene.nodes.len()).rev() {
        let NodeKind::Model(inside) = scene.nodes[model].kind else { continue };
        let Some(name) = &scene.nodes[model].placement else { continue };
        let Some(placed) = scene.find(inside, name) else {
            let (element, name) = ("placement_frame".to_owned(), name.clone());
            let unknown =
                SdfFault::Unknown { element, name, model: scene.nodes[model].name.clone() };
            return Err(at(scene.nodes[model].place, unknown));
        };
        let (mut pose, mut at, mut steps) = (Isometry3::identity(), placed, 0);
        while at != model {
            pose = own[at] * pose;
            steps += 1;
            match bases[at].filter(|_| steps <= scene.nodes.len()) {
                Some(base) => at = base,
                None => return circle(scene, model),
            }
        }
        own[model] *= pose.inverse();
    }
    let mut poses: Vec<Option<Isometry3<f64>>> = vec![None; scene.nodes.len()];
    for node in 0..scene.nodes.len() {
        let (chain, known) = chain(scene, node, bases, &poses)?;
        let mut pose = known.unwrap_or_default();
        for open in chain.into_iter().rev() {
            pose *= own[open];
            poses[open] = Some(pose);
        }
    }
    Ok(poses.into_iter().map(Option::unwrap_or_default).collect())
}

/// The link at the end of what each node is attached to.
fn links(scene: &Scene, attached: &[Option<usize>]) -> Fallible<Vec<Option<usize>>> {
    let mut links: Vec<Option<Option<usize>>> = vec![None; scene.nodes.len()];
    for node in 0..scene.nodes.len() {
        let (chain, known) = chain(scene, node, attached, &links)?;
        let last = chain.last().map(|last| scene.nodes[*last].kind);
        let link = known.unwrap_or(match last {
            Some(NodeKind::Link(link)) => Some(link),
            _ => None,
        });
        for open in chain {
            links[open] = Some(link);
        }
    }
    Ok(links.into_iter().map(Option::unwrap_or_default).collect())
}
