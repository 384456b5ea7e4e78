//! The library as a WebAssembly module: no clock, no files, no random numbers. It imports nothing; where it lints, a
//! function that gives the content of a file that the host named, and where it generates, one that is told of progress.
//!
//! Input bytes are written to memory from `urdd_alloc`. Output is an *answer*: a pointer to a 32-bit length
//! and that many bytes, to be freed with `urdd_free_answer`. Unless its function states otherwise, an answer
//! is JSON: the result, or `{"error": "..."}`. A panic is a trap, which ends the instance: create a new one.

#[cfg(feature = "robot")]
mod about;
mod answer;
#[cfg(feature = "lint")]
mod around;
#[cfg(feature = "robot")]
mod bodies;
#[cfg(feature = "robot")]
mod collisions;
#[cfg(any(feature = "validate", feature = "lint"))]
mod explain;
#[cfg(feature = "make")]
mod export;
mod files;
#[cfg(feature = "robot")]
mod inverse;
#[cfg(feature = "lint")]
mod lint;
#[cfg(feature = "robot")]
mod loops;
#[cfg(feature = "make")]
mod make;
mod memory;
#[cfg(feature = "robot")]
mod model;
#[cfg(feature = "robot")]
mod pairs;
#[cfg(target_arch = "wasm32")]
mod random;
#[cfg(feature = "robot")]
mod robot;
#[cfg(feature = "robot")]
mod sources;
#[cfg(feature = "spheres")]
mod spheres;
#[cfg(feature = "validate")]
mod validate;
