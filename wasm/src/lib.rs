//! The library as a WebAssembly module without imports: no clock, no files, no random numbers.
//!
//! Input bytes are written to memory from `urdd_alloc`. Output is an *answer*: a pointer to a 32-bit length
//! and that many bytes, to be freed with `urdd_free_answer`. Unless its function states otherwise, an answer
//! is JSON: the result, or `{"error": "..."}`. A panic is a trap, which ends the instance: create a new one.

mod about;
mod answer;
mod bodies;
mod collisions;
#[cfg(feature = "validate")]
mod explain;
mod files;
mod inverse;
mod kind;
mod memory;
mod mesh;
mod model;
mod pairs;
mod pose;
#[cfg(target_arch = "wasm32")]
mod random;
mod robot;
mod sources;
#[cfg(feature = "validate")]
mod validate;
