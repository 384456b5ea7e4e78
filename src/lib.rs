//! Internal to urdd; no stability promise.
//!
//! The program `urdd`: its command line ([`cli`]), the page's server ([`view`]), the comparison of robots ([`diff`])
//! and the conformance suite ([`conformance`]), for the program itself and the Python package. Programs of your own use the crates `urdd-robot`,
//! `urdd-validate`, `urdd-generate`, `urdd-export` and `urdd-format`. `SPEC.md` is the normative text of the format.

#[doc(hidden)]
pub mod cli;
pub mod conformance;
pub mod diff;
pub mod view;

/// The Rust code in docs/rust.md is compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../docs/rust.md")]
pub struct RustPage;
