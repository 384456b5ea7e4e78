//! The tests of this crate.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod bounds;
mod bounds_of_places;
mod bounds_usd;
mod gate;
mod mjcf;
mod mjcf_faults;
mod mjcf_meaning;
mod mjcf_seen;
mod sdf;
mod usd;
mod usd_mujoco;
mod usd_shapes;
