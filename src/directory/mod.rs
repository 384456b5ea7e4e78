//! A URDD on disk: finding it, listing it, reading from it safely; JSON and YAML as text; and the
//! folder of published schemas.

pub mod canonical;
pub mod digest;
pub mod discover;
pub mod document;
pub mod json;
mod json_fault;
mod json_places;
pub mod json_scan;
pub mod limits;
pub mod number_text;
pub mod path;
pub mod position;
pub mod rehash;
pub mod root;
pub mod schema_files;
pub mod staging;
mod string_text;
pub mod text_fault;
pub mod writer;
pub mod yaml;
