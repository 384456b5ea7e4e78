//! Values of fields, of metadata and attributes alike.

use std::sync::Arc;

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
}

impl ListOp {
    /// A list that is there as it is.
    pub fn explicit(items: Vec<Item>) -> Self {
        ListOp { explicit: Some(items), ..ListOp::default() }
    }

    /// Two edits of one list, which stand in two statements.
    pub(crate) fn joined(&self, other: &ListOp) -> ListOp {
        let both = |of: fn(&ListOp) -> &Vec<Item>| [of(self).as_slice(), of(other)].concat();
        ListOp {
            explicit: other.explicit.clone().or_else(|| self.explicit.clone()),
            deleted: both(|list| &list.deleted),
            added: both(|list| &list.added),
            prepended: both(|list| &list.prepended),
            appended: both(|list| &list.appended),
        }
    }

    /// With other entries in place of its own; `None` leaves one out.
    pub(crate) fn map(&self, mut each: impl FnMut(&Item) -> Option<Item>) -> ListOp {
        let mut all = |items: &[Item]| items.iter().filter_map(&mut each).collect::<Vec<_>>();
        ListOp {
            explicit: self.explicit.as_deref().map(&mut all),
            deleted: all(&self.deleted),
            added: all(&self.added),
            prepended: all(&self.prepended),
            appended: all(&self.appended),
        }
    }

    /// Edits the list of the weaker opinions.
    pub fn apply(&self, list: &mut Vec<Item>) {
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
