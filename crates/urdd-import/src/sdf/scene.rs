//! What files say of a model, before names are looked up: links, joints and frames in scopes.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use nalgebra::{Isometry3, Vector3};

use super::super::model::{Inertial, Shape};
use super::super::place::Place;
use super::super::refusal::Fallible;
use super::tag::Tag;
use urdd_xml::writer::Element;

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

/// A link.
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

/// How a joint moves.
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

/// A joint.
#[derive(Debug)]
pub struct Joint {
    pub node: usize,
    pub kind: SdfJointKind,
    pub parent: String,
    pub axes: Vec<Axis>,
    /// The link from which a gearbox sees its two links turn, if it is said.
    pub reference: Option<String>,
}

/// An axis of a joint.
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
