//! JSON and YAML as text, compared with other readers; archives of other programs.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod account;
mod archives;
mod canonical;
mod digest;
mod document;
mod file_type;
mod json;
mod json_places;
mod json_scan;
mod layout;
mod number_text;
mod outputs;
mod path;
mod position;
mod range;
mod regular;
mod root;
mod source_tree;
mod string_text;
mod temporary;
mod text_arbitrary;
mod text_bad_input;
mod text_fault;
mod text_yaml;
mod toml_text;
mod watched;
mod yaml_places;
mod yaml_scalar;
mod yaml_transcript;
