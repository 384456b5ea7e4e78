//! BND: `bounds_module`.

pub mod limits;
mod tables;

use crate::rule::rules;

rules! {
    limits, tables
}
