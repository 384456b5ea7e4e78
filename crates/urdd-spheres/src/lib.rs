//! Spheres that stand for the convex pieces of links (SPEC 8.9): fitted so that they touch where the pieces touch, or covering
//! all of them; nested in levels; and measured. Internal to urdd, no promise.
//!
//! [`fitted`] and [`cover`] make spheres, [`module`] nests and measures them and makes the module.

#[doc(hidden)]
pub mod cover;
#[doc(hidden)]
pub mod fit;
pub mod fitted;
#[doc(hidden)]
pub mod frame;
#[doc(hidden)]
pub mod judge;
mod loss;
#[doc(hidden)]
pub mod model;
pub mod module;
pub mod samples;
#[doc(hidden)]
pub mod surface;
#[doc(hidden)]
pub mod tree;
