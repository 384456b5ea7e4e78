//! A composed scene, its prims and their properties.

use std::collections::HashMap;
use std::slice::Iter;
use std::sync::Arc;

use urdd_directory::account::{Account, AccountError};

use crate::error::UsdError;
use crate::layer::{Name, Value, field};

/// A composed scene.
#[derive(Debug, Default)]
pub struct Stage {
    /// The paths of the layers that were read; the first is the root.
    pub layers: Vec<Name>,
    /// The metadata of the root layer: `defaultPrim`, `metersPerUnit`, `upAxis` and others.
    pub(super) metadata: Vec<(Name, Value)>,
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
    /// The API schemas that it has. Each was charged for some thirty looks at it.
    pub schemas: Vec<Name>,
    /// Other metadata.
    pub(super) fields: Vec<(Name, Value)>,
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
    pub(super) value: Option<Value>,
    pub(super) targets: Vec<Name>,
    pub(super) fields: Vec<(Name, Value)>,
}

/// The characters of a text that are free: more than the longest word of a schema.
const WORD: usize = 64;
/// A value beside its numbers and texts, and a step along a path, as bytes.
const LOOK: usize = 16;

/// A value of a property or field. A stage has it once, and any number of prims may inherit it.
///
/// So an inside that a file can make long is given out by [`Authored::take`] alone, which charges for all of it each time.
/// What is short by its type (a number, so many of them, a word) is free.
#[derive(Debug, Clone, Copy)]
pub struct Authored<'s>(&'s Value);

impl<'s> Authored<'s> {
    /// The value, with all that is in it.
    ///
    /// # Errors
    /// If the account does not have its size.
    pub fn take(self, account: &Account) -> Result<&'s Value, AccountError> {
        account.charge(size(self.0))?;
        Ok(self.0)
    }

    /// The number.
    pub fn number(self) -> Option<f64> {
        self.0.number()
    }

    /// The truth value.
    pub fn bool(self) -> Option<bool> {
        self.0.bool()
    }

    /// `N` numbers: a vector, an array of so many, or one number.
    pub fn numbers<const N: usize>(self) -> Option<[f64; N]> {
        match self.0 {
            Value::Number(number) => [*number].as_slice().try_into().ok(),
            value => value.numbers()?.try_into().ok(),
        }
    }

    /// `N` numbers of a vector.
    pub fn tuple<const N: usize>(self) -> Option<[f64; N]> {
        self.0.tuple()
    }

    /// The number of numbers in a vector or an array.
    pub fn len(self) -> usize {
        self.0.numbers().map_or(0, <[f64]>::len)
    }

    /// Whether there are no numbers in it.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// Where its numbers are in memory: those of instances are at one place.
    pub fn address(self) -> usize {
        self.0.numbers().map_or(0, |numbers| numbers.as_ptr().addr())
    }

    /// A token or string. Of a long one the start, which is no word of a schema.
    pub fn word(self) -> Option<&'s str> {
        let text = self.0.text()?;
        let end = (0..=WORD.min(text.len())).rev().find(|end| text.is_char_boundary(*end))?;
        text.get(..end)
    }
}

/// The bytes of a value, with those of its texts.
fn size(value: &Value) -> usize {
    let texts = |texts: &[Name]| texts.iter().map(|text| LOOK + text.len()).sum();
    LOOK + match value {
        Value::Blocked | Value::Bool(_) | Value::Number(_) => 0,
        Value::Text(text) | Value::Asset(text) | Value::Path(text) | Value::Unread(text) => {
            text.len()
        }
        Value::Tuple(values) | Value::Numbers { values, .. } => size_of_val(&**values),
        Value::Texts(all) => texts(all),
        Value::Dictionary(entries) => {
            entries.iter().map(|(name, value)| name.len() + size(value)).sum()
        }
        Value::List(list) => list.all().map(|item| LOOK + item.text().len()).sum(),
        Value::Samples(sample) => size(&sample.1),
    }
}

/// What a relationship points to, or an attribute is connected to.
#[derive(Debug, Clone, Copy)]
pub struct Targets<'s>(&'s [Name]);

impl<'s> Targets<'s> {
    /// Whether there are none.
    pub fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    /// The first.
    pub fn first(self) -> Option<&'s Name> {
        self.0.first()
    }

    /// All paths.
    ///
    /// # Errors
    /// If the account does not have a look at each.
    pub fn walk(self, account: &Account) -> Result<Iter<'s, Name>, AccountError> {
        account.charge(LOOK * self.0.len())?;
        Ok(self.0.iter())
    }
}

impl Stage {
    /// The prim at a path; of a property, the prim that has it.
    ///
    /// # Errors
    /// If the account does not have the length of the path.
    pub fn find(&self, path: &str, account: &Account) -> Result<Option<usize>, AccountError> {
        let (last, is_there) = self.along(path, account)?;
        Ok(last.filter(|_| is_there))
    }

    /// The last prim along a path that is there.
    ///
    /// # Errors
    /// If the account does not have the length of the path.
    pub fn nearest(&self, path: &str, account: &Account) -> Result<Option<usize>, AccountError> {
        Ok(self.along(path, account)?.0)
    }

    /// The last prim along a path, and whether the path ends at it.
    fn along(&self, path: &str, account: &Account) -> Result<(Option<usize>, bool), AccountError> {
        account.charge(LOOK + path.len())?;
        let path = path.split_once('.').map_or(path, |(prim, _)| prim);
        let Some(path) = path.strip_prefix('/') else { return Ok((None, false)) };
        let mut at = 0;
        for name in path.split('/') {
            account.charge(LOOK)?;
            match self.inside.get(&(at, Arc::from(name))) {
                Some(next) => at = *next,
                None => return Ok(((at as usize).checked_sub(1), false)),
            }
        }
        Ok(((at as usize).checked_sub(1), true))
    }

    /// The path of a prim.
    ///
    /// # Errors
    /// If the account does not have its length.
    pub fn path(&self, prim: usize, account: &Account) -> Result<String, AccountError> {
        let mut names = Vec::new();
        let mut next = Some(prim);
        while let Some(prim) = next.and_then(|at| self.prims.get(at)) {
            account.charge(LOOK + prim.name.len())?;
            names.push(&*prim.name);
            next = prim.parent;
        }
        Ok(names.iter().rev().fold(String::new(), |path, name| path + "/" + name))
    }

    /// Metadata of the root layer.
    pub fn metadata(&self, name: &str) -> Option<Authored<'_>> {
        field(&self.metadata, name).map(Authored)
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
    pub fn value(&self, name: &str) -> Option<Authored<'_>> {
        self.property(name)?.value()
    }

    /// What a relationship points to.
    pub fn targets(&self, name: &str) -> Targets<'_> {
        self.property(name).map_or(Targets(&[]), Property::targets)
    }

    /// Whether an API schema is applied; of several instances, in brackets: `PhysicsLimitAPI:rotX`.
    pub fn has(&self, schema: &str) -> bool {
        self.schemas.iter().any(|applied| **applied == *schema)
    }

    /// Metadata by its name.
    pub fn field(&self, name: &str) -> Option<Authored<'_>> {
        field(&self.fields, name).map(Authored)
    }

    /// The names of its metadata.
    pub fn fields(&self) -> impl Iterator<Item = &Name> {
        self.fields.iter().map(|(name, _)| name)
    }
}

impl Property {
    /// The value, if it is authored.
    pub fn value(&self) -> Option<Authored<'_>> {
        self.value.as_ref().map(Authored)
    }

    /// What it points or is connected to.
    pub fn targets(&self) -> Targets<'_> {
        Targets(&self.targets)
    }

    /// Metadata by its name.
    pub fn field(&self, name: &str) -> Option<Authored<'_>> {
        field(&self.fields, name).map(Authored)
    }
}
