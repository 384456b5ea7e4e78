//! Every rule, one file each, in folders by family.

pub mod bounds;
pub mod chain;
pub mod composition;
pub mod connections;
pub mod directory;
pub mod dof;
pub mod extensions;
pub mod json;
pub mod kinematics;
pub mod learned;
pub mod legacy;
pub mod meshes;
pub mod named_configurations;
mod prelude;
pub mod schema;
pub mod shapes;
pub mod source;
pub mod testing;
pub mod urdf;
pub mod yaml;

use super::rule::Rule;

/// Every rule, in the order of their codes.
pub fn all() -> Vec<&'static Rule> {
    let families: &[&[&Rule]] = &[
        directory::rules(),
        json::rules(),
        yaml::rules(),
        schema::rules(),
        extensions::rules(),
        urdf::rules(),
        source::rules(),
        dof::rules(),
        chain::rules(),
        connections::rules(),
        bounds::rules(),
        composition::rules(),
        meshes::rules(),
        shapes::rules(),
        learned::rules(),
        kinematics::rules(),
        named_configurations::rules(),
        legacy::rules(),
    ];
    let mut rules: Vec<&Rule> = families.concat();
    rules.sort_by_key(|rule| rule.code);
    rules
}
