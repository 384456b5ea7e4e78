//! The colours of a URDF's elements.

use std::collections::HashMap;

use crate::urdf::{Material, UrdfModule};

/// The colours of a robot's materials, by name.
pub struct Colors<'a>(HashMap<&'a str, [f64; 4]>);

impl<'a> Colors<'a> {
    /// Those of the materials at the top of a URDF. The first coloured one of a name counts.
    pub fn of(urdf: &'a UrdfModule) -> Self {
        let mut colors = HashMap::new();
        for material in &urdf.materials {
            if let (Some(name), Some(color)) = (&material.name, &material.color) {
                colors.entry(name.as_str()).or_insert(color.rgba);
            }
        }
        Colors(colors)
    }

    /// The colour of an element with this material: its own, or that of the robot's material with its name.
    pub fn get(&self, material: Option<&Material>) -> Option<[f64; 4]> {
        let material = material?;
        let named = || self.0.get(material.name.as_deref()?).copied();
        material.color.as_ref().map(|color| color.rgba).or_else(named)
    }
}
