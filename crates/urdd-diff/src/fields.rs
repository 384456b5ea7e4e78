//! The values of a part, in one flat list: parts are equal if their lists are. Parts of two robots are matched by name.

use std::collections::{HashMap, HashSet, VecDeque};

use urdd_format::diff_report::{PartDifference, Presence, ValueChange};
use urdd_format::urdf::Origin;

#[derive(Debug, Clone)]
struct Field {
    name: String,
    unit: &'static str,
    /// Decides whether two values are equal.
    key: String,
    shown: String,
    /// Its numbers, if it has nothing else: they may be equal within a tolerance.
    numbers: Vec<f64>,
}

/// The values of a part, in order. What is absent has no entry.
#[derive(Debug, Clone, Default)]
pub struct Fields(Vec<Field>);

impl Fields {
    pub fn text(&mut self, name: impl Into<String>, value: Option<&str>) {
        if let Some(value) = value {
            self.keyed(name, value.to_owned(), value.to_owned());
        }
    }

    pub fn number(&mut self, name: impl Into<String>, unit: &'static str, value: Option<f64>) {
        self.numbers(name, unit, value.map(|value| [value]));
    }

    /// Adds a text, which is compared as numbers if each of its words is one.
    pub fn value(&mut self, name: impl Into<String>, text: &str) {
        let words: Option<Vec<f64>> = text
            .split_ascii_whitespace()
            .map(|word| word.parse().ok().filter(|number: &f64| number.is_finite()))
            .collect();
        let numbers = words.unwrap_or_default();
        let shown = if numbers.is_empty() { text.to_owned() } else { self::numbers(&numbers) };
        let (name, key) = (name.into(), shown.clone());
        self.0.push(Field { name, unit: "", key, shown, numbers });
    }

    /// Adds several numbers as one value.
    pub fn numbers<const N: usize>(
        &mut self,
        name: impl Into<String>,
        unit: &'static str,
        value: Option<[f64; N]>,
    ) {
        if let Some(value) = value {
            let (name, key, numbers) = (name.into(), numbers(&value), value.to_vec());
            self.0.push(Field { name, unit, shown: key.clone(), key, numbers });
        }
    }

    /// Adds a value that is compared by another text than the one that people see.
    pub fn keyed(&mut self, name: impl Into<String>, key: String, shown: String) {
        self.0.push(Field { name: name.into(), unit: "", key, shown, numbers: Vec::new() });
    }

    /// Adds the values of a pose as the URDF writes it; what is absent is 0. A quaternion counts where the URDF's version
    /// has any, and then in place of `rpy`.
    pub fn origin(&mut self, prefix: &str, origin: Option<&Origin>, quaternions: bool) {
        let xyz = origin.and_then(|origin| origin.xyz).unwrap_or_default();
        self.numbers(format!("{prefix}xyz"), "m", Some(xyz));
        let quaternion = origin.and_then(|origin| origin.quat_xyzw);
        match quaternion.filter(|_| quaternions) {
            Some(quaternion) => self.numbers(format!("{prefix}quat_xyzw"), "", Some(quaternion)),
            None => {
                let rpy = origin.and_then(|origin| origin.rpy).unwrap_or_default();
                self.numbers(format!("{prefix}rpy"), "rad", Some(rpy));
            }
        }
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn sorted(mut self) -> Self {
        self.0.sort_by(|a, b| a.name.cmp(&b.name));
        self
    }

    /// One text for all values: equal exactly if the values are.
    pub fn key(&self) -> String {
        let fields = self.0.iter();
        let texts = fields.map(|field| format!("{:?}={:?}", field.name, field.key));
        texts.collect::<Vec<_>>().join(";")
    }

    /// The values on one line, for people.
    pub fn summary(&self) -> String {
        let fields = self.0.iter();
        let texts = fields.map(|field| match field.unit {
            "" => format!("{} {}", field.name, field.shown).trim_end().to_owned(),
            unit => format!("{} {} {unit}", field.name, field.shown),
        });
        texts.collect::<Vec<_>>().join(", ")
    }

    /// The value with a name, as people see it.
    pub fn shown(&self, name: &str) -> Option<&str> {
        let field = self.0.iter().find(|field| field.name == name)?;
        Some(&field.shown)
    }
}

impl Field {
    /// Whether two values are equal: numbers if they differ by at most the tolerance.
    fn equals(&self, other: &Field, tolerance: f64) -> bool {
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance;
        self.key == other.key
            || !self.numbers.is_empty()
                && self.numbers.len() == other.numbers.len()
                && self.numbers.iter().zip(&other.numbers).all(is_near)
    }
}

/// The values in which two parts differ: in the order of the first, then those that only the second has. `prefix` goes
/// before their names. Several values of an element (`limit.lower`, `limit.upper`) that only one part has are one value
/// (`limit`).
pub fn compare(prefix: &str, before: &Fields, after: &Fields, tolerance: f64) -> Vec<ValueChange> {
    let (before, after) = (&whole(before, after), &whole(after, before));
    let by_name: HashMap<&str, &Field> = after.0.iter().map(|f| (f.name.as_str(), f)).collect();
    let names: HashSet<&str> = before.0.iter().map(|field| field.name.as_str()).collect();
    let change = |name: &str, before: Option<&Field>, after: Option<&Field>| ValueChange {
        field: format!("{prefix}{name}"),
        before: before.map(|field| field.shown.clone()),
        after: after.map(|field| field.shown.clone()),
        unit: after.or(before).map_or("", |field| field.unit).to_owned(),
    };
    let mut changes = Vec::new();
    for field in &before.0 {
        let other = by_name.get(field.name.as_str()).copied();
        if other.is_none_or(|other| !field.equals(other, tolerance)) {
            changes.push(change(&field.name, Some(field), other));
        }
    }
    let new = after.0.iter().filter(|f| !names.contains(f.name.as_str()));
    changes.extend(new.map(|field| change(&field.name, None, Some(field))));
    changes
}

/// Elements that are one value where only one part has them.
const ELEMENTS: [&str; 6] =
    ["inertial", "limit", "mimic", "safety_controller", "calibration", "material"];

/// The element that a value belongs to, if it is one of [`ELEMENTS`].
fn element(name: &str) -> Option<&str> {
    let (element, _) = name.split_once('.')?;
    ELEMENTS.contains(&element).then_some(element)
}

/// The values, with one for each element that the other part does not have.
fn whole(fields: &Fields, other: &Fields) -> Fields {
    let there: HashSet<&str> = other.0.iter().filter_map(|f| element(&f.name)).collect();
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for name in fields.0.iter().filter_map(|field| element(&field.name)) {
        *counts.entry(name).or_default() += 1;
    }
    let mut whole = Fields::default();
    let mut done: HashSet<&str> = HashSet::new();
    for field in &fields.0 {
        let name = element(&field.name);
        let Some(name) = name.filter(|it| !there.contains(it) && counts.get(it) > Some(&1)) else {
            whole.0.push(field.clone());
            continue;
        };
        if done.insert(name) {
            let mut inside = Fields::default();
            for field in fields.0.iter().filter(|f| element(&f.name) == Some(name)) {
                let short = field.name[name.len() + 1..].to_owned();
                inside.0.push(Field { name: short, ..field.clone() });
            }
            whole.keyed(name, inside.key(), inside.summary());
        }
    }
    whole
}

/// Numbers as one text: each in its shortest form that reads back as the same number; -0 is 0.
pub fn numbers(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(|value| number(*value)).collect();
    texts.join(" ")
}

fn number(value: f64) -> String {
    let size = value.abs();
    match size {
        0.0 => "0".to_owned(),
        _ if (1e-5..1e15).contains(&size) => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// Parts by their names.
pub type Parts = Vec<(String, Fields)>;

/// A part in one robot or both, with its index in each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Matched<'a> {
    pub name: &'a str,
    pub before: Option<usize>,
    pub after: Option<usize>,
}

impl Matched<'_> {
    /// What became of it, if it differs where both have it.
    pub fn presence(&self) -> Presence {
        match (self.before, self.after) {
            (_, None) => Presence::Removed,
            (None, _) => Presence::Added,
            _ => Presence::Changed,
        }
    }

    pub fn both(&self) -> Option<(usize, usize)> {
        self.before.zip(self.after)
    }
}

/// Matches parts by name: those of the first robot in order, then what only the second has. The first part with a name
/// matches the first one, the second the second, and so on: a URDD may have several.
pub fn matched<'a>(before: &[&'a str], after: &[&'a str]) -> Vec<Matched<'a>> {
    let mut places: HashMap<&str, VecDeque<usize>> = HashMap::new();
    for (index, name) in after.iter().enumerate() {
        places.entry(name).or_default().push_back(index);
    }
    let mut taken = vec![false; after.len()];
    let mut found = Vec::with_capacity(before.len());
    for (index, name) in before.iter().enumerate() {
        let other = places.get_mut(name).and_then(|places| places.pop_front());
        if let Some(other) = other {
            taken[other] = true;
        }
        found.push(Matched { name, before: Some(index), after: other });
    }
    let new = after.iter().enumerate().filter(|(index, _)| !taken[*index]);
    found.extend(new.map(|(index, name)| Matched { name, before: None, after: Some(index) }));
    found
}

pub fn differences(
    before: &[(String, Fields)],
    after: &[(String, Fields)],
    tolerance: f64,
) -> Vec<PartDifference> {
    let a: Vec<&str> = before.iter().map(|(name, _)| name.as_str()).collect();
    let b: Vec<&str> = after.iter().map(|(name, _)| name.as_str()).collect();
    let mut found = Vec::new();
    for part in matched(&a, &b) {
        let (name, presence) = (part.name.to_owned(), part.presence());
        let changes = part.both().map(|(i, j)| compare("", &before[i].1, &after[j].1, tolerance));
        if changes.as_ref().is_none_or(|changes| !changes.is_empty()) {
            found.push(PartDifference { name, presence, changes: changes.unwrap_or_default() });
        }
    }
    found
}
