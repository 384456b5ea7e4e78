//! Internal to urdd; no stability promise.
//!
//! Descriptions that are no URDF: MJCF, SDF and USD. A reader of each format makes a model; from it come a URDF, its
//! meshes, an SRDF, what exports need, and a report. Files are found and read by the gate of `urdd-source`.

mod companions;
mod cone;
mod fault;
mod features;
mod forest;
mod imported;
mod limits;
mod mass;
mod mesh_mass;
mod mjcf;
mod model;
mod names;
mod place;
mod price;
mod refusal;
pub mod report;
mod sdf;

#[cfg(test)]
mod tests;
mod tree;
mod urdf;
mod usd;

pub use imported::{Imported, import, import_whole, open};
