//! The suite's files, carried by the program.

use include_dir::{Dir, include_dir};

/// The folder `conformance` of the repository.
pub static SUITE: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/conformance");

/// The robots that producers are run on: URDF files, and their meshes below.
pub const ROBOTS: &str = "robots";
