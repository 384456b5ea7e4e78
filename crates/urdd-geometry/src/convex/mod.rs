//! Distances between convex shapes (hulls, boxes and spheres), and their statistics over many poses.
//!
//! A robot's statistics take tens of millions of distance queries. So GJK processes the poses of eight samples at once
//! (`gjk`), and a table replaces the search for the farthest vertex in a direction (`support_table`).
//!
//! **Accuracy.** Each distance is within [`TOLERANCE`] of the exact distance of the convex hulls of the given points.
//! Shapes that touch or overlap have distance 0. Results are bit-identical on each instruction set of an architecture
//! and for any number of threads.

pub mod across;
mod bodies;
mod gjk;
mod penetration;
mod samples;
mod shape;
mod statistics;
mod support_table;

pub use crate::convex::samples::{Motion, MotionError, PoseLanes, Shape, distance};
pub use across::Witness;
pub use bodies::BodyPairs;
pub use fearless_simd::Level;
pub use gjk::TOLERANCE;
pub use penetration::{Penetration, penetration};
pub use shape::{ConvexShape, OrientedBox, ShapeError, Sphere};
pub use statistics::{
    PairStatistics, PlacedShape, ShapeList, pair_distances, pair_ranges, pair_statistics,
    statistics_of_kinds,
};
