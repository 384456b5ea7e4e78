//! The tests of this crate.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod arguments;
mod bounds;
mod bounds_of_places;
mod files;
mod gate;
mod mjcf;
mod mjcf_faults;
mod mjcf_meaning;
mod mjcf_seen;
mod origin;
mod packages;
mod sdf;
mod sniff;
