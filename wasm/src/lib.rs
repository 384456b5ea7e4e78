//! The library as a WebAssembly module that imports nothing: no clock, no file, no random numbers.
//!
//! Bytes go in by `urdd_alloc` and come out as an *answer*: a pointer to a 32-bit length and that many bytes,
//! to be given back to `urdd_free_answer`. An answer is JSON unless its function says otherwise: what was asked
//! for, or `{"error": "..."}`. A panic is a trap, which ends the instance: make a new one.

mod about;
mod answer;
#[cfg(feature = "validate")]
mod explain;
mod files;
mod memory;
mod mesh;
mod model;
mod pairs;
#[cfg(target_arch = "wasm32")]
mod random;
mod reach;
mod robot;
mod sources;
#[cfg(feature = "validate")]
mod validate;
