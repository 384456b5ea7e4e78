//! SPH: `link_shapes_spheres_module`.

mod fit;
mod lists;
mod pairs;

use crate::rule::rules;

rules! {
    lists, fit, pairs
}
