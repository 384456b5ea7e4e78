//! The C interface, as a caller in Rust.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod allocations;
mod alone;
mod calls;
mod changing;
mod fuzz_findings;
mod interface;
mod inverse;
mod loops;
mod memory;
mod motion;
mod spheres;
