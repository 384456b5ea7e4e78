//! LEG: conventions of URDDs that were published before version 1.

pub mod conventions;

use crate::rule::rules;

rules! {
    conventions
}
