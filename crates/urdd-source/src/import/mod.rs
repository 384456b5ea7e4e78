//! Descriptions that are no URDF: MJCF and SDF. A reader of each format makes a [`model::Model`]; from it come a URDF, its
//! meshes, an SRDF, what exports need, and a report.

pub mod fault;
pub mod features;
pub mod mjcf;
pub mod model;
pub mod options;
pub mod placed;
pub mod reach;
pub mod sdf;
