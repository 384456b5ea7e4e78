//! YML: the YAML mirrors.

pub mod not_yaml;
pub mod yaml_ambiguous;
pub mod yaml_anchor;
pub mod yaml_differs;
pub mod yaml_merge_key;
pub mod yaml_repeated_key;
pub mod yaml_tag;
pub mod yaml_too_deep;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &not_yaml::RULE,
    &yaml_tag::RULE,
    &yaml_anchor::RULE,
    &yaml_merge_key::RULE,
    &yaml_repeated_key::RULE,
    &yaml_ambiguous::RULE,
    &yaml_differs::RULE,
    &yaml_too_deep::RULE,
];
