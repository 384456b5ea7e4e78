//! The tests of this crate.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod files;
mod origin;
mod sdf;
mod sniff;
