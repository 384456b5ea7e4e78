//! Bounds on what is read: a URDD is untrusted input (SPEC 13.1).

/// Largest document that is read, bytes.
pub const MAX_DOCUMENT_BYTES: u64 = 512 << 20;

/// Most files of one URDD that are looked at.
pub const MAX_FILES: usize = 100_000;

/// Deepest folder below a URDD's root, and below a searched folder.
pub const MAX_FOLDER_DEPTH: usize = 32;

/// How many containers may stand in one another, in JSON and in YAML.
pub const DEPTH_LIMIT: usize = 100;

/// Largest zip archive that is read, bytes.
pub const MAX_ARCHIVE_BYTES: u64 = 1 << 30;

/// Most bytes that the files of a zip archive are in all.
pub const MAX_INFLATED_BYTES: u64 = 4 << 30;

/// How many times its own size the files of a zip archive may be in all, above
/// [`SMALL_ARCHIVE_BYTES`]. Modules of long lists of zeros come to some 200.
pub const MAX_INFLATION: u64 = 250;

/// What the files of a zip archive may be in all, however small it is, bytes.
pub const SMALL_ARCHIVE_BYTES: u64 = 64 << 20;

/// Longest name of an entry of a zip archive, bytes: what Linux allows for a path.
pub const MAX_NAME_BYTES: usize = 4096;

/// Longest part of such a name between two slashes, bytes. 255 characters of up to four bytes: what file systems allow.
pub const MAX_PART_BYTES: usize = 1020;
