//! A composed scene, its prims and their properties.

use std::collections::HashMap;
use std::sync::Arc;

use crate::error::UsdError;
use crate::layer::{Name, Value, field};

/// A composed scene.
#[derive(Debug, Default)]
pub struct Stage {
    /// The paths of the layers that were read; the first is the root.
    pub layers: Vec<Name>,
    /// The metadata of the root layer: `defaultPrim`, `metersPerUnit`, `upAxis` and others.
    pub metadata: Vec<(Name, Value)>,
    /// Prims that are defined and active; each stands before its children, and these in order.
    pub prims: Vec<Prim>,
    /// References and payloads that are not there: the prim that brings them in, or the one above if without them it is
    /// not one; and why.
    pub missing: Vec<(Option<usize>, UsdError)>,
    /// Properties whose value is the first of several by time.
    pub sampled: usize,
    inside: HashMap<(u32, Name), u32>,
}

/// A prim.
#[derive(Debug)]
pub struct Prim {
    /// Its name.
    pub name: Name,
    /// Its parent.
    pub parent: Option<usize>,
    /// Its children.
    pub children: Vec<usize>,
    /// Its type; empty if it has none.
    pub type_name: Name,
    /// The API schemas that it has.
    pub schemas: Vec<Name>,
    /// Other metadata.
    pub fields: Vec<(Name, Value)>,
    /// Attributes and relationships, by name.
    pub properties: Vec<Property>,
    /// Whether its prims may be those of other instances, too.
    pub is_instance: bool,
    /// The layer of the strongest opinion, and the line, or 0.
    pub place: (usize, u32),
}

/// An attribute or relationship.
#[derive(Debug)]
pub struct Property {
    /// Its name.
    pub name: Name,
    /// The type of an attribute, such as `point3f[]`; empty of a relationship.
    pub type_name: Name,
    /// The value, if it is authored.
    pub value: Option<Value>,
    /// What it points or is connected to.
    pub targets: Vec<Name>,
    /// Other metadata.
    pub fields: Vec<(Name, Value)>,
}

impl Stage {
    /// The prim at a path; of a property, the prim that has it.
    pub fn find(&self, path: &str) -> Option<usize> {
        let path = path.split_once('.').map_or(path, |(prim, _)| prim);
        let mut at = 0;
        for name in path.strip_prefix('/')?.split('/') {
            at = *self.inside.get(&(at, Arc::from(name)))?;
        }
        (at as usize).checked_sub(1)
    }

    /// The path of a prim.
    pub fn path(&self, prim: usize) -> String {
        let mut names = Vec::new();
        let mut next = Some(prim);
        while let Some(prim) = next.and_then(|at| self.prims.get(at)) {
            names.push(&*prim.name);
            next = prim.parent;
        }
        names.iter().rev().fold(String::new(), |path, name| path + "/" + name)
    }

    /// Metadata of the root layer.
    pub fn metadata(&self, name: &str) -> Option<&Value> {
        field(&self.metadata, name)
    }

    /// Adds a prim after its parent.
    pub(super) fn push(&mut self, prim: Prim) -> usize {
        let at = self.prims.len();
        let above = prim.parent.map_or(0, |parent| parent as u32 + 1);
        self.inside.insert((above, prim.name.clone()), at as u32 + 1);
        if let Some(parent) = prim.parent {
            self.prims[parent].children.push(at);
        }
        self.prims.push(prim);
        at
    }
}

impl Prim {
    /// A property by its name.
    pub fn property(&self, name: &str) -> Option<&Property> {
        let at = self.properties.binary_search_by(|property| (*property.name).cmp(name)).ok()?;
        Some(&self.properties[at])
    }

    /// The authored value of an attribute.
    pub fn value(&self, name: &str) -> Option<&Value> {
        self.property(name)?.value.as_ref()
    }

    /// What a relationship points to.
    pub fn targets(&self, name: &str) -> &[Name] {
        self.property(name).map_or(&[], |property| &property.targets)
    }

    /// Whether an API schema is applied; of several instances, in brackets: `PhysicsLimitAPI:rotX`.
    pub fn has(&self, schema: &str) -> bool {
        self.schemas.iter().any(|applied| **applied == *schema)
    }

    /// Metadata by its name.
    pub fn field(&self, name: &str) -> Option<&Value> {
        field(&self.fields, name)
    }
}
