//! Every rule, one file each, in folders by family.

pub mod bounds;
pub mod testing;

use super::rule::Rule;

/// Every rule, in the order of their codes.
pub fn all() -> Vec<&'static Rule> {
    let families: &[&[&Rule]] = &[bounds::RULES];
    families
        .iter()
        .flat_map(|rules| rules.iter().copied())
        .collect()
}
