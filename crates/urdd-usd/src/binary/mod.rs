//! Crate files: versions 0.4 to 0.13.
//!
//! A file has a table of sections: tokens, strings (as tokens), fields (a name and where its value is), sets of fields,
//! paths as a tree, and specs (a path, a set of fields, a kind). Values are anywhere in the file; those that are equal may
//! be one. Older versions, from before 2017, are refused.

mod cursor;
mod lists;
mod sections;
mod values;

use std::collections::HashMap;

use crate::door::Door;
use crate::error::{Fault, Place, Wrong};
use crate::layer::{Layer, MAX_FIELDS, Name, PropertySpec, Value, field};
use cursor::Cursor;
use sections::Crate;

pub use sections::START;

/// Bytes of a spec or property, and of a field, in memory.
const SPEC: usize = 300;
const FIELD: usize = 64;
/// The same of a name in an order of children.
const NAME: usize = 32;

const ATTRIBUTE: i64 = 1;
const PRIM: i64 = 6;
const ROOT: i64 = 7;
const RELATIONSHIP: i64 = 8;
const VARIANT: i64 = 10;

pub fn read(bytes: &[u8], door: &mut dyn Door) -> Result<Layer, Wrong> {
    let mut file = Crate::open(bytes, door)?;
    file.read_paths()?;
    let mut cursor = file.section(b"SPECS")?;
    let count = file.entries(&mut cursor)?;
    let paths = file.integers(&mut cursor, count, false)?;
    let sets = file.integers(&mut cursor, count, false)?;
    let kinds = file.integers(&mut cursor, count, false)?;
    let mut specs = Specs { layer: Layer::new(), of_path: HashMap::new() };
    for ((path, set), kind) in paths.into_iter().zip(sets).zip(kinds) {
        let (path, set) = (path as u32, set as u32);
        match kind {
            ROOT => {
                specs.layer.specs[0].fields = file.field_set(&cursor, set)?;
            }
            PRIM | VARIANT => {
                let spec = specs.spec(&mut file, &cursor, path)?;
                specs.layer.specs[spec as usize].fields = file.field_set(&cursor, set)?;
            }
            ATTRIBUTE | RELATIONSHIP => {
                let Some(node) = file.paths.node(path) else {
                    return Err(cursor.damaged("the path of a property is missing"));
                };
                let (name, owner) = (node.name.clone(), node.parent);
                let is_of_target = owner.is_none_or(|owner| is_deeper(&file, owner));
                // Properties of targets are not for robots.
                if !node.is_property || is_of_target {
                    continue;
                }
                let spec = specs.spec(&mut file, &cursor, owner.unwrap_or_default())?;
                let fields = file.field_set(&cursor, set)?;
                let is_relationship = kind == RELATIONSHIP;
                let all = &mut specs.layer.specs[spec as usize].properties;
                all.push(PropertySpec { name, is_relationship, fields });
            }
            _ => {}
        }
    }
    specs.sort(&mut file, &cursor)?;
    Ok(specs.layer)
}

/// Whether a path is that of a property or a target.
fn is_deeper(file: &Crate<'_>, path: u32) -> bool {
    file.paths.node(path).is_some_and(|node| node.is_property || node.name.starts_with('['))
}

struct Specs {
    layer: Layer,
    of_path: HashMap<u32, u32>,
}

impl Specs {
    /// The spec of a path, with those that it is inside of.
    fn spec(&mut self, file: &mut Crate<'_>, cursor: &Cursor<'_>, path: u32) -> Result<u32, Wrong> {
        let mut missing: Vec<(u32, Name)> = Vec::new();
        let mut next = path;
        let mut spec = loop {
            if let Some(known) = self.of_path.get(&next) {
                break *known;
            }
            let Some(node) = file.paths.node(next) else {
                return Err(cursor.damaged("the path of a prim is missing"));
            };
            let Some(parent) = node.parent else { break 0 };
            missing.push((next, node.name.clone()));
            next = parent;
        };
        for (path, name) in missing.into_iter().rev() {
            file.charge(cursor, SPEC)?;
            spec = self.layer.make(spec, &name, !name.starts_with('{'), 0);
            self.of_path.insert(path, spec);
        }
        Ok(spec)
    }

    /// Puts children in the order that their parents say.
    fn sort(&mut self, file: &mut Crate<'_>, cursor: &Cursor<'_>) -> Result<(), Wrong> {
        for at in 0..self.layer.specs.len() {
            let spec = &self.layer.specs[at];
            if spec.children.len() < 2 {
                continue;
            }
            let order = field(&spec.fields, "primChildren");
            let Some(order) = order.and_then(Value::texts) else { continue };
            file.charge(cursor, NAME * order.len())?;
            let place: HashMap<&Name, usize> =
                order.iter().enumerate().map(|(at, name)| (name, at)).collect();
            let mut children = spec.children.clone();
            children.sort_by_key(|child| {
                place.get(&self.layer.specs[*child as usize].name).copied().unwrap_or(usize::MAX)
            });
            self.layer.specs[at].children = children;
        }
        Ok(())
    }
}

impl Crate<'_> {
    /// The fields of a set, from its first one.
    fn field_set(&mut self, cursor: &Cursor<'_>, set: u32) -> Result<Vec<(Name, Value)>, Wrong> {
        let mut fields = Vec::new();
        let mut at = set as usize;
        loop {
            let Some(index) = self.field_sets.get(at) else {
                return Err(cursor.damaged("a set of fields has no end"));
            };
            if *index == u32::MAX {
                return Ok(fields);
            }
            let Some(&(name, place)) = self.fields.get(*index as usize) else {
                return Err(cursor.damaged("a field is missing"));
            };
            if fields.len() >= MAX_FIELDS {
                return Err((Place::Layer, Fault::Fields(MAX_FIELDS)));
            }
            self.charge(cursor, FIELD)?;
            let name = self.token(cursor, name)?;
            fields.push((name, self.value(place, 0)?));
            at += 1;
        }
    }
}
