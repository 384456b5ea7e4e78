//! Limits: on what is read, since a URDD is untrusted (SPEC 13.1), and on what an [`Account`](crate::account::Account) allows
//! to be made of it.

/// Largest document, bytes.
pub const MAX_DOCUMENT_BYTES: u64 = 512 << 20;

/// Largest URDF, bytes: of a source, and in a URDD.
pub const MAX_URDF_BYTES: u64 = 64 << 20;

/// Maximum number of files and folders listed in one URDD.
pub const MAX_FILES: usize = 100_000;

/// Maximum number of files around a description that are not on the disk.
pub const MAX_SET_FILES: usize = 20_000;

/// Largest total size of these files, bytes.
pub const MAX_SET_BYTES: u64 = 2 << 30;

/// Deepest folder below a URDD's root, and below a searched folder.
pub const MAX_FOLDER_DEPTH: usize = 32;

/// Maximum nesting depth of objects and lists in JSON and YAML.
pub const DEPTH_LIMIT: usize = 100;

/// Largest zip archive, bytes.
pub const MAX_ARCHIVE_BYTES: u64 = 1 << 30;

/// Largest total inflated size of a zip archive, bytes.
pub const MAX_INFLATED_BYTES: u64 = 4 << 30;

/// Largest ratio of total inflated size to archive size, above [`SMALL_ARCHIVE_BYTES`]. Modules with long lists of
/// zeros reach about 200.
pub const MAX_INFLATION: u64 = 250;

/// Inflated size that is allowed regardless of archive size, bytes.
pub const SMALL_ARCHIVE_BYTES: u64 = 64 << 20;

/// Largest file that is given to a browser or copied for one, bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// Longest name of an entry in a zip archive, bytes: the path limit of Linux.
pub const MAX_NAME_BYTES: usize = 4096;

/// Longest part of such a name between slashes, bytes: 255 characters of up to four bytes, the limit of file systems.
pub const MAX_PART_BYTES: usize = 1020;

/// Largest `VERSION` file of a module, bytes.
pub const MAX_VERSION_BYTES: u64 = 1024;

/// Largest TOML file that a person writes, bytes: a recipe, `urdd.toml`.
pub const MAX_TOML_BYTES: u64 = 1 << 20;

/// Largest `NAME.export.toml` and `NAME.loops.toml`, and list of loops in YAML, bytes. Imports write no larger one.
pub const MAX_SETUP_BYTES: u64 = 16 << 20;

/// Largest file that says what a package or a model has, bytes: `package.xml`, `model.config`, `CMakeLists.txt`,
/// `setup.py`, a launch file.
pub const MAX_MANIFEST_BYTES: u64 = 1 << 20;

/// Largest SRDF, and largest xacro file that is searched for names, bytes.
pub const MAX_SRDF_BYTES: u64 = 16 << 20;

/// The most of a list of spheres, bytes.
pub const MAX_SPHERES_BYTES: u64 = 16 << 20;

/// Bytes that may be made of any input, and steps that may be done with it.
pub const ALLOWANCE: u64 = 128 << 20;

/// Bytes and steps for each byte that was read. Ordinary descriptions use a tenth.
pub const MULTIPLE: u64 = 100;
