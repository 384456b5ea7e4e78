//! JSON and YAML as text, held to other readers.

// A test may stop anywhere.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::print_stderr,
    missing_docs
)]

mod text_arbitrary;
mod text_bad_input;
mod text_yaml;
