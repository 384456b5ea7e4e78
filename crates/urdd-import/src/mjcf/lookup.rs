//! Bodies, joints and shapes by name.

use std::collections::HashMap;

use urdd_directory::account::Account;

use super::super::refusal::{Fallible, Placing};
use super::body::Bodies;
use super::element::Element;
use super::reading::unknown;

/// Bodies, joints and shapes by name.
pub struct Lookup<'b> {
    bodies: HashMap<&'b str, usize>,
    /// By body and place in it.
    joints: HashMap<&'b str, (usize, usize)>,
    geoms: HashMap<&'b str, (usize, usize)>,
    suffixes: &'b HashMap<String, Vec<String>>,
    account: &'b Account,
}

/// What an element costs for each replica of what it names, beside the names.
const REPLICA: usize = 200;

impl<'b> Lookup<'b> {
    /// The names of a model.
    pub fn of(bodies: &'b Bodies<'_>, account: &'b Account) -> Self {
        let mut lookup = Lookup {
            bodies: HashMap::from([("world", super::body::WORLD)]),
            joints: HashMap::new(),
            geoms: HashMap::new(),
            suffixes: &bodies.suffixes,
            account,
        };
        for (index, body) in bodies.all.iter().enumerate() {
            lookup.bodies.extend(body.name.as_deref().map(|name| (name, index)));
            let joints = body.joints.iter().enumerate().filter(|(_, of)| !of.name.is_empty());
            lookup.joints.extend(joints.map(|(at, of)| (of.name.as_str(), (index, at))));
            let geoms = body.geoms.iter().enumerate();
            lookup
                .geoms
                .extend(geoms.filter_map(|(at, of)| Some((of.name.as_deref()?, (index, at)))));
        }
        lookup
    }

    /// What is put behind the names that an element says, once for each replica of what it names.
    pub fn replicas(&self, element: &Element, names: &[Option<&str>]) -> Fallible<&'b [String]> {
        const ITSELF: &[String] = &[String::new()];
        let is_known = |name: &str| {
            self.joints.contains_key(name)
                || self.bodies.contains_key(name)
                || self.geoms.contains_key(name)
        };
        let mut replicated = names.iter().flatten().filter(|name| !is_known(name));
        let suffixes = replicated.find_map(|name| self.suffixes.get(*name));
        let suffixes = suffixes.map_or(ITSELF, Vec::as_slice);
        let each = REPLICA + names.iter().flatten().map(|name| name.len()).sum::<usize>();
        self.account.charge(suffixes.len().saturating_mul(each)).at(element.place)?;
        Ok(suffixes)
    }

    /// Charges work for an element.
    pub fn charge(&self, element: &Element, work: usize) -> Fallible<()> {
        self.account.charge(work).at(element.place)
    }

    /// The joint that an element names.
    pub fn joint(&self, element: &Element, name: &str, suffix: &str) -> Fallible<(usize, usize)> {
        found(&self.joints, element, "joint", name, suffix)
    }

    /// The body that an element names.
    pub fn body(&self, element: &Element, name: &str, suffix: &str) -> Fallible<usize> {
        found(&self.bodies, element, "body", name, suffix)
    }

    /// The shape that an element names.
    pub fn geom(&self, element: &Element, name: &str, suffix: &str) -> Fallible<(usize, usize)> {
        found(&self.geoms, element, "geom", name, suffix)
    }
}

fn found<T: Copy>(
    named: &HashMap<&str, T>,
    element: &Element,
    what: &'static str,
    name: &str,
    suffix: &str,
) -> Fallible<T> {
    let replica = match suffix {
        "" => None,
        suffix => named.get(format!("{name}{suffix}").as_str()),
    };
    replica.or_else(|| named.get(name)).copied().ok_or_else(|| unknown(element, what, name))
}
