//! CNF: `named_configurations_module`.

mod configuration_does_not_follow;
mod positions;

use crate::rule::rules;

rules! {
    configuration_does_not_follow, positions
}
