//! YML: the YAML mirrors.

mod not_yaml;
mod yaml_ambiguous;
mod yaml_anchor;
mod yaml_differs;
mod yaml_merge_key;
mod yaml_repeated_key;
mod yaml_tag;
mod yaml_too_deep;

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
