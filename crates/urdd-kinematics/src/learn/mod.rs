//! The learned self-collision model (SPEC 8.8): evaluation.
//!
//! A [`CollisionModel`] estimates the clearance of link pairs. It is meant to skip configurations that are far from
//! contact. It is an estimate, not a guarantee: its module states its error rates.
//!
//! Results do not depend on the instruction set, the number of threads, or the batching. Sums have a fixed order
//! without fused operations, and functions are those of `libm` or our own.

mod error;
pub mod inputs;
pub mod kernel;
pub mod model;
pub mod network;

pub use error::ModelError;
pub use model::{Clearance, CollisionModel};
