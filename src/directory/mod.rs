//! A URDD on disk: finding it, listing it, reading from it safely; JSON and YAML as text; and the
//! folder of published schemas.

pub mod canonical;
pub mod discover;
pub mod json;
pub mod json_scan;
pub mod limits;
pub mod number_text;
pub mod path;
pub mod position;
pub mod root;
pub mod schema_files;
pub mod text_fault;
pub mod yaml;
mod yaml_compare;
mod yaml_message;
pub mod yaml_scalar;
mod yaml_tabs;
