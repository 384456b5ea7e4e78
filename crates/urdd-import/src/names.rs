//! Unique names for what has none.

use std::collections::{HashMap, HashSet};

use super::model::{Material, Model};
use urdd_directory::account::{Account, Overdrawn};
use urdd_xml::number::numbers;

/// What a name costs beside its bytes.
const NAME: usize = 100;
/// Copies of a name until it is in a model: here, in a list and in a table.
const COPIES: usize = 4;

/// The names that are taken. Each is charged: names that are made of others may grow.
#[derive(Debug)]
pub struct Names {
    account: Account,
    taken: HashSet<String>,
    /// The last number that was tried, by name.
    last: HashMap<String, usize>,
}

impl Names {
    /// None is taken.
    pub fn new(account: &Account) -> Self {
        Names { account: account.clone(), taken: HashSet::new(), last: HashMap::new() }
    }

    /// Takes a name; `false` if it was taken.
    pub fn take(&mut self, name: &str) -> Result<bool, Overdrawn> {
        self.account.charge(NAME + COPIES * name.len())?;
        Ok(self.taken.insert(name.to_owned()))
    }

    /// The first free of `wanted`, `wanted_2`, `wanted_3` and so on.
    pub fn free(&mut self, wanted: &str) -> Result<String, Overdrawn> {
        let mut name = wanted.to_owned();
        while !self.take(&name)? {
            let number = self.last.entry(wanted.to_owned()).or_insert(1);
            *number += 1;
            name = format!("{wanted}_{number}");
        }
        Ok(name)
    }
}

/// What was named so far.
#[derive(Debug)]
pub struct Titles {
    visuals: Names,
    collisions: Names,
    materials: Names,
    /// The names of materials, by what they are.
    known: HashMap<String, String>,
}

impl Titles {
    /// Nothing was named.
    pub fn new(account: &Account) -> Self {
        let [visuals, collisions, materials] = std::array::from_fn(|_| Names::new(account));
        Titles { visuals, collisions, materials, known: HashMap::new() }
    }

    /// The name of a shape of a link: its own, or with the link's if another shape of the robot has it.
    pub fn shape(&mut self, is_visual: bool, link: &str, name: &str) -> Result<String, Overdrawn> {
        let names = if is_visual { &mut self.visuals } else { &mut self.collisions };
        if names.take(name)? { Ok(name.to_owned()) } else { names.free(&format!("{link}/{name}")) }
    }

    /// The name of a material: the same for what is the same.
    pub fn material(&mut self, model: &Model, of: &Material) -> Result<String, Overdrawn> {
        let texture = of.texture.and_then(|texture| model.assets.get(texture));
        let texture = texture.map_or("", |file| &file.path);
        let name = match (&of.name, of.rgba) {
            (Some(name), _) => name.clone(),
            (None, Some(rgba)) => format!("rgba {}", numbers(&rgba)),
            (None, None) => texture.to_owned(),
        };
        let key = format!("{name}\n{:?}\n{texture}", of.rgba);
        if let Some(known) = self.known.get(&key) {
            return Ok(known.clone());
        }
        let name = self.materials.free(&name)?;
        self.known.insert(key, name.clone());
        Ok(name)
    }
}
