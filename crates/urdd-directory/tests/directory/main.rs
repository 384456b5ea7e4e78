//! JSON and YAML as text, compared with other readers; archives of other programs.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod archives;
mod canonical;
mod digest;
mod document;
mod json;
mod json_places;
mod json_scan;
mod layout;
mod number_text;
mod path;
mod position;
mod source_tree;
mod staging_inside;
mod string_text;
mod text_arbitrary;
mod text_bad_input;
mod text_fault;
mod text_yaml;
mod yaml_scalar;
mod yaml_transcript;
