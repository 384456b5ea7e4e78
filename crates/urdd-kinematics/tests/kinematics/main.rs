//! Kinematics from modules alone, held to hand calculation, to published numbers, and to a second
//! implementation of another kind.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod closed_forms;
mod configurations;
mod faults;
mod naive_kinematics;
mod properties;
mod rotations;
