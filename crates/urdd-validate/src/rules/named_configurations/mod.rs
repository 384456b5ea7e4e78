//! CNF: `named_configurations_module`.

mod configuration_does_not_follow;
mod configuration_name_repeated;
mod configuration_out_of_bounds;
mod configuration_positions_wrong;
mod dofs;

use crate::rule::rules;

rules! {
    configuration_does_not_follow, configuration_name_repeated, configuration_out_of_bounds,
    configuration_positions_wrong,
}
