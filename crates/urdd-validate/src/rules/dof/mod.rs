//! DOF: `dof_module`.

pub mod counts;
pub mod mappings;

use crate::rule::rules;

rules! {
    counts, mappings
}
