//! Distances between convex shapes: hulls, boxes and spheres, and their statistics over many poses.
//!
//! A robot's statistics take tens of millions of distances, so that the work is arranged for them: the poses
//! of eight samples are treated at once (`gjk`), and the farthest vertex in a direction is looked up in a
//! table instead of searched (`support_table`).
//!
//! **Accuracy.** Each distance is the exact distance of the hulls of the given points within
//! [`TOLERANCE`]; shapes that touch or overlap are at distance 0. Results are the same bits on each
//! instruction set of an architecture and for each number of threads.

pub mod across;
mod bodies;
mod cells;
mod gjk;
mod kernel;
mod lanes;
mod motion;
mod shape;
mod simplex;
mod statistics;
mod support;
mod support_table;
mod witness;

pub use bodies::BodyPairs;
pub use fearless_simd::Level;
pub use gjk::TOLERANCE;
pub use kernel::{Shape, distance};
pub use motion::{Motion, MotionError};
pub use shape::{ConvexShape, OrientedBox, ShapeError, Sphere};
pub use statistics::{
    PairStatistics, PlacedShape, ShapeList, pair_distances, pair_statistics, statistics_of_kinds,
};
pub use witness::Witness;
