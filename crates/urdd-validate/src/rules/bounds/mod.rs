//! BND: `bounds_module`.

mod dofs_of_limits;
mod tables;
pub mod unlimited;

use crate::rule::rules;

rules! {
    dofs_of_limits, tables, unlimited
}
