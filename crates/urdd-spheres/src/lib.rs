//! Spheres that stand for the convex pieces of links (SPEC 8.9): fitted so that they touch where the pieces touch, or covering
//! all of them; nested in levels; and measured. Internal to urdd, no promise.
//!
//! [`fitted`] and [`cover`] make spheres, [`levels`] nests them, [`module`] measures them and makes the module.

#[doc(hidden)]
pub mod cover;
#[doc(hidden)]
pub mod figures;
#[doc(hidden)]
pub mod fit;
pub mod fitted;
#[doc(hidden)]
pub mod frame;
#[doc(hidden)]
pub mod judge;
#[doc(hidden)]
pub mod levels;
pub mod list;
mod loss;
#[doc(hidden)]
pub mod model;
pub mod module;
pub mod pairs;
pub mod samples;
#[doc(hidden)]
pub mod surface;
