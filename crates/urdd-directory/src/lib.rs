//! Internal to urdd; no stability promise.
//!
//! The files of a URDD on disk, in memory or in a zip archive: discovery, listing, safe reading and writing. Also JSON
//! and YAML as text, and the folder of published schemas.

pub mod account;
pub mod cancellation;
pub mod canonical;
pub mod discover;
pub mod export_toml;
pub mod file_entry;
pub mod file_type;
pub mod json;
pub mod json_scan;
pub mod limits;
pub mod listing;
pub mod loops_toml;
pub mod metadata;
pub mod outputs;
pub mod path;
pub mod position;
pub mod range;
pub mod regular;
pub mod root;
pub mod schema_files;
pub mod source;
pub mod staging;
pub mod take;
pub mod target_lock;
pub mod writer;
pub mod yaml;
