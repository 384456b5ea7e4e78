//! LEG: conventions of URDDs that were published before version 1.

pub mod adjusted_mappings_wrong;
mod conventions;

use crate::rule::rules;

rules! {
    adjusted_mappings_wrong, conventions
}
