//! JSN, YML and SCH: documents as text, in JSON and in the YAML beside it, and against their schemas.

mod faults;
mod json;
mod schema;
mod yaml;

use crate::rule::rules;

rules! {
    json, schema, yaml
}
