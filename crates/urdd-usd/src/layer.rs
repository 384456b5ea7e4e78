//! A layer: what one file says, as a tree of specs.

use std::collections::HashMap;
use std::sync::Arc;

use super::value::{Name, Value};

/// The deepest nesting of prims. A chain of 2,000 links in each other fits; paths of all prims stay short.
pub const MAX_LEVELS: usize = 4096;

/// The most fields of a prim or property: they are searched one by one. Robots have up to 20.
pub const MAX_FIELDS: usize = 1000;

/// What one file says.
#[derive(Debug)]
pub struct Layer {
    /// Specs; the first is the layer itself.
    pub specs: Vec<Spec>,
    /// The specs inside of others, by name: children by theirs, variants by `{SET=NAME}`.
    pub inside: HashMap<(u32, Name), u32>,
}

/// What a layer says of a prim or of a variant of one.
#[derive(Debug)]
pub struct Spec {
    /// The name.
    pub name: Name,
    /// The nesting: 0 of the layer.
    pub level: u32,
    /// The line, from 1; 0 of crate files.
    pub line: u32,
    /// Metadata: `specifier`, `typeName` and all others.
    pub fields: Vec<(Name, Value)>,
    /// Children, in order.
    pub children: Vec<u32>,
    /// Attributes and relationships.
    pub properties: Vec<PropertySpec>,
}

/// What a layer says of an attribute or relationship.
#[derive(Debug)]
pub struct PropertySpec {
    /// The name.
    pub name: Name,
    /// Whether it is a relationship.
    pub is_relationship: bool,
    /// `default`, `typeName`, `targetPaths`, `connectionPaths` and others.
    pub fields: Vec<(Name, Value)>,
}

/// The value of a field, by its name.
pub fn field<'f>(fields: &'f [(Name, Value)], name: &str) -> Option<&'f Value> {
    fields.iter().find(|(key, _)| **key == *name).map(|(_, value)| value)
}

/// Sets a field; of two edits of one list both count.
pub fn put(fields: &mut Vec<(Name, Value)>, name: Name, value: Value) {
    match fields.iter_mut().find(|(key, _)| *key == name) {
        Some((_, Value::List(known))) => {
            if let Value::List(more) = value {
                *known = Arc::new(known.joined(&more));
            }
        }
        Some(known) => known.1 = value,
        None => fields.push((name, value)),
    }
}

impl Spec {
    fn new(name: Name, level: u32, line: u32) -> Self {
        let (fields, children, properties) = (Vec::new(), Vec::new(), Vec::new());
        Spec { name, level, line, fields, children, properties }
    }
}

impl Layer {
    /// A layer that says nothing.
    pub fn new() -> Self {
        Layer { specs: vec![Spec::new(Name::from(""), 0, 0)], inside: HashMap::new() }
    }

    /// The spec of a child or variant, made if it is not there.
    pub fn make(&mut self, parent: u32, name: &Name, is_child: bool, line: u32) -> u32 {
        let next = self.specs.len() as u32;
        let found = *self.inside.entry((parent, name.clone())).or_insert(next);
        if found == next {
            let level = self.specs[parent as usize].level + 1;
            self.specs.push(Spec::new(name.clone(), level, line));
            if is_child {
                self.specs[parent as usize].children.push(next);
            }
        }
        found
    }

    /// A spec inside of another.
    pub fn child(&self, parent: u32, name: &Name) -> Option<u32> {
        self.inside.get(&(parent, name.clone())).copied()
    }

    /// A field of the layer itself.
    pub fn metadata(&self, name: &str) -> Option<&Value> {
        field(&self.specs[0].fields, name)
    }
}
