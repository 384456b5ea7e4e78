//! Bounds on what is read: a URDD is untrusted input (SPEC 13.1).

/// Largest document that is read, bytes.
pub const MAX_DOCUMENT_BYTES: u64 = 512 << 20;

/// Most files of one URDD that are looked at.
pub const MAX_FILES: usize = 100_000;

/// Deepest folder below a URDD's root, and below a searched folder.
pub const MAX_FOLDER_DEPTH: usize = 32;

/// How many containers may stand in one another, in JSON and in YAML.
pub const DEPTH_LIMIT: usize = 100;
