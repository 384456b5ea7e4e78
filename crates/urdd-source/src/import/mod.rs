//! Descriptions that are no URDF: MJCF and SDF. A reader of each format makes a [`model::Model`]; from it come a URDF, its
//! meshes, an SRDF, what exports need, and a report.

mod companions;
pub mod fault;
pub mod features;
mod imported;
mod mass;
pub mod mjcf;
pub mod model;
mod names;
pub mod options;
mod origin;
pub mod place;
pub mod placed;
mod refusal;
pub mod report;
pub mod sdf;
mod solid;
mod titles;
mod tree;
pub mod unreachable;
mod urdf;

pub use imported::{Imported, import, import_whole};
