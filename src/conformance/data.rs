//! The suite's files, carried by the program.

use include_dir::{Dir, include_dir};

/// The folder `conformance` of the repository.
pub static SUITE: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/conformance");

/// The robots that producers are run on: URDF files, and their meshes below.
pub const ROBOTS: &str = "robots";
/// What is kept of the URDDs that `urdd generate` makes of these.
pub const VALID: &str = "valid";
/// URDDs that cases change: a folder each.
pub const BASES: &str = "bases";
/// Cases, near misses too: a folder for each code.
pub const INVALID: &str = "invalid";
/// Numeric truths.
pub const VECTORS: &str = "vectors";
