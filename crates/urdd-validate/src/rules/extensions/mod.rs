//! EXT: extension modules.

mod annotations;
mod schema;

use crate::rule::rules;

rules! {
    annotations, schema
}
