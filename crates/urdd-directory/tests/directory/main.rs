//! JSON and YAML as text, held to other readers.

mod text_arbitrary;
mod text_bad_input;
mod text_yaml;
