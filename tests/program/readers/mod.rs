//! What must be true of each reader, for any bytes: the bodies of the fuzz targets in `fuzz/`, and of
//! `tests/fuzz_findings.rs`, which replays their seeds and findings.

mod archive;
mod archive_names;
mod import;
mod json;
mod loops;
mod mesh;
mod programs;
mod settings;
mod spheres;
mod text;
mod urdd;
mod urdf;
mod yaml;

pub use archive::archive;
pub use archive_names::archive_names;
pub use import::{mjcf, sdf, usd};
pub use json::json;
pub use loops::loops;
pub use mesh::{dae, glb, gltf, obj, stl};
pub use programs::programs;
pub use settings::settings;
pub use spheres::spheres;
pub use urdd::urdd;
pub use urdf::urdf;
pub use yaml::yaml;
