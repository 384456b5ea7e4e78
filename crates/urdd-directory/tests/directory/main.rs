//! JSON and YAML as text, compared with other readers.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod text_arbitrary;
mod text_bad_input;
mod text_yaml;
