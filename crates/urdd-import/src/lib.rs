//! Internal to urdd; no stability promise.
//!
//! Descriptions that are no URDF: MJCF, SDF and USD. A reader of each format makes a model; from it come a URDF, its
//! meshes, an SRDF, what exports need, and a report. Files are found and read by the gate of `urdd-source`.

mod fault;
mod features;
mod graph;
mod imported;
mod mass;
mod mjcf;
mod model;
mod place;
mod sdf;
#[cfg(test)]
mod tests;
mod tree;
mod urdf;
mod usd;

pub use features::{Report, imported_table};
pub use imported::{Imported, import, import_whole, open};
