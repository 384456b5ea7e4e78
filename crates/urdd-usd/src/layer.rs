//! A layer: what one file says, as a tree of specs, with the values of their fields.

use std::collections::HashMap;
use std::sync::Arc;

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
    pub name: Name,
    /// The nesting: 0 of the layer.
    pub level: u32,
    /// The line, from 1; 0 of crate files.
    pub line: u32,
    /// Metadata: `specifier`, `typeName` and all others.
    pub fields: Vec<(Name, Value)>,
    pub children: Vec<u32>,
    /// Attributes and relationships.
    pub properties: Vec<PropertySpec>,
    /// The steps of one composition of it, once the layer is read: see [`Layer::weigh`].
    pub steps: usize,
}

/// What it costs to look at a spec, at a field and at a property, in steps.
const SPEC: usize = 60;
const FIELD: usize = 5;
const PROPERTY: usize = 20;

/// What a layer says of an attribute or relationship.
#[derive(Debug)]
pub struct PropertySpec {
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
                Arc::make_mut(known).join(Arc::unwrap_or_clone(more));
            }
        }
        Some(known) => known.1 = value,
        None => fields.push((name, value)),
    }
}

impl Spec {
    fn new(name: Name, level: u32, line: u32) -> Self {
        let (fields, children, properties) = (Vec::new(), Vec::new(), Vec::new());
        Spec { name, level, line, fields, children, properties, steps: 0 }
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

    /// Says what a composition of each spec costs: with its fields and properties, and without what is in lists,
    /// dictionaries and children, which are charged where they are looked at.
    pub fn weigh(&mut self) {
        let each = |of: &PropertySpec| PROPERTY + of.name.len() + FIELD * of.fields.len();
        for spec in &mut self.specs {
            let own = SPEC + FIELD * spec.fields.len();
            spec.steps = own + spec.properties.iter().map(each).sum::<usize>();
        }
    }

    /// A field of the layer itself.
    pub fn metadata(&self, name: &str) -> Option<&Value> {
        field(&self.specs[0].fields, name)
    }
}

/// A name or text, shared.
pub type Name = Arc<str>;

/// The deepest nesting of dictionaries and tuples. Robots use three levels.
pub(crate) const MAX_VALUE_LEVELS: usize = 32;

/// A value.
///
/// Numbers of all types are `f64`: those of half and single precision as they are rounded. Components of a quaternion are
/// in the order w, x, y, z; a matrix is row by row, and points are rows: `p' = p M`.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A value that says that there is none: `None`.
    Blocked,
    /// A truth value.
    Bool(bool),
    /// A number.
    Number(f64),
    /// A token or a string.
    Text(Name),
    /// The path of a file. In a stage, relative to the folder of the root layer.
    Asset(Name),
    /// The path of a prim or property.
    Path(Name),
    /// A vector, quaternion or matrix.
    Tuple(Arc<[f64]>),
    /// An array of numbers, or of tuples of some width; truth values are 0 and 1.
    Numbers {
        /// Numbers an entry, at least 1.
        width: usize,
        /// All numbers.
        values: Arc<[f64]>,
    },
    /// An array of texts.
    Texts(Arc<[Name]>),
    /// Named values.
    Dictionary(Arc<[(Name, Value)]>),
    /// A list that edits that of a weaker opinion.
    List(Arc<ListOp>),
    /// Values by time: the first time, and its value.
    Samples(Arc<(f64, Value)>),
    /// A value of a type that is not read, with its type.
    Unread(Name),
}

impl Value {
    /// The number.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The truth value.
    pub fn bool(&self) -> Option<bool> {
        match self {
            Value::Bool(value) => Some(*value),
            Value::Number(number) => Some(*number != 0.0),
            _ => None,
        }
    }

    /// The token, string, or path of a file.
    pub fn text(&self) -> Option<&Name> {
        match self {
            Value::Text(text) | Value::Asset(text) => Some(text),
            _ => None,
        }
    }

    /// The numbers of a vector, a quaternion, a matrix or an array.
    pub fn numbers(&self) -> Option<&[f64]> {
        match self {
            Value::Tuple(values) | Value::Numbers { values, .. } => Some(values),
            _ => None,
        }
    }

    /// `N` numbers of a vector.
    pub fn tuple<const N: usize>(&self) -> Option<[f64; N]> {
        match self {
            Value::Tuple(values) => values.as_ref().try_into().ok(),
            _ => None,
        }
    }

    /// The edit of a list.
    pub(crate) fn list(&self) -> Option<&ListOp> {
        match self {
            Value::List(list) => Some(list),
            _ => None,
        }
    }

    /// The texts of an array.
    pub fn texts(&self) -> Option<&[Name]> {
        match self {
            Value::Texts(texts) => Some(texts),
            _ => None,
        }
    }

    /// An entry of a dictionary.
    pub fn get(&self, name: &str) -> Option<&Value> {
        match self {
            Value::Dictionary(entries) => {
                entries.iter().find(|(key, _)| **key == *name).map(|(_, value)| value)
            }
            _ => None,
        }
    }
}

/// How a list differs from that of a weaker opinion.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ListOp {
    /// The whole list, if weaker ones do not count.
    pub explicit: Option<Vec<Item>>,
    /// What is taken out.
    pub deleted: Vec<Item>,
    /// What is put at the end, unless it is there.
    pub added: Vec<Item>,
    /// What is put at the start.
    pub prepended: Vec<Item>,
    /// What is put at the end.
    pub appended: Vec<Item>,
}

/// An entry of a list.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Item {
    /// A token or a string, or a number in digits.
    Text(Name),
    /// A path.
    Path(Name),
    /// A prim of another layer, or of this one if the file is empty; of its default prim if the path is empty.
    Reference {
        /// The file.
        asset: Name,
        /// The path of a prim.
        path: Name,
    },
}

impl Item {
    /// The text or path; of a reference, the path.
    pub fn text(&self) -> &Name {
        match self {
            Item::Text(text) | Item::Path(text) => text,
            Item::Reference { path, .. } => path,
        }
    }

    /// The bytes of its texts.
    pub(crate) fn len(&self) -> usize {
        match self {
            Item::Text(text) | Item::Path(text) => text.len(),
            Item::Reference { asset, path } => asset.len() + path.len(),
        }
    }
}

impl ListOp {
    /// A list that is there as it is.
    pub fn explicit(items: Vec<Item>) -> Self {
        ListOp { explicit: Some(items), ..ListOp::default() }
    }

    /// Adds an edit of the same list, which stands in a further statement.
    pub(crate) fn join(&mut self, other: ListOp) {
        self.explicit = other.explicit.or(self.explicit.take());
        self.deleted.extend(other.deleted);
        self.added.extend(other.added);
        self.prepended.extend(other.prepended);
        self.appended.extend(other.appended);
    }

    /// All its entries.
    pub(crate) fn all(&self) -> impl Iterator<Item = &Item> {
        let edits = [&self.deleted, &self.added, &self.prepended, &self.appended];
        self.explicit.iter().chain(edits).flatten()
    }

    /// With other entries in place of its own; `None` leaves one out.
    pub(crate) fn map<E>(
        &self,
        mut each: impl FnMut(&Item) -> Result<Option<Item>, E>,
    ) -> Result<ListOp, E> {
        let mut all = |items: &[Item]| -> Result<Vec<Item>, E> {
            items.iter().filter_map(|item| each(item).transpose()).collect()
        };
        Ok(ListOp {
            explicit: self.explicit.as_deref().map(&mut all).transpose()?,
            deleted: all(&self.deleted)?,
            added: all(&self.added)?,
            prepended: all(&self.prepended)?,
            appended: all(&self.appended)?,
        })
    }

    /// Edits the list of the weaker opinions.
    pub(crate) fn apply(&self, list: &mut Vec<Item>) {
        use std::collections::HashSet;
        if let Some(items) = &self.explicit {
            list.clear();
            let mut known = HashSet::new();
            list.extend(items.iter().filter(|item| known.insert(*item)).cloned());
            return;
        }
        let without = |list: &mut Vec<Item>, items: &[Item]| {
            if !items.is_empty() && !list.is_empty() {
                let gone: HashSet<&Item> = items.iter().collect();
                list.retain(|item| !gone.contains(item));
            }
        };
        let unique = |items: &[Item]| {
            let mut known = HashSet::new();
            items.iter().filter(|item| known.insert(*item)).cloned().collect::<Vec<_>>()
        };
        without(list, &self.deleted);
        if !self.added.is_empty() {
            let there: HashSet<Item> = list.iter().cloned().collect();
            list.extend(unique(&self.added).into_iter().filter(|item| !there.contains(item)));
        }
        without(list, &self.prepended);
        list.splice(0..0, unique(&self.prepended));
        without(list, &self.appended);
        list.extend(unique(&self.appended));
    }
}

/// The number that 16 bits are.
pub fn from_half(bits: u16) -> f64 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
    sign * match exponent {
        0 => fraction * 2f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction / 1024.0) * 2f64.powi(exponent - 15),
    }
}

/// The nearest number of half precision; of two, the even one. Of single precision before, as USD has it.
pub fn to_half(value: f64) -> f64 {
    let value = f64::from(value as f32);
    if !value.is_finite() || value == 0.0 {
        return value;
    }
    let exponent = (value.abs().log2().floor() as i32).max(-14);
    let unit = 2f64.powi(exponent - 10);
    let near = (value / unit).round_ties_even() * unit;
    if near.abs() > 65504.0 { f64::INFINITY.copysign(value) } else { near }
}
