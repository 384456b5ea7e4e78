//! Internal to urdd; no stability promise.
//!
//! The learned self-collision model (SPEC 8.8): its evaluation, for whoever uses a URDD, and its [training](train), for
//! whoever makes one. The validator uses neither: it evaluates models by an implementation of its own.
//!
//! A [`CollisionModel`] estimates the clearance of link pairs. It is meant to skip configurations that are far from
//! contact. It is an estimate, not a guarantee: its module states its error rates.
//!
//! Results do not depend on the instruction set, the number of threads, or the batching. Sums have a fixed order
//! without fused operations, and functions are those of `libm` or our own.

mod inputs;
mod model;
mod network;
pub mod train;

pub use model::{Clearance, CollisionModel};
pub use network::ModelError;
#[doc(hidden)]
pub use network::tanh;
