//! What tests share. First, a second, simple producer of URDDs, which makes the valid bases of tests: it shares nothing
//! with the generator but the types of `urdd_format`.
//!
//! - [`robot`]: a robot as its URDF has it, its XML, and arbitrary robots for proptest
//! - [`core`]: robot -> documents of the core modules and the kinematics samples
//! - [`meshes`], [`shapes`]: robot of boxes -> documents and files of the other modules
//! - [`model`]: a robot with a self-collision model that is written down
//! - [`fixture`]: a whole URDD in memory, to be edited, sealed and written
//! - [`folder`]: a folder on disk, for many URDDs one after the other
//! - [`dice`]: choices of a seeded test
//! - [`emit`]: JSON and YAML text
//! - [`documents`]: documents that fit a JSON Schema
//! - [`difference`]: comparing two producers' documents
//! - [`core_modules`], [`urdf_to_core`]: joints and robots as the core modules of a URDD
//!
//! Then [`robots`]: URDDs of our robots, made by the generator.

pub mod core;
pub mod core_modules;
pub mod dice;
pub mod difference;
pub mod documents;
pub mod emit;
pub mod fixture;
pub mod folder;
pub mod meshes;
pub mod model;
pub mod robot;
pub mod robots;
pub mod shapes;
pub mod urdf_to_core;

/// The folder of the repository.
pub fn repository() -> &'static std::path::Path {
    std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
