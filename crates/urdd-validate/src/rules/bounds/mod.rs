//! BND: `bounds_module`.

mod bound_count_wrong;
mod bounds_columns_differ;
mod dofs_of_limits;
pub(super) mod limits;
pub mod unlimited_bounds_wrong;

use crate::rule::rules;
use limits::{LEGACY_WIDENING, columns_agree, dofs, limited_dofs};

rules! {
    bound_count_wrong, bounds_columns_differ, dofs_of_limits, unlimited_bounds_wrong
}
