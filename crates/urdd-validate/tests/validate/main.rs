//! The validator as a library: sound robots, random faults, documents that only fit their schemas, figures by peers.

// A test may stop anywhere.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::print_stderr,
    missing_docs
)]

mod core_rules_random;
mod corpus;
mod kinematics_figures;
mod no_crash;
mod shape_rules_random;
mod soundness;
