//! SPH: `link_shapes_spheres_module`.

mod counts;
mod covering;
mod fit;
mod lists;
mod nesting;
mod pairs;
mod sampled;

use crate::rule::rules;

rules! {
    lists, nesting, covering, fit, pairs, sampled, counts
}
