//! Kinematics from modules alone, held to hand calculation, to published numbers, and to a second
//! implementation of another kind.

// A test may stop anywhere.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::print_stderr,
    missing_docs
)]

mod closed_forms;
mod configurations;
mod faults;
mod naive_kinematics;
mod properties;
mod rotations;
