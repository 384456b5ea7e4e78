//! YML: the YAML mirrors.

mod not_yaml;
mod yaml_ambiguous;
mod yaml_anchor;
mod yaml_differs;
mod yaml_merge_key;
mod yaml_repeated_key;
mod yaml_tag;
mod yaml_too_deep;

use crate::rule::rules;

rules! {
    not_yaml, yaml_ambiguous, yaml_anchor, yaml_differs, yaml_merge_key, yaml_repeated_key,
    yaml_tag, yaml_too_deep
}
