//! Internal to urdd; no stability promise.
//!
//! The command line of `urdd`, for the program and for the Python package, and the conformance suite that the program
//! carries. Programs of your own use the crates `urdd-robot`, `urdd-validate`, `urdd-generate`, `urdd-export` and
//! `urdd-format`. `SPEC.md` is the normative text of the format.

#[doc(hidden)]
pub mod cli;
pub mod suite;

/// The Rust code in docs/rust.md is compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../docs/rust.md")]
pub struct RustPage;

/// That in docs/loops.md is compiled.
#[cfg(doctest)]
#[doc = include_str!("../docs/loops.md")]
pub struct LoopsPage;
