//! CNF: `named_configurations_module`.

mod configurations;
use crate::rule::rules;

rules! {
    configurations
}
