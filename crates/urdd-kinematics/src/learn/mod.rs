//! The learned self-collision model (SPEC 8.8): evaluating it, and, with the feature `generate`, training it.
//!
//! A [`CollisionModel`] estimates how near pairs of links are. It is for passing over configurations that are far from
//! any contact. It is an estimate, not a guarantee: its module states how often it is wrong.
//!
//! A result does not depend on the instruction set, the number of threads, or what is asked together: sums are in
//! one order, without fused operations, and functions are those of `libm` or our own.

mod error;
pub mod inputs;
pub mod kernel;
pub mod model;
pub mod network;

pub use error::ModelError;
pub use model::{Clearance, CollisionModel};
