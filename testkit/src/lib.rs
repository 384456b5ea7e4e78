//! Internal to urdd; no stability promise.
//!
//! Helpers shared by tests. Most of them form a second, simple producer of URDDs for the valid base cases of tests. It
//! shares only the types of `urdd_format` with the generator.
//!
//! - [`robot`]: a robot as in its URDF, its XML, and arbitrary robots for proptest
//! - [`core`]: robot -> documents of the core modules and the kinematics samples
//! - [`meshes`], [`shapes`]: robot of boxes -> documents and files of the other modules
//! - [`model`]: a robot with a handwritten self-collision model
//! - [`fixture`]: a whole URDD in memory, to edit, seal and write
//! - [`folder`]: a folder on disk for many URDDs in succession
//! - [`dice`]: reproducible choices of a seeded test
//! - [`emit`]: JSON and YAML text
//! - [`documents`]: documents that fit a JSON Schema
//! - [`difference`]: comparing two producers' documents
//! - [`trials`]: how much tests try
//! - [`temporary`]: folders for tests
//! - [`transform`]: rotations and rigid transforms as matrices
//! - [`core_modules`], [`urdf_to_core`]: joints and robots -> core modules of a URDD
//! - [`urdfs`]: URDFs that tests of crates and of the program share
//! - [`workshop`]: a folder with our robots, to change them
//! - [`requests`], [`site`]: the server and the exported site of `urdd view`, as a browser reads them
//! - [`usda`]: text of USD
//! - [`xml`]: XML, read by two parsers
//!
//! [`robots`] generates URDDs of the project's robots.

#![allow(clippy::disallowed_methods, reason = "for maintainers")]

pub mod core;
pub mod core_modules;
pub mod dice;
pub mod difference;
pub mod documents;
pub mod emit;
pub mod files;
pub mod fixture;
pub mod folder;
pub mod looped;
pub mod meshes;
pub mod model;
pub mod page;
pub mod requests;
pub mod robot;
pub mod robots;
pub mod shapes;
pub mod site;
pub mod spheres;
pub mod temporary;
pub mod transform;
pub mod trials;
pub mod urdf_to_core;
pub mod urdfs;
pub mod usda;
pub mod workshop;
pub mod xml;

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The root folder of the repository: of the one that Cargo runs tests of, though it may have built them in another one.
pub fn repository() -> &'static Path {
    static ROOT: OnceLock<PathBuf> = OnceLock::new();
    ROOT.get_or_init(|| {
        let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
        let package = package.unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
        let mut above = package.ancestors();
        let root = above.find(|folder| folder.join("SPEC.md").is_file());
        root.expect("a folder with SPEC.md").to_owned()
    })
}
