//! The Universal Robot Description Directory (URDD): its format, its published schemas, and the
//! validator that checks a URDD from any producer. `SPEC.md` is the normative text.

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "conformance")]
pub mod conformance;
pub mod directory;
pub mod document;
pub mod format;
#[cfg(feature = "generate")]
pub mod generate;
pub mod geometry;
pub mod kinematics;
pub mod report;
pub mod robot;
pub mod skips;
pub mod validate;
pub mod xml;

/// The Rust code in README.md is compiled and run with the tests.
#[cfg(all(doctest, feature = "cli"))]
#[doc = include_str!("../README.md")]
pub struct Readme;
