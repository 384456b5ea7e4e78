//! Queries of a robot, compared with closed forms, finite differences and other methods.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod cancelled;
mod carrying;
mod changing;
mod closed_ways;
mod gravity;
mod inverse;
mod link_spheres;
mod loops;
mod motion;
mod nearness;
mod opening;
mod planning;
mod sphere_rounding;
mod spheres;
mod world;
