//! JSN and YML: documents as text, in JSON and in the YAML beside it.

mod faults;
mod json;
mod yaml;

use crate::rule::rules;

rules! {
    json, yaml
}
