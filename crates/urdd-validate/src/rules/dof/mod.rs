//! DOF: `dof_module`.

pub mod counts;
mod described;
pub mod mappings;

use crate::rule::rules;

rules! {
    counts, described, mappings
}
