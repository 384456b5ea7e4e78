//! Names of shapes and materials. Programs take the first of two materials of one name, or refuse them.

use std::collections::HashMap;

use urdd_directory::account::{Account, Overdrawn};
use urdd_xml::number::numbers;

use super::model::{Material, Model};
use super::names::Names;

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
    ///
    /// # Errors
    /// If the account does not have its cost.
    pub fn shape(&mut self, is_visual: bool, link: &str, name: &str) -> Result<String, Overdrawn> {
        let names = if is_visual { &mut self.visuals } else { &mut self.collisions };
        if names.take(name)? { Ok(name.to_owned()) } else { names.free(&format!("{link}/{name}")) }
    }

    /// The name of a material: the same for what is the same.
    ///
    /// # Errors
    /// If the account does not have its cost.
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
