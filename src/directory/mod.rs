//! Folders on disk.

pub mod schema_files;
