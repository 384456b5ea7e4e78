//! BND: `bounds_module`.

mod bound_count_wrong;
mod bound_differs_from_limit;
mod bounds_columns_differ;
mod limited_flag_wrong;
pub(super) mod limits;
mod speed_or_effort_differs;
pub mod unlimited_bounds_wrong;

use crate::rule::rules;
use limits::{LEGACY_WIDENING, columns_agree, dofs, limited_dofs};

rules! {
    bound_count_wrong, bound_differs_from_limit, bounds_columns_differ, limited_flag_wrong,
    speed_or_effort_differs, unlimited_bounds_wrong
}
