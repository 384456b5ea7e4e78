//! Every rule, in folders by family. A file has one rule, or several that are about the same or share their check.

pub mod bounds;
pub mod chain;
pub mod composition;
pub mod connections;
pub mod directory;
pub mod dof;
pub mod extensions;
pub mod kinematics;
pub mod learned;
pub mod legacy;
pub mod loops;
pub mod meshes;
pub mod named_configurations;
mod prelude;
pub mod shapes;
pub mod source;
pub mod spheres;
pub mod testing;
pub mod text;
pub mod urdf;

use super::rule::Rule;

/// Every rule, in the order of their codes.
pub fn all() -> Vec<&'static Rule> {
    let families = [
        directory::rules(),
        text::rules(),
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
        spheres::rules(),
        kinematics::rules(),
        named_configurations::rules(),
        loops::rules(),
        legacy::rules(),
    ];
    let mut rules = families.concat();
    rules.sort_by_key(|rule| rule.code);
    rules
}
