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
        directory::RULES,
        json::RULES,
        yaml::RULES,
        schema::RULES,
        extensions::RULES,
        urdf::RULES,
        source::RULES,
        dof::RULES,
        chain::RULES,
        connections::RULES,
        bounds::RULES,
        composition::RULES,
        meshes::RULES,
        shapes::RULES,
        learned::RULES,
        kinematics::RULES,
        named_configurations::RULES,
        legacy::RULES,
    ];
    let mut rules: Vec<&Rule> = families.concat();
    rules.sort_by_key(|rule| rule.code);
    rules
}
