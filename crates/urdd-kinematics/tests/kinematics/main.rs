//! Kinematics from modules alone, compared with hand calculation, published numbers, and a second implementation that
//! works differently.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod closed_forms;
mod configurations;
mod faults;
mod fill;
mod loops;
mod naive_kinematics;
mod properties;
mod rotations;
