//! The program `urdd`: its command line ([`cli`]), the page's server ([`view`]) and the conformance suite
//! ([`conformance`]). Libraries are the crates `urdd-robot`, `urdd-validate`, `urdd-generate` and `urdd-export`; this
//! one is for the program and the Python package, and promises nothing. `SPEC.md` is the normative text of the format.

#[doc(hidden)]
pub mod cli;
pub mod conformance;
pub mod view;

/// The Rust code in docs/rust.md is compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../docs/rust.md")]
pub struct RustPage;
