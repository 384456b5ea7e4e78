//! The tests of this crate.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod bounds;
mod files;
mod gate;
mod mjcf;
mod mjcf_faults;
mod origin;
mod sdf;
mod sniff;
