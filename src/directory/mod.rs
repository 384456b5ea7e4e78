//! A URDD on disk: finding it, listing it, reading from it safely.

pub mod discover;
pub mod limits;
pub mod path;
pub mod root;
